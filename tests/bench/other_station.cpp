// SPDX-License-Identifier: Apache-2.0
/// What a request to another station costs the bus thread, against a request of its own with its reply. On a
/// bus with many slaves nearly all telegrams are for others.
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

class Line {
public:
    explicit Line(const Setup& setup)
        : daemon_(start_daemon({.program = setup.daemon,
                                .profiles = setup.profiles,
                                .bus = bus_.path(),
                                .drive = drive_.path(),
                                .folder = folder_.path(),
                                .cpu = setup.cpu})),
          talk_(bus_)
    {
        talk_.start_up(daemon_);
        thread_ = bus_thread_of(daemon_.pid());
    }

    /// CPU of the bus thread for one own request with its reply, without the wait for the window.
    nanoseconds own(std::size_t telegrams)
    {
        return cpu_of_each(telegrams, [this] { talk_.exchange(); }) - kMinTsdr;
    }
    /// The same for a request to another station, which nobody answers.
    nanoseconds other(std::size_t telegrams)
    {
        return cpu_of_each(telegrams, [this] { bus_.send(request_); });
    }

private:
    template <class Ask>
    nanoseconds cpu_of_each(std::size_t telegrams, Ask ask)
    {
        drive_.drain(); // the daemon asks there for a drive that is not simulated
        ::nanosleep(&kReadByThen, nullptr);
        const nanoseconds before = cpu_of_thread(daemon_.pid(), thread_);
        for (std::size_t i = 0; i < telegrams; ++i) {
            ask();
            ::nanosleep(&kReadByThen, nullptr);
        }
        return (cpu_of_thread(daemon_.pid(), thread_) - before) / static_cast<std::int64_t>(telegrams);
    }

    Folder folder_;
    Port bus_, drive_;
    Child daemon_;
    Talk talk_;
    pid_t thread_ = 0;
    Octets request_ = data_exchange(kOtherStation, 0x6D);
};

} // namespace

Findings measure_other_station(const Setup& setup)
{
    Row row{.id = "M4",
            .metric = "CPU of a request to another station / own request with reply",
            .limit = 0.5,
            .noise = Noise::p50};
    Line line{setup};
    std::mt19937 random{setup.seed};
    const std::size_t telegrams = setup.telegrams(600) / kTurns;
    std::vector<double> own_us, other_us;
    line.own(telegrams);
    enum Arm { own, again, other };
    std::array<Arm, 3> order{own, again, other};
    for (std::size_t block = 0; setup.goes_on(block); ++block) {
        std::array<nanoseconds, 3> cpu{};
        for (int turn = 0; turn < kTurns; ++turn) {
            std::shuffle(order.begin(), order.end(), random);
            for (const Arm arm : order)
                cpu.at(arm) += (arm == other ? line.other(telegrams) : line.own(telegrams)) / kTurns;
        }
        row.blocks.push_back(ratio(cpu[other], cpu[own]));
        row.aa.push_back(ratio(cpu[again], cpu[own]));
        own_us.push_back(microseconds(cpu[own]));
        other_us.push_back(microseconds(cpu[other]));
    }
    Findings found{.rows = {row}};
    found.notes.push_back(fmt::format("CPU: own request with reply {:.2f} us, another station's {:.2f} us",
                                      median(own_us), median(other_us)));
    return found;
}

} // namespace dpslave::bench
