// SPDX-License-Identifier: Apache-2.0
/// The bus while the control socket has callers, against the same bus while strangers need as much of the
/// machine. What the daemon's other threads need for the callers counts for them. Callers of the recorder are
/// compared with a daemon that has none.
#include "load.hpp"
#include "measurements.hpp"
#include "statistics.hpp"
#include "talk.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <string>
#include <system_error>
#include <vector>

namespace dpslave::bench {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

/// The master keeps its pace whatever else the machine does: only the responder is measured. What it starts
/// has ordinary scheduling.
class RealTime {
public:
    RealTime() { set(SCHED_FIFO | SCHED_RESET_ON_FORK, 70); }
    ~RealTime()
    {
        const sched_param ordinary{};
        ::sched_setscheduler(0, SCHED_OTHER, &ordinary);
    }
    RealTime(const RealTime&) = delete;
    RealTime& operator=(const RealTime&) = delete;

private:
    static void set(int policy, int priority)
    {
        sched_param param{};
        param.sched_priority = priority;
        if (::sched_setscheduler(0, policy, &param) != 0)
            throw std::system_error{errno, std::system_category(), "sched_setscheduler"};
    }
};

class Bus {
public:
    /// `keys`: a table of the daemon's configuration.
    Bus(const Setup& setup, const char* keys)
        : daemon_(start_daemon({.program = setup.daemon,
                                .profiles = setup.profiles,
                                .bus = bus_.path(),
                                .drive = drive_.path(),
                                .folder = folder_.path(),
                                .cpu = setup.cpu,
                                .keys = keys})),
          talk_(bus_)
    {
        talk_.start_up(daemon_, Words::half_written);
        thread_ = bus_thread_of(daemon_.pid());
    }

    std::filesystem::path socket() const { return control_socket(folder_.path()); }
    /// Of all threads but that of the bus.
    nanoseconds cpu_beside_bus() const { return daemon_.cpu() - cpu_of_thread(daemon_.pid(), thread_); }

    /// Values change twenty times a second, so that those who follow them have something to show.
    Times run(nanoseconds time)
    {
        constexpr milliseconds kValueStands{50};
        drive_.drain();
        Times times;
        const RealTime scheduling;
        const Instant begin = io::monotonic_now();
        for (Instant now = begin; now < begin + time; now = io::monotonic_now()) {
            pause();
            const auto value = (now - begin) / kValueStands;
            times.push_back(talk_.exchange(static_cast<std::uint16_t>(value % 100)));
        }
        return times;
    }

private:
    Folder folder_;
    Port bus_, drive_;
    Child daemon_;
    Talk talk_;
    pid_t thread_ = 0;
};

/// What a measurement compares.
struct Comparison {
    const char* id = "";
    const char* metric = ""; ///< behind "turnaround p50, "
    CallerPlan callers;
    const char* without = nullptr; ///< a table of the daemon that the strangers meet; null: the same daemon
    milliseconds length{};         ///< of each arm
    const char* note = "";         ///< who the callers are
};

class Arms {
public:
    Arms(const Setup& setup, const Comparison& what)
        : setup_(setup), what_(what), bus_(setup, ""), length_(setup.quick ? milliseconds{200} : what.length)
    {
        if (what.without != nullptr) other_.emplace(setup, what.without);
        bus_.run(length_);
        idle_ = share_of([this] { return bus_.cpu_beside_bus(); }, [this] { bus_.run(length_); });
        with_callers();
    }

    Times with_callers()
    {
        const Callers callers{setup_.dpctl, bus_.socket(), what_.callers};
        Times times;
        bus_.run(milliseconds{200}); // they have begun by then
        const double share = share_of([&] { return callers.cpu() + bus_.cpu_beside_bus(); },
                                      [&] { times = bus_.run(length_); });
        needed_.push_back(share - idle_);
        return times;
    }

    Times with_strangers()
    {
        const Strangers strangers{std::clamp(needed(), 0.001, kMostOfAProcessor)};
        Bus& bus = other_ ? *other_ : bus_;
        Times times;
        bus.run(milliseconds{200});
        burnt_.push_back(share_of([&] { return strangers.cpu(); }, [&] { times = bus.run(length_); }));
        return times;
    }

    double needed() const { return median(needed_); } ///< share of a processor that callers needed
    double burnt() const { return median(burnt_); }   ///< and strangers

private:
    template <class Cpu, class Run>
    double share_of(Cpu cpu, Run run)
    {
        const nanoseconds before = cpu();
        const Instant begin = io::monotonic_now();
        run();
        return ratio(cpu() - before, io::monotonic_now() - begin);
    }

    static constexpr double kMostOfAProcessor = 0.9;

    const Setup& setup_;
    const Comparison& what_;
    Bus bus_;
    std::optional<Bus> other_; ///< of the strangers; none: bus_
    nanoseconds length_;
    double idle_ = 0;
    std::vector<double> needed_, burnt_;
};

Findings compare(const Setup& setup, const Comparison& what)
{
    const std::string metric = what.metric;
    Row p50{.id = what.id, .metric = "turnaround p50, " + metric, .limit = 1.05, .noise = Noise::p50};
    Row p99{.id = what.id, .metric = "turnaround p99, " + metric, .limit = 1.15, .noise = Noise::p99};
    std::mt19937 random{setup.seed};
    Arms arms{setup, what};
    enum Arm { callers, strangers, again };
    std::array<Arm, 3> order{callers, strangers, again};
    for (std::size_t block = 0; setup.goes_on(block); ++block) {
        std::array<Times, 3> times;
        std::shuffle(order.begin(), order.end(), random);
        for (const Arm arm : order)
            times.at(arm) = arm == callers ? arms.with_callers() : arms.with_strangers();
        for (const auto& [row, share] : {std::pair{&p50, 0.5}, {&p99, 0.99}}) {
            const nanoseconds base = quantile(times[strangers], share);
            row->blocks.push_back(ratio(quantile(times[callers], share), base));
            row->aa.push_back(ratio(quantile(times[again], share), base));
        }
    }
    Findings found{.rows = {p50, p99}};
    found.notes.push_back(
        fmt::format("{} need {:.1f} % of a processor with the daemon's share; the strangers burnt {:.1f} %",
                    what.note, 100 * arms.needed(), 100 * arms.burnt()));
    return found;
}

} // namespace

Findings measure_callers(const Setup& setup)
{
    const std::vector<const char*> values{"io", "--follow"};
    return compare(setup, {.id = "M9",
                           .metric = "callers / strangers",
                           .callers = {.follow = {4, values}, .ask = "status", .period = milliseconds{100}},
                           .length = milliseconds{700},
                           .note = "4 x dpctl io --follow and dpctl status at 10 Hz"});
}

Findings measure_watchers(const Setup& setup)
{
    const std::vector<const char*> trace{"trace", "--follow"}, top{"top"};
    return compare(setup, {.id = "M13",
                           .metric = "recorder and its readers / no recorder and strangers",
                           .callers = {.follow = {trace, trace, top}, .ask = "metrics", .period = seconds{1}},
                           .without = "[trace]\nbus_kib = 0\ndrive_kib = 0\n",
                           .length = seconds{1},
                           .note = "2 x dpctl trace --follow, dpctl top and dpctl metrics once a second"});
}

} // namespace dpslave::bench
