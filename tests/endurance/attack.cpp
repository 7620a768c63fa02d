// SPDX-License-Identifier: Apache-2.0
/// What users of the machine can do to the control socket, and what bus, service manager and memory notice of
/// it. The daemon and the null responder of tests/bench answer in turn under the same attacks: what the
/// machine does to a reply meets both alike. tools/run attack runs it, and tells what is judged.
#include "bench/responder.hpp"
#include "bus_master.hpp"
#include "installation.hpp"
#include "service_manager.hpp"
#include "support/paths.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

namespace dpslave::endurance {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kMostSilence = 2s;         ///< between two signs of life, at WatchdogSec=5
constexpr double kMostMissedMore = 0.001; ///< of all requests, than the null responder
constexpr double kMostMemory = 1.1;       ///< behind the attacks, of what it was before
constexpr double kNoise = 0.01;           ///< missed by the null responder without an attack
constexpr int kLeastTimes = 4;            ///< that an attack is made: misses come in bursts
constexpr int kMostTimes = 16;
constexpr uid_t kStrangers = 65530; ///< and the three behind it
constexpr auto kWatchdog = 5s;
constexpr auto kPatience = 10ms; ///< behind the slot time: what comes then is missed all the same

/// The slot time of the master, and what the daemon promises (max_tsdr). With the 150 bit times of the GSD it
/// would keep back replies that the null responder, which promises nothing, still gives within the slot.
constexpr unsigned kSlotBits = 300;

/// 11 bit times at 1.5 Mbit/s: no station may answer earlier.
constexpr auto kMinTsdr = 7334ns;

struct Attack {
    std::string what;
    std::string habit{}; ///< of attacker.py; empty: none
    unsigned users = 1;
    std::chrono::seconds time{};
    bool ends_by_itself = false; ///< behind what it has to send, not by the time
};

/// Of one attack.
struct Found {
    BusCounts daemon, null;
    std::chrono::nanoseconds silence{};
    std::uint64_t rss_kib = 0, peak_kib = 0;
    int times = 1;                          ///< that it was made
    bool is_attack = false;                 ///< not the time before or behind them
    std::vector<double> missed_more_each{}; ///< missed_more() of each time

    static double missed(const BusCounts& c)
    {
        return c.requests == 0
                   ? 0.0
                   : static_cast<double>(c.requests - c.in_time()) / static_cast<double>(c.requests);
    }
    double missed_more() const { return missed(daemon) - missed(null); }
    /// Of missed_more(): by the spread of the times, because misses come in bursts. Of a single time, as if
    /// each request were missed by chance alone.
    double standard_error() const
    {
        if (missed_more_each.size() > 1) {
            const auto count = static_cast<double>(missed_more_each.size());
            const double mean =
                std::accumulate(missed_more_each.begin(), missed_more_each.end(), 0.0) / count;
            double squares = 0;
            for (const double one : missed_more_each) squares += (one - mean) * (one - mean);
            return std::sqrt(squares / (count - 1) / count);
        }
        const auto variance = [](const BusCounts& c) {
            return c.requests == 0 ? 1.0 : missed(c) * (1 - missed(c)) / static_cast<double>(c.requests);
        };
        return std::sqrt(variance(daemon) + variance(null));
    }
    /// So many requests were made that chance does not decide whether the limit is kept.
    bool can_be_judged() const { return std::abs(missed_more() - kMostMissedMore) > 2 * standard_error(); }
};

BusCounts operator+(BusCounts a, const BusCounts& b)
{
    a.requests += b.requests;
    a.answers += b.answers;
    a.belated += b.belated;
    a.wrong += b.wrong;
    return a;
}

/// The same attack once more.
Found operator+(Found a, const Found& b)
{
    a.daemon = a.daemon + b.daemon;
    a.null = a.null + b.null;
    a.silence = std::max(a.silence, b.silence);
    a.rss_kib = b.rss_kib;
    a.peak_kib = std::max(a.peak_kib, b.peak_kib);
    a.times += b.times;
    a.missed_more_each.push_back(b.missed_more());
    return a;
}

BusCounts operator-(BusCounts a, const BusCounts& b)
{
    a.requests -= b.requests;
    a.answers -= b.answers;
    a.belated -= b.belated;
    a.wrong -= b.wrong;
    return a;
}

/// The master is another machine: nothing that happens here keeps it from its work for long.
bool run_as_master()
{
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(0, &one);
    sched_param param{};
    param.sched_priority = 50;
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL); // the pauses are short
    return ::sched_setaffinity(0, sizeof one, &one) == 0 && ::sched_setscheduler(0, SCHED_FIFO, &param) == 0;
}

bool may_run_as_master()
{
    bool may = false;
    std::thread{[&] { may = run_as_master(); }}.join();
    return may;
}

class Scene {
public:
    explicit Scene(int cpu)
        : installation_({.bus_port = bus_.port(),
                         .cpu = cpu,
                         .max_tsdr = kSlotBits,
                         .environment = {{"NOTIFY_SOCKET", folder_ / "notify"},
                                         {"WATCHDOG_USEC", std::to_string(kWatchdog / 1us)}}})
    {
        null_bus_.hold_open();
        null_ = std::make_unique<bench::Child>(
            bench::start_null_responder(null_bus_.port(), slave_.reply_with_values(),
                                        {.policy = SCHED_FIFO, .priority = 80, .cpu = cpu}, kMinTsdr));
        const auto limit = Clock::now() + 30s;
        while (!slave_.has_values() && Clock::now() < limit) bus_.exchange(slave_);
        if (!slave_.has_values()) throw std::runtime_error{"the station does not begin data exchange"};
    }

    Found measure(const Attack& attack)
    {
        manager_.take_longest_silence();
        const BusCounts daemon = bus_.counts(), null = null_bus_.counts();
        Found found;
        {
            std::vector<std::unique_ptr<Process>> attackers;
            for (unsigned i = 0; i < attack.users && !attack.habit.empty(); ++i)
                attackers.push_back(std::make_unique<Process>(
                    Arguments{"/usr/bin/python3", test::source_path("tests/system/attacker.py"),
                              installation_.socket(), std::to_string(kStrangers + i), attack.habit}));
            for (const auto& one : attackers)
                if (!one->says("attacking")) throw std::runtime_error{"an attacker does not start"};
            const std::jthread exchanging{[&](const std::stop_token& stop) { exchange(stop); }};
            const auto ends = Clock::now() + attack.time;
            while (Clock::now() < ends || (attack.ends_by_itself && !attackers.at(0)->wait(0s))) {
                std::this_thread::sleep_for(100ms);
                found.peak_kib = std::max(found.peak_kib, installation_.rss_kib());
                if (Clock::now() > ends + 5min) throw std::runtime_error{"an attack does not end"};
            }
        }
        found.daemon = bus_.counts() - daemon;
        found.null = null_bus_.counts() - null;
        await_sign_of_life();
        found.silence = manager_.take_longest_silence();
        found.rss_kib = installation_.rss_kib();
        found.missed_more_each = {found.missed_more()};
        return found;
    }

private:
    /// The silence that it ends belongs to what was before.
    void await_sign_of_life()
    {
        const auto now = Clock::now();
        while (manager_.last_sign_of_life() < now) {
            if (Clock::now() > now + 60s) throw std::runtime_error{"the watchdog is not fed any more"};
            std::this_thread::sleep_for(10ms);
        }
    }

    /// Daemon and null responder in random order, with a pause as a master makes it. Of both the same is
    /// asked, with the same patience.
    void exchange(const std::stop_token& stop)
    {
        run_as_master();
        const Octets request = slave_.request();
        while (!stop.stop_requested()) {
            const bool daemon_first = random_() % 2 == 0;
            for (const bool first : {true, false}) {
                std::this_thread::sleep_for(50us);
                if (first == daemon_first)
                    bus_.exchange_once(slave_, kPatience);
                else if (const auto reply = null_bus_.ask(request, kPatience);
                         reply && reply->size() != slave_.reply_with_values().size())
                    throw std::runtime_error{"the null responder gives a wrong reply"};
            }
        }
    }

    Folder folder_;
    dpslave::test::ServiceManager manager_{folder_ / "notify"};
    BusMaster bus_{0}, null_bus_{0};
    Installation installation_;
    SlaveTalk slave_{kFirst};
    std::unique_ptr<bench::Child> null_;
    std::mt19937 random_{1};
};

void print_row(const Attack& attack, const Found& f)
{
    fmt::print("| {} | {} | {} | {:.3f} % | {:.3f} % | {:+.3f} ± {:.3f} % | {:.2f} | {} | {} |\n",
               attack.what, f.times, f.daemon.requests, 100 * Found::missed(f.daemon),
               100 * Found::missed(f.null), 100 * f.missed_more(), 100 * f.standard_error(),
               std::chrono::duration<double>(f.silence).count(), f.rss_kib, f.peak_kib);
    std::fflush(stdout);
}

bool judge(const char* what, bool kept, bool decided = true)
{
    fmt::print("{}: {}\n", what, !kept ? "BROKEN" : decided ? "kept" : "not judged, chance still decides");
    return kept;
}

/// The exit status.
int judge(const std::vector<Found>& all)
{
    bool silence = true, missed = true, wrong = true, decided = true;
    for (const Found& f : all) {
        silence = silence && f.silence <= kMostSilence;
        wrong = wrong && f.daemon.wrong == 0;
        if (!f.is_attack) continue;
        missed = missed && (!f.can_be_judged() || f.missed_more() <= kMostMissedMore);
        decided = decided && f.can_be_judged();
    }
    const double memory = static_cast<double>(all.back().rss_kib) / static_cast<double>(all.front().rss_kib);
    fmt::print("\n");
    const std::array kept{
        judge("gap of the watchdog at most 2 s at WatchdogSec=5", silence),
        judge("missed answers at most those of the null responder and 0.1 %", missed, decided),
        judge("memory afterwards at most 10 % more", memory <= kMostMemory),
        judge("no wrong answer or value", wrong)};
    if (!std::all_of(kept.begin(), kept.end(), [](bool one) { return one; })) return 1;
    return decided ? 0 : 77;
}

/// Each attack several times, and again until chance does not decide, `most_times` at most.
std::vector<Found> attack_all(std::chrono::seconds time, int most_times)
{
    const std::vector<Attack> attacks{
        {.what = "none", .time = std::min(time, 5s)},
        {.what = "28 connections of four users, calls without end",
         .habit = "pipeline",
         .users = 4,
         .time = time},
        {.what = "1000 connections", .habit = "connects", .time = time},
        {.what = "28 connections that do not read", .habit = "slow", .users = 4, .time = time},
        {.what = "64 MiB that are no calls", .habit = "garbage", .time = 1s, .ends_by_itself = true},
        {.what = "none, after all of them", .time = std::min(time, 5s)},
    };
    Scene scene{static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN)) - 1};
    fmt::print("| attack | times | requests | missed by the daemon | by the null responder | difference "
               "| longest gap of the watchdog, s | RSS, KiB | highest RSS, KiB |\n"
               "|---|---|---|---|---|---|---|---|---|\n");
    std::vector<Found> all;
    for (const Attack& attack : attacks) {
        Found found = scene.measure(attack);
        found.is_attack = !attack.habit.empty();
        const int least_times = std::min(kLeastTimes, most_times);
        while (found.is_attack && found.times < most_times &&
               (found.times < least_times || !found.can_be_judged()))
            found = found + scene.measure(attack);
        all.push_back(found);
        print_row(attack, found);
    }
    return all;
}

} // namespace
} // namespace dpslave::endurance

int main(int argc, char** argv)
{
    using namespace dpslave::endurance;
    unsigned seconds = 25;
    bool quick = false;
    CLI::App app{"Attacks on the control socket, and what the bus notices of them.", "attack"};
    app.footer("Exit status: 0 all kept (or --quick) · 1 not so · 2 wrong usage · 3 it could not run · "
               "77 it cannot be judged here");
    auto* const time = app.add_option("--seconds", seconds, "Of each attack")
                           ->capture_default_str()
                           ->check(CLI::Range(1, 3600));
    app.add_flag("--quick", quick, "One second each, nothing judged")->excludes(time);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (::geteuid() != 0 || ::sysconf(_SC_NPROCESSORS_ONLN) < 2 || !may_run_as_master()) {
        std::fprintf(stderr,
                     "attack: it needs two processors, and root: for several users, and for SCHED_FIFO\n");
        return 77;
    }
    try {
        const auto found = attack_all(std::chrono::seconds{quick ? 1 : seconds}, quick ? 1 : kMostTimes);
        if (quick) return 0;
        if (Found::missed(found.front().null) > kNoise) {
            std::printf("\nNot judged: this machine is too busy. The null responder missed answers before "
                        "any attack.\n");
            return 77;
        }
        return judge(found);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "attack: %s\n", error.what());
        return 3;
    }
}
