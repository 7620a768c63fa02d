// SPDX-License-Identifier: Apache-2.0
/// The daemon on the segment of the soak: its drives, its configuration, and what it counts of itself.
#pragma once

#include "gateway.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace dpslave::endurance {

using dpslave::test::Arguments;
using dpslave::test::Folder;
using dpslave::test::Outcome;
using dpslave::test::Process;

/// How long a program may take for what takes a moment. The whole run may be stopped for minutes and go on.
inline constexpr std::chrono::seconds kPatience{600};

/// Addresses of the stations that are always there, and of one that comes and goes by reloads.
inline constexpr std::uint8_t kFirst = 5, kSecond = 6, kVisitor = 7;

/// What the daemon counts, in bus.
struct DaemonCounts {
    std::uint64_t octets = 0;
    std::uint64_t telegrams = 0;
    std::uint64_t requests = 0;
    std::uint64_t answers = 0; ///< that went out
    std::uint64_t missed = 0;  ///< requests that it did not answer: late, overtaken, not sent
    std::uint64_t flaws = 0;
};

struct Setup {
    std::string bus_port;  ///< the end of the daemon
    int cpu = -1;          ///< [realtime] cpu
    unsigned max_tsdr = 0; ///< [bus] max_tsdr, bit times; 0: that of the GSD
    dpslave::test::Environment environment{};
};

class Installation {
public:
    /// Starts drives and daemon. Throws if one of them does not start.
    explicit Installation(Setup setup);

    void start_daemon(); ///< does not wait until it serves
    Process& daemon() { return *daemon_; }
    /// What the service does after every end of the daemon.
    Outcome release() const;

    /// Another configuration and a reload. True: taken.
    bool reload(bool visitor, unsigned refresh_s);
    /// A configuration with a fault. True: refused.
    bool reload_with_fault();

    Process& drive() { return *drive_; }
    void unplug_drive();
    void plug_drive();

    Outcome dpctl(const Arguments& arguments) const; ///< all that it says is in `out`
    Arguments dpctl_command(const Arguments& arguments) const;
    std::filesystem::path socket() const { return folder_ / "control.sock"; }

    DaemonCounts counts() const;
    std::uint64_t rss_kib() const; ///< all of the daemon's memory that is in use

private:
    std::string config(bool visitor, unsigned refresh_s) const;

    Arguments daemon_command() const;

    Setup setup_;
    Folder folder_;
    std::unique_ptr<Process> line_, drive_, daemon_;
};

} // namespace dpslave::endurance
