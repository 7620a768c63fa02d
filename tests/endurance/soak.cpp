// SPDX-License-Identifier: Apache-2.0
/// The daemon for hours on a segment that never pauses, with reloads, faults of the drives and clients that
/// come and go. In rounds of some seconds. After each round the bus stands still, and the daemon's counters
/// must equal the master's: every octet and request was heard, and each answer that is missing is counted.
/// tools/run soak runs it.
#include "bus_master.hpp"
#include "installation.hpp"
#include "support/paths.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

namespace dpslave::endurance {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using dpslave::test::Json;

constexpr std::size_t kWarmUp = 12;      ///< rounds: every disturbance was there at least twice
constexpr std::int64_t kMostGrowth = 64; ///< KiB
constexpr uid_t kStranger = 65534;
/// A busy machine delivers so many telegrams in pieces; more would be the fault of the receiver.
constexpr std::uint64_t kLeastTorn = 100, kRequestsOfTorn = 10'000;
constexpr std::size_t kEvents = 1000;          ///< that the daemon keeps
constexpr std::uint64_t kLongRun = 10'000'000; ///< telegrams: the memory is judged

struct Options {
    std::uint64_t telegrams = 100'000'000;
    std::size_t others = 5;
    unsigned round_ms = 5000;
    std::uint32_t seed = 1;
    std::string state{}; ///< file with what was reached; empty: none
    bool resume = false;
};

/// Of all runs that were resumed together.
struct Reached {
    std::uint64_t telegrams = 0, requests = 0, others = 0, missed = 0, differences = 0, torn = 0, belated = 0,
                  wrong = 0;
    std::uint64_t start_ups = 0, reloads = 0, refused_reloads = 0, drive_faults = 0, clients = 0, rounds = 0;
    std::int64_t growth_kib = 0; ///< the largest of all runs
    std::uint64_t runs = 0, seconds = 0;
    std::uint64_t failures = 0; ///< runs that could not go on: the daemon has gone, a command failed
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Reached, telegrams, requests, others, missed, differences, torn, belated,
                                   wrong, start_ups, reloads, refused_reloads, drive_faults, clients, rounds,
                                   growth_kib, runs, seconds, failures)

volatile std::sig_atomic_t interrupted = 0;

class Soak {
public:
    Soak(const Options& options, const Reached& before)
        : options_(options),
          reached_(before),
          random_(options.seed + static_cast<std::uint32_t>(before.rounds)),
          master_(options.others),
          installation_({.bus_port = master_.port()})
    {
        ++reached_.runs;
    }

    /// True: everything was as it must be.
    bool run()
    {
        const auto began = Clock::now();
        const std::uint64_t seconds_before = reached_.seconds;
        if (reached_.telegrams < options_.telegrams && options_.telegrams >= kLongRun) fill_the_history();
        while (reached_.telegrams < options_.telegrams && interrupted == 0 && good()) {
            try {
                one_round();
                check();
            } catch (...) { // a daemon that has gone is not made good by --resume
                ++reached_.failures;
                keep();
                throw;
            }
            reached_.seconds = seconds_before + static_cast<std::uint64_t>((Clock::now() - began) / 1s);
            show_progress();
            keep();
        }
        return good();
    }

    bool good() const
    {
        return reached_.differences == 0 && reached_.wrong == 0 && reached_.failures == 0 &&
               reached_.torn <= kLeastTorn + reached_.requests / kRequestsOfTorn &&
               reached_.growth_kib < kMostGrowth;
    }
    const Reached& reached() const { return reached_; }
    bool warm() const { return round_ > kWarmUp; }

private:
    /// The daemon keeps its newest events. They grow until it has so many.
    void fill_the_history()
    {
        for (std::size_t i = 0; i < kEvents; ++i)
            installation_.dpctl(
                {"write", "--station", "6", "62", fmt::format("{:.1f}", 0.1 * static_cast<double>(i))});
        const auto events = Json::parse(installation_.dpctl({"--json", "events"}).out).at("events");
        if (events.size() < kEvents) throw std::runtime_error{"the history of events does not fill"};
    }

    /// In four rounds a station comes, is served and leaves. It is not asked while it comes or leaves: nobody
    /// counts the requests to a station that is not there.
    void one_round()
    {
        const auto ends = Clock::now() + std::chrono::milliseconds{options_.round_ms};
        const bool visited = round_ % 4 == 2, comes = round_ % 4 == 1;
        std::vector<SlaveTalk*> slaves{&first_, &second_};
        if (visited) slaves.push_back(&visitor_);
        if (comes) visitor_.restart();
        {
            const std::jthread serving{[&](const std::stop_token& stop) { master_.serve(stop, slaves); }};
            disturb_by_clients();
            disturb_the_drives();
            reload(visited || comes);
            std::this_thread::sleep_until(ends);
        }
        ++round_;
        ++reached_.rounds;
    }

    /// One that the served stations must not notice, and one that is refused.
    void reload(bool with_visitor)
    {
        if (!installation_.reload(with_visitor, 1 + static_cast<unsigned>(round_ % 3)))
            throw std::runtime_error{"a reload failed"};
        ++reached_.reloads;
        if (!installation_.reload_with_fault())
            throw std::runtime_error{"a faulty configuration was not refused"};
        ++reached_.refused_reloads;
    }

    void disturb_the_drives()
    {
        static constexpr std::array kFaults{"silence", "slow 50ms", "late 300ms", "spoil 1/3", "nak"};
        installation_.drive().send_line(kFaults[round_ % kFaults.size()]);
        std::this_thread::sleep_for(some(200, 1500));
        installation_.drive().send_line("ok");
        if (round_ % 6 == 5) {
            installation_.unplug_drive();
            std::this_thread::sleep_for(some(50, 500));
            installation_.plug_drive();
        }
        ++reached_.drive_faults;
    }

    void disturb_by_clients()
    {
        {
            Process attacker{{"/usr/bin/python3", test::source_path("tests/system/attacker.py"),
                              installation_.socket(),
                              std::to_string(::geteuid() == 0 ? kStranger : ::geteuid())}};
            if (!attacker.says("attacking", kPatience))
                throw std::runtime_error{"the attacker does not start"};
            Process follower{installation_.dpctl_command({"status", "--follow"})};
            for (const Arguments& one : {Arguments{"status"}, {"counters"}, {"diag"}, {"io"}, {"show"}})
                if (installation_.dpctl(one).status != 0)
                    throw std::runtime_error{"dpctl " + one[0] + " failed"};
            // The drive may be silent: then they end with an error.
            installation_.dpctl({"read", "--station", "5", "62"});
            installation_.dpctl({"write", "--station", "6", "62", "100.0"});
        }
        reached_.clients += 208; // the attacker has 200 connections, and comes back with those that it loses
    }

    /// The bus stands still. Waits until the daemon has heard all that was sent, and compares.
    void check()
    {
        const BusCounts& sent = master_.counts();
        DaemonCounts daemon = installation_.counts();
        for (int i = 0; i < 100 && (daemon.octets != sent.octets || daemon.answers != sent.answers); ++i) {
            std::this_thread::sleep_for(100ms); // what is held up on its way comes meanwhile
            master_.take_what_is_late();
            daemon = installation_.counts();
        }
        // On a busy machine a pty may deliver a telegram in two pieces with a pause between them: a flaw.
        // What such a request is missed by is counted as that.
        const std::uint64_t unheard = sent.requests - daemon.requests;
        if (daemon.octets != sent.octets || daemon.answers != sent.answers ||
            sent.missed() != daemon.missed + unheard || unheard > daemon.flaws) {
            fmt::print("the daemon counts otherwise than the master:\n"
                       "             octets      requests       answers        missed  flaws\n"
                       "  master {:>10} {:>13} {:>13} {:>13}\n  daemon {:>10} {:>13} {:>13} {:>13} {:>6}\n",
                       sent.octets, sent.requests, sent.answers, sent.missed(), daemon.octets,
                       daemon.requests, daemon.answers, daemon.missed, daemon.flaws);
            ++reached_.differences;
        }
        reached_.torn += daemon.flaws - flaws_before_;
        flaws_before_ = daemon.flaws;
        const std::uint64_t start_ups = first_.start_ups() + second_.start_ups() + visitor_.start_ups();
        reached_.telegrams += sent.telegrams() - before_.telegrams();
        reached_.requests += sent.requests - before_.requests;
        reached_.others += sent.others - before_.others;
        reached_.missed += sent.missed() - before_.missed();
        reached_.belated += sent.belated - before_.belated;
        reached_.wrong += sent.wrong - before_.wrong;
        reached_.start_ups += start_ups - start_ups_before_;
        before_ = sent;
        start_ups_before_ = start_ups;

        rss_kib_ = static_cast<std::int64_t>(installation_.rss_kib());
        if (round_ == kWarmUp) warm_kib_ = rss_kib_;
        if (warm()) reached_.growth_kib = std::max(reached_.growth_kib, rss_kib_ - warm_kib_);
    }

    void show_progress() const
    {
        fmt::print("{:>11} of {} telegrams, {:>5} s, round {}: {} requests, {} missed, {} differences, "
                   "{} wrong, RSS {} KiB{}\n",
                   reached_.telegrams, options_.telegrams, reached_.seconds, reached_.rounds,
                   reached_.requests, reached_.missed, reached_.differences, reached_.wrong, rss_kib_,
                   warm() ? fmt::format(" ({:+})", rss_kib_ - warm_kib_) : " (warming up)");
        std::fflush(stdout);
    }

    void keep() const
    {
        if (options_.state.empty()) return;
        test::write_file(options_.state + ".new", Json(reached_).dump(2) + "\n");
        std::filesystem::rename(options_.state + ".new", options_.state);
    }

    std::chrono::milliseconds some(int least, int most)
    {
        return std::chrono::milliseconds{std::uniform_int_distribution{least, most}(random_)};
    }

    const Options& options_;
    Reached reached_;
    std::mt19937 random_;
    BusMaster master_;
    Installation installation_;
    SlaveTalk first_{kFirst}, second_{kSecond}, visitor_{kVisitor};
    std::size_t round_ = 0;
    BusCounts before_;
    std::uint64_t start_ups_before_ = 0, flaws_before_ = 0;
    std::int64_t rss_kib_ = 0, warm_kib_ = 0;
};

void show_result(const Reached& r)
{
    fmt::print("\n| | |\n|---|---|\n"
               "| telegrams on the bus | {} |\n| of them requests to the daemon | {} |\n"
               "| of them telegrams of other stations | {} |\n"
               "| answers missed | {} |\n| rounds in which the daemon counted otherwise | {} |\n"
               "| flaws: telegrams that the pty delivered in pieces | {} |\n"
               "| answers behind the slot time of 200 us, as the master saw it | {} |\n"
               "| wrong answers or values | {} |\n| start-ups | {} |\n| reloads taken, refused | {}, {} |\n"
               "| faults of the drives | {} |\n| connections of clients, at least | {} |\n"
               "| growth of the RSS after the warm-up, largest | {} KiB |\n"
               "| runs, time | {}, {} s |\n",
               r.telegrams, r.requests, r.others, r.missed, r.differences, r.torn, r.belated, r.wrong,
               r.start_ups, r.reloads, r.refused_reloads, r.drive_faults, r.clients, r.growth_kib, r.runs,
               r.seconds);
}

Reached state_of(const Options& options)
{
    if (!options.resume) return {};
    std::ifstream file{options.state};
    if (!file) throw std::runtime_error{options.state + " cannot be read: there is nothing to resume"};
    return Json::parse(file).get<Reached>();
}

} // namespace
} // namespace dpslave::endurance

int main(int argc, char** argv)
{
    using namespace dpslave::endurance;
    Options options;
    CLI::App app{"The daemon for hours on a bus without a pause.", "soak"};
    app.footer(
        "Exit status: 0 all as it must be · 1 not so · 2 wrong usage · 3 it could not run · 130 interrupted");
    app.add_option("--telegrams", options.telegrams, "On the bus, of all stations")->capture_default_str();
    app.add_option("--others", options.others,
                   "Exchanges of other stations before each request to the daemon")
        ->capture_default_str()
        ->check(
            CLI::Range(0, 8)); // more would not arrive in one piece: a pty hands over 512 octets at a time
    app.add_option("--round-ms", options.round_ms, "Time between two comparisons")
        ->capture_default_str()
        ->check(CLI::Range(100, 600'000));
    app.add_option("--seed", options.seed, "Of the pauses")->capture_default_str();
    auto* const state = app.add_option("--state", options.state, "File that keeps what was reached");
    app.add_flag("--resume", options.resume, "Go on from there")->needs(state);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
    try {
        Soak soak{options, state_of(options)};
        const bool good = soak.run();
        show_result(soak.reached());
        if (!good) return 1;
        if (interrupted != 0) return 130;
        if (!soak.warm()) fmt::print("The memory was not judged: the run was too short.\n");
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "soak: %s\n", error.what());
        return 3;
    }
}
