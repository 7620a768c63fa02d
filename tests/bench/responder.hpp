// SPDX-License-Identifier: Apache-2.0
/// Who answers at the other end of a cable: the real daemon, or the least that can answer at all.
#pragma once

#include "support/folder.hpp"
#include "wire.hpp"

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

namespace dpslave::bench {

/// How a thread is scheduled: what the daemon's bus thread got, the null responder gets too.
struct Scheduling {
    int policy = 0;
    int priority = 0;
    int cpu = -1; ///< pinned to this processor; -1 = not
};
std::string text(const Scheduling& scheduling);

/// A child process that ends with the bench, however that ends.
class Child {
public:
    Child() = default;
    explicit Child(pid_t pid) : pid_(pid) {}
    Child(Child&& other) noexcept;
    Child& operator=(Child&& other) noexcept;
    ~Child(); ///< SIGTERM, and SIGKILL if that does not help within five seconds

    pid_t pid() const { return pid_; }
    bool alive();                         ///< false as soon as it has ended
    std::chrono::nanoseconds cpu() const; ///< used by the whole process up to now
    std::chrono::nanoseconds wait();      ///< for its end; what it has used in all

private:
    pid_t pid_ = -1;
};

/// A child that may run on every processor, with ordinary scheduling. It ends with `body`.
Child start_child(const std::function<void()>& body);
/// Used by the calling thread up to now.
std::chrono::nanoseconds cpu_of_caller();

/// All responders share one processor, and the master takes the others: a reply that has to wake another
/// processor, or has not, would make more difference than any program. Pins the caller away from the
/// processor it gives; -1: there is only one, nothing was pinned.
int reserve_cpu();

/// The line that switches the transceiver, of a chip that the stand-in of libgpiod plays.
inline constexpr unsigned kDriverLine = 5;

using ::dpslave::test::Folder;

/// Starts the daemon with stations of profile 590, from address 5 on, on `bus` at 1.5 Mbit/s and a drive line
/// on `drive`. It gives each reply as much time as a master can grant: a pause of the machine is a long
/// turnaround and no lost reply. Its configuration, socket and log lie in `folder`.
struct DaemonSetup {
    std::filesystem::path program;
    std::filesystem::path profiles;
    std::string bus;
    std::string drive;
    std::filesystem::path folder;
    std::filesystem::path
        gpio_chip{};          ///< driver enable by line kDriverLine of this file; empty = direction "none"
    int cpu = -1;             ///< [realtime] cpu
    std::size_t stations = 1; ///< up to 32
    std::string keys{};       ///< a table more of its configuration
};
Child start_daemon(const DaemonSetup& setup);
/// Its control socket.
std::filesystem::path control_socket(const std::filesystem::path& folder);

/// The thread of the daemon that serves the bus: the one of that name, else the one with the highest
/// priority.
pid_t bus_thread_of(pid_t daemon);
Scheduling scheduling_of(pid_t thread); ///< policy and priority
std::chrono::nanoseconds cpu_of_thread(pid_t daemon, pid_t thread);
std::size_t resident_octets(pid_t process); ///< VmRSS

/// A process that reads `path`, checks the SD2 length and writes `reply`, not before `min_tsdr` after the
/// read: two system calls a telegram, nothing else.
Child start_null_responder(const std::string& path, const Octets& reply, const Scheduling& scheduling,
                           std::chrono::nanoseconds min_tsdr);

} // namespace dpslave::bench
