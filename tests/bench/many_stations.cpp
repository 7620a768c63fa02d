// SPDX-License-Identifier: Apache-2.0
/// A daemon with 32 stations against one with a single station, telegram by telegram. No drive answers. Each
/// round has new processes, because where memory lies makes a difference of its own.
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

constexpr std::size_t kBlocksOfRound = 3; ///< seven rounds
constexpr std::size_t kMany = 32;

/// A daemon whose stations are asked in turn, as a master does it.
class Gateway {
public:
    Gateway(const Setup& setup, std::size_t stations)
        : daemon_(start_daemon({.program = setup.daemon,
                                .profiles = setup.profiles,
                                .bus = bus_.path(),
                                .drive = drive_.path(),
                                .folder = folder_.path(),
                                .cpu = setup.cpu,
                                .stations = stations}))
    {
        for (std::size_t i = 0; i < stations; ++i)
            talks_.emplace_back(bus_, static_cast<std::uint8_t>(kSlave + i)).start_up(daemon_);
        thread_ = bus_thread_of(daemon_.pid());
    }

    void begin_block(std::size_t telegrams)
    {
        times_.clear();
        times_.reserve(telegrams);
        drive_.drain();
        cpu_ = -cpu_of_thread(daemon_.pid(), thread_);
    }
    void exchange()
    {
        pause();
        times_.push_back(talks_[next_].exchange());
        next_ = (next_ + 1) % talks_.size();
    }
    void end_block() { cpu_ += cpu_of_thread(daemon_.pid(), thread_); }

    nanoseconds cpu() const { return cpu_; }
    nanoseconds p50() const { return quantile(times_, 0.5); }
    double memory() const { return static_cast<double>(resident_octets(daemon_.pid())) / 1024; }

private:
    Folder folder_;
    Port bus_, drive_;
    Child daemon_;
    std::vector<Talk> talks_;
    std::size_t next_ = 0;
    pid_t thread_ = 0;
    Times times_;
    nanoseconds cpu_{};
};

} // namespace

Findings measure_many_stations(const Setup& setup)
{
    Row cpu{.id = "M5",
            .metric = "CPU of the bus thread per telegram, 32 stations / 1",
            .limit = 1.10,
            .noise = Noise::p50};
    Row p50{.id = "M5", .metric = "turnaround p50, 32 stations / 1", .limit = 1.05, .noise = Noise::p50};
    Row memory{.id = "M5", .metric = "memory of a further station on the same line, kB", .limit = 64};
    std::mt19937 random{setup.seed};
    const std::size_t telegrams = setup.telegrams(2'000);
    std::vector<double> cpu_us;
    while (setup.goes_on(cpu.blocks.size())) {
        Gateway many{setup, kMany}, one{setup, 1}, again{setup, 1};
        std::array<Gateway*, 3> order{&many, &one, &again};
        const auto run = [&] {
            for (Gateway* const gateway : order) gateway->begin_block(telegrams);
            for (std::size_t i = 0; i < telegrams; ++i) {
                std::shuffle(order.begin(), order.end(), random);
                for (Gateway* const gateway : order) gateway->exchange();
            }
            pause();
            for (Gateway* const gateway : order) gateway->end_block();
        };
        run(); // caches and queues warm up
        for (std::size_t block = 0; block < std::min(kBlocksOfRound, setup.blocks()); ++block) {
            run();
            cpu.blocks.push_back(ratio(many.cpu(), one.cpu()));
            cpu.aa.push_back(ratio(again.cpu(), one.cpu()));
            p50.blocks.push_back(ratio(many.p50(), one.p50()));
            p50.aa.push_back(ratio(again.p50(), one.p50()));
            memory.blocks.push_back((many.memory() - one.memory()) / (kMany - 1));
            cpu_us.push_back(microseconds(one.cpu()) / static_cast<double>(telegrams));
        }
    }
    Findings found{.rows = {cpu, p50, memory}};
    found.notes.push_back(
        fmt::format("CPU of the bus thread with one station: {:.2f} us a telegram", median(cpu_us)));
    return found;
}

} // namespace dpslave::bench
