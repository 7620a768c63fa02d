// SPDX-License-Identifier: Apache-2.0
/// What a request to another station costs the bus thread, against a request of its own with its reply. On a
/// bus with many slaves nearly all telegrams are for others. The same of the null responder shows how much of
/// it is the kernel's.
#include "measurements.hpp"
#include "statistics.hpp"
#include "talk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>

namespace dpslave::bench {
namespace {

using std::chrono::nanoseconds;

constexpr int kTurns = 12; ///< of each arm in a block

/// Nothing tells the master that a request to another station was read: so long a pause, and it was, alone.
constexpr timespec kReadByThen{.tv_sec = 0, .tv_nsec = 100'000};

/// A responder's line, and the thread that answers there.
struct Line {
    Port& bus;
    Talk& talk;
    pid_t process = 0;
    pid_t thread = 0;

    /// CPU of the thread for one own request with its reply, without the wait for the window.
    nanoseconds own(std::size_t telegrams)
    {
        return cpu_of_each(telegrams, [this] { talk.exchange(); }) - kMinTsdr;
    }
    /// The same for a request to another station, which nobody answers.
    nanoseconds other(std::size_t telegrams)
    {
        static const Octets request = data_exchange(kOtherStation, 0x6D);
        return cpu_of_each(telegrams, [this] { bus.send(request); });
    }

private:
    template <class Ask>
    nanoseconds cpu_of_each(std::size_t telegrams, Ask ask) const
    {
        ::nanosleep(&kReadByThen, nullptr);
        const nanoseconds before = cpu_of_thread(process, thread);
        for (std::size_t i = 0; i < telegrams; ++i) {
            ask();
            ::nanosleep(&kReadByThen, nullptr);
        }
        return (cpu_of_thread(process, thread) - before) / static_cast<std::int64_t>(telegrams);
    }
};

/// The daemon, and the null responder on a line of its own.
struct LinePair {
    explicit LinePair(const Setup& setup)
        : daemon(start_daemon({.program = setup.daemon,
                               .profiles = setup.profiles,
                               .bus = bus.path(),
                               .drive = drive.path(),
                               .folder = folder.path(),
                               .cpu = setup.cpu}))
    {
        talk.start_up(daemon);
        const pid_t thread = bus_thread_of(daemon.pid());
        Scheduling scheduling = scheduling_of(thread);
        scheduling.cpu = setup.cpu;
        null = start_null_responder(null_bus.path(), data_exchange_reply(0x00), scheduling, kMinTsdr);
        board.process = daemon.pid();
        board.thread = thread;
        least.process = least.thread = null.pid();
    }

    Folder folder;
    Port bus, null_bus, drive;
    Child daemon, null;
    Talk talk{bus}, null_talk{null_bus};
    Line board{bus, talk}, least{null_bus, null_talk};
};

} // namespace

Findings measure_other_station(const Setup& setup)
{
    Row row{.id = "M4",
            .metric = "CPU of a request to another station / own request with reply",
            .limit = 0.5,
            .noise = Noise::p50};
    LinePair lines{setup};
    std::mt19937 random{setup.seed};
    const std::size_t telegrams = setup.telegrams(600) / kTurns;
    enum Arm { own, again, other, null_own, null_other };
    std::array<Arm, 5> order{own, again, other, null_own, null_other};
    std::array<std::vector<double>, 5> each;
    const auto measure = [&](Arm arm) {
        Line& line = arm < null_own ? lines.board : lines.least;
        lines.drive.drain(); // the daemon asks there for a drive that is not simulated
        return arm == other || arm == null_other ? line.other(telegrams) : line.own(telegrams);
    };
    for (const Arm arm : {own, null_own}) measure(arm);
    for (std::size_t block = 0; setup.goes_on(block); ++block) {
        std::array<nanoseconds, 5> cpu{};
        for (int turn = 0; turn < kTurns; ++turn) {
            std::shuffle(order.begin(), order.end(), random);
            for (const Arm arm : order) cpu.at(arm) += measure(arm) / kTurns;
        }
        row.blocks.push_back(ratio(cpu[other], cpu[own]));
        row.aa.push_back(ratio(cpu[again], cpu[own]));
        for (const Arm arm : order) each.at(arm).push_back(microseconds(cpu.at(arm)));
    }
    const auto in_words = [&each](const char* who, Arm mine, Arm others) {
        const double own_us = median(each.at(mine)), other_us = median(each.at(others));
        return fmt::format(
            "{:<14} CPU of an own request with reply {:5.2f} us, of another station's {:5.2f} us: "
            "{:.3f}",
            who, own_us, other_us, other_us / own_us);
    };
    Findings found{.rows = {row}};
    found.notes.push_back(in_words("dpslaved", own, other));
    found.notes.push_back(in_words("null responder", null_own, null_other));
    return found;
}

} // namespace dpslave::bench
