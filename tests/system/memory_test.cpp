// SPDX-License-Identifier: Apache-2.0
// Tests how much memory the daemon has. It is locked: no other process can use it.
// Only here: pages of a process that the kernel has locked.
#include "gateway.hpp"
#include "support/paths.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>

namespace dpslave::test {
namespace {

/// A field of /proc/PID/status, KiB.
unsigned kib_of(pid_t pid, const std::string& field)
{
    std::ifstream file{fmt::format("/proc/{}/status", pid)};
    for (std::string name; file >> name;) {
        unsigned value = 0;
        if (name == field + ":" && file >> value) return value;
        file.ignore(1000, '\n');
    }
    return 0;
}

/// The limit is that of a program as it is shipped; without optimisation its own code is twice as large.
constexpr double kLimit = DPSLAVE_OPTIMISED ? 1.3 : 1.6;

TEST(Memory, OfTheDaemonIsNotMuchMoreThanThatOfItsLibraries)
{
    Process sleeper{{built_path("tests/locked_sleeper")}};
    if (!sleeper.says("locked")) GTEST_SKIP() << "this user may not lock memory";
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    if (gateway.daemon().ever_said("memory is not locked")) GTEST_SKIP() << "the daemon may not lock enough";

    const unsigned alone = kib_of(sleeper.pid(), "VmRSS");
    // [trace] bus_kib, samples_kib and drive_kib of a file that does not say them
    const unsigned recorder = 4096 + 256 + 128;
    const unsigned daemon = kib_of(gateway.daemon().pid(), "VmRSS") - recorder;
    const unsigned locked = kib_of(gateway.daemon().pid(), "VmLck") - recorder;
    ASSERT_GT(alone, 0U);
    const std::string said = fmt::format(
        "without its recorder the daemon has {} KiB and locks {}, its libraries alone have {}: {:.2f}",
        daemon, locked, alone, 1.0 * daemon / alone);
    fmt::print("{}\n", said);
    EXPECT_LE(daemon, kLimit * alone) << said;
    EXPECT_LE(locked, kLimit * alone) << said;
}

/// What a daemon with a recorder of this size has, KiB; nothing: it may not lock that much.
std::optional<unsigned> memory_with_recorder(unsigned kib)
{
    Gateway gateway{{.started = false}};
    write_file(gateway.config(), gateway.config_text() + fmt::format("\n[trace]\nbus_kib = {}\n", kib));
    gateway.start_daemon();
    Master master{gateway, {"--tags", "55,56w"}};
    EXPECT_TRUE(master.does("start 60s"));
    if (gateway.daemon().ever_said("memory is not locked")) return std::nullopt;
    return kib_of(gateway.daemon().pid(), "VmRSS");
}

TEST(Memory, GrowsByTheSizeOfTheRecorderAndByNoMore)
{
    constexpr unsigned kRecorder = 16384;
    const auto without = memory_with_recorder(0), with = memory_with_recorder(kRecorder);
    if (!without || !with) GTEST_SKIP() << "the daemon may not lock enough";

    constexpr unsigned kPages = 256; // from run to run
    EXPECT_GE(*with, *without + kRecorder - kPages);
    EXPECT_LE(*with, *without + kRecorder + kPages);
}

} // namespace
} // namespace dpslave::test
