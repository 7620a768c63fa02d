// SPDX-License-Identifier: Apache-2.0
/// Turnaround over a pty at 1.5 Mbit/s: Data_Exchange with 8 octets out and 32 in, telegram by telegram in
/// random order with a minimal null responder in the same run, so that whatever the machine does meets both
/// alike. A second null responder shows how much of a ratio is noise (A/A).
///
/// The time of a telegram runs from before the master's write to after its read of the reply: the pty and the
/// master's own waking are in it, for all responders the same.
#include "measurements.hpp"
#include "statistics.hpp"
#include "support/gpio_stand_in/chip.hpp"
#include "talk.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <random>
#include <span>
#include <stdexcept>

namespace dpslave::bench {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

/// One responder with what is measured of it in a block.
struct Target {
    Target(Port& port, const Child& responder) : talk(port), process(responder) {}

    Talk talk;
    const Child& process;
    Times times{};         ///< paced
    nanoseconds cpu{};     ///< of the whole process, over the paced telegrams
    nanoseconds unpaced{}; ///< for all telegrams without a pause
    Times all{};           ///< of all blocks

    void begin_block(std::size_t telegrams)
    {
        all.insert(all.end(), times.begin(), times.end());
        times.clear();
        times.reserve(telegrams);
        cpu = -process.cpu();
    }
    void end_pace() { cpu += process.cpu(); }
    /// What was work: the wait for the window is a part of what every responder has to do.
    nanoseconds work() const { return cpu / static_cast<std::int64_t>(times.size()) - kMinTsdr; }
    double p(double share, const Target& base) const
    {
        return ratio(quantile(times, share), quantile(base.times, share));
    }
};

/// The daemon and the null responders, with the same scheduling, all on one processor.
struct Responders {
    explicit Responders(const Setup& setup) : chip(folder.path() / "gpiochip0")
    {
        daemon = start_daemon({.program = setup.daemon,
                               .profiles = setup.profiles,
                               .bus = bus.path(),
                               .drive = drive.path(),
                               .folder = folder.path(),
                               .gpio_chip = setup.gpio ? chip.path() : std::filesystem::path{},
                               .cpu = setup.cpu});
        board.talk.start_up(daemon);
        Scheduling scheduling = scheduling_of(bus_thread_of(daemon.pid()));
        scheduling.cpu = setup.cpu;
        const Octets reply = data_exchange_reply(0x00);
        null = start_null_responder(null_bus.path(), reply, scheduling, kMinTsdr);
        second = start_null_responder(second_bus.path(), reply, scheduling, kMinTsdr);
        hasty_one = start_null_responder(hasty_bus.path(), reply, scheduling, 0ns);
        conditions = text(scheduling);
    }

    Folder folder;
    stand_in::ChipFile chip;
    Port bus, null_bus, second_bus, hasty_bus, drive;
    Child daemon, null, second, hasty_one;
    std::string conditions;
    Target board{bus, daemon};
    Target base{null_bus, null};
    Target again{second_bus, second};
    Target hasty{hasty_bus, hasty_one};

    /// `rounds` telegrams to each but the hasty one, in an order that is drawn anew each round. That one has
    /// one in eight: it is there for information. The drive line is emptied now and then: the daemon asks
    /// there for a drive that is not simulated.
    void run(std::size_t rounds, std::mt19937& random)
    {
        std::array<Target*, 4> order{&board, &base, &again, &hasty};
        for (std::size_t round = 0; round < rounds; ++round) {
            const bool with_hasty = round % 8 == 0;
            std::shuffle(order.begin(), order.end(), random);
            for (Target* const target : order) {
                if (target == &hasty && !with_hasty) continue;
                pause();
                target->times.push_back(target->talk.exchange());
            }
            if (round % 1000 == 0) drive.drain();
        }
    }

    /// Each of the three in turn, several times, without a pause between its telegrams.
    void run_unpaced(std::size_t telegrams, std::mt19937& random)
    {
        constexpr int kTurns = 8;
        std::array<Target*, 3> order{&board, &base, &again};
        for (Target* const target : order) target->unpaced = {};
        for (int turn = 0; turn < kTurns; ++turn) {
            std::shuffle(order.begin(), order.end(), random);
            for (Target* const target : order) {
                const Instant begin = io::monotonic_now();
                for (std::size_t i = 0; i < telegrams / kTurns; ++i) target->talk.exchange();
                target->unpaced += io::monotonic_now() - begin;
            }
        }
    }

    void begin_block(std::size_t telegrams)
    {
        for (Target* const target : {&board, &base, &again, &hasty}) target->begin_block(telegrams);
    }
    void end_pace()
    {
        for (Target* const target : {&board, &base, &again, &hasty}) target->end_pace();
    }
};

std::string in_words(const char* name, const Target& target)
{
    return fmt::format("{:<16} p50 {:7.1f}  p99 {:7.1f}  p99.9 {:8.1f} us, repeated {}", name,
                       microseconds(quantile(target.all, 0.5)), microseconds(quantile(target.all, 0.99)),
                       microseconds(quantile(target.all, 0.999)), target.talk.retries());
}

void add_notes(const Responders& all, const std::vector<double>& hasty, Findings& found)
{
    found.notes.push_back("Data_Exchange, 8 octets out and 32 in, pty at 1.5 Mbit/s, all responders " +
                          all.conditions);
    found.notes.push_back(in_words("dpslaved", all.board));
    found.notes.push_back(in_words("null responder", all.base));
    found.notes.push_back(in_words("hasty one", all.hasty));
    found.notes.push_back(fmt::format("turnaround p50 / hasty one: {:.2f}", median(hasty)));
}

/// Up and down once for each reply, and down in the end; throws if not. A request that comes while the last
/// reply would still be on a wire (a pty has none) finds the line active: then it goes down and up again
/// first, which is more than a real one costs.
void check_driver_enable(const stand_in::ChipFile& chip, std::size_t replies)
{
    const Instant limit = io::monotonic_now() + 1s;
    while (chip.high(kDriverLine) && io::monotonic_now() < limit) ::usleep(1'000);
    if (chip.high(kDriverLine) || chip.rises(kDriverLine) != chip.falls(kDriverLine) ||
        chip.rises(kDriverLine) < replies)
        throw std::runtime_error{fmt::format("the driver enable was switched up {} times and down {} times "
                                             "for {} replies",
                                             chip.rises(kDriverLine), chip.falls(kDriverLine), replies)};
}

} // namespace

Findings measure_turnaround(const Setup& setup)
{
    Row p50{.id = "M1", .metric = "turnaround p50 / null", .limit = 1.05, .noise = Noise::p50};
    Row p99{.id = "M2", .metric = "turnaround p99 / null", .limit = 1.10, .noise = Noise::p99};
    Row p999{.id = "M2", .metric = "turnaround p99.9 / null", .limit = 1.5};
    Row cpu{.id = "M3",
            .metric = "CPU of the process per answered telegram / null",
            .limit = 1.10,
            .noise = Noise::p50};
    Row rate{.id = "M8",
             .metric = "telegrams per second without a pause / null",
             .limit = 0.95,
             .is_least = true,
             .noise = Noise::p50};
    std::vector<double> hasty;

    Responders all{setup};
    std::mt19937 random{setup.seed};
    const std::size_t telegrams = setup.telegrams(4'800); // 100 800 pairs in all blocks
    all.run(setup.telegrams(1'000), random);              // caches and queues warm up
    for (Target* const target : {&all.board, &all.base, &all.again, &all.hasty}) target->times.clear();
    for (std::size_t block = 0; setup.goes_on(block); ++block) {
        all.begin_block(telegrams);
        all.run(telegrams, random);
        all.end_pace();
        all.run_unpaced(setup.telegrams(2'000), random);
        for (const auto& [row, share] : {std::pair{&p50, 0.5}, {&p99, 0.99}, {&p999, 0.999}}) {
            row->blocks.push_back(all.board.p(share, all.base));
            row->aa.push_back(all.again.p(share, all.base));
        }
        cpu.blocks.push_back(ratio(all.board.work(), all.base.work()));
        cpu.aa.push_back(ratio(all.again.work(), all.base.work()));
        rate.blocks.push_back(ratio(all.base.unpaced, all.board.unpaced));
        rate.aa.push_back(ratio(all.base.unpaced, all.again.unpaced));
        hasty.push_back(all.board.p(0.5, all.hasty));
    }
    all.begin_block(0); // takes the times of the last one
    Findings found{.rows = {p50, p99, p999, cpu, rate}};
    found.curves["turnaround"] = {{"dpslaved", cumulative(all.board.all)},
                                  {"null responder", cumulative(all.base.all)}};
    add_notes(all, hasty, found);
    return found;
}

Findings measure_driver_enable(const Setup& setup)
{
    Row p50{.id = "gpio",
            .metric = "turnaround p50 with a driver enable / null without",
            .limit = 1.45,
            .noise = Noise::p50};
    std::vector<double> hasty;
    Responders all{setup};
    std::mt19937 random{setup.seed};
    const std::size_t telegrams = setup.telegrams(1'000);
    for (std::size_t block = 0; setup.goes_on(block); ++block) {
        all.begin_block(telegrams);
        all.run(telegrams, random);
        p50.blocks.push_back(all.board.p(0.5, all.base));
        p50.aa.push_back(all.again.p(0.5, all.base));
        hasty.push_back(all.board.p(0.5, all.hasty));
    }
    all.begin_block(0);
    check_driver_enable(all.chip, all.board.all.size());
    Findings found{.rows = {p50}};
    add_notes(all, hasty, found);
    found.notes.push_back(
        fmt::format("edges: {} up and {} down", all.chip.rises(kDriverLine), all.chip.falls(kDriverLine)));
    return found;
}

} // namespace dpslave::bench
