// SPDX-License-Identifier: Apache-2.0
/// Turnaround of the daemon over a pty at 1.5 Mbit/s: Data_Exchange with 8 octets out and 32 in, telegram by
/// telegram in random order with a minimal null responder in the same run, so that whatever the machine does
/// meets both alike. A second null responder shows how much of a ratio is noise (A/A).
///
/// The time of a telegram runs from before the master's write to after its read of the reply: the pty and the
/// master's own waking are in it, for all responders the same. What counts as CPU is the daemon's bus thread:
/// it does all that a telegram asks for and wakes no thread. The other threads work by the clock, whether
/// telegrams come or not; the whole process with them is shown beside it.
#include "port.hpp"
#include "report.hpp"
#include "responder.hpp"
#include "support/gpio_stand_in/chip.hpp"

#include "dpslave/io/clock.hpp"

#include <CLI/CLI.hpp>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <random>
#include <stdexcept>

namespace dpslave::bench {
namespace {

using namespace std::chrono_literals;

struct Options {
    std::filesystem::path daemon;
    std::filesystem::path profiles;
    std::size_t telegrams = 20'000;
    std::uint32_t seed = 1;
    std::size_t runs = kRuns;
    std::string direction = "none"; ///< or "gpio": a line of a stand-in whose edges cost a system call each
    bool quick = false;
};

/// Stands in for the slot time: long enough that a busy machine is no lost telegram.
constexpr auto kSlot = 50ms;
/// MaxTsdr, in bit times, for a daemon that need not be fast (a debug build with sanitizers); no master takes
/// more.
constexpr unsigned kPatientTsdr = 1023;
/// No station may answer earlier: 11 bit times at 1.5 Mbit/s (wire reference 1.3).
const std::chrono::nanoseconds kMinTsdr = duration_of(Tbit{11}, Baud::k1500);
/// Between two telegrams; the shortest pause of a master at 1.5 Mbit/s (T_ID1) is 25 us.
constexpr auto kPause = 50us;

/// A folder that goes with its contents.
class Folder {
public:
    Folder() : path_((std::filesystem::temp_directory_path() / "dpslave-bench-XXXXXX").string())
    {
        if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error{"no temporary folder"};
    }
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path path() const { return path_; }

private:
    std::string path_;
};

/// A master that talks to one responder, with the frame count bit a request needs.
class Talk {
public:
    explicit Talk(Port& port) : port_(port) {}

    /// FC of the next request: 6D begins a sequence, then 5D and 7D in turn.
    std::uint8_t next_fc()
    {
        const std::uint8_t fc = fc_;
        fc_ = fc == 0x5D ? 0x7D : 0x5D;
        return fc;
    }

    struct Reply {
        Port::Answer answer;
        std::size_t retries = 0;
    };
    /// Repeats the request unchanged until it is answered, as a master does. Gives up after a second.
    std::optional<Reply> ask(const Octets& request)
    {
        constexpr std::size_t kTries = 20;
        for (std::size_t retries = 0; retries < kTries; ++retries) {
            if (auto answer = port_.exchange(request, kSlot)) {
                answer->time += retries * kSlot;
                return Reply{.answer = *answer, .retries = retries};
            }
            port_.drain();
        }
        return std::nullopt;
    }

private:
    Port& port_;
    std::uint8_t fc_ = 0x6D;
};

bool is_sc(const std::optional<Talk::Reply>& reply)
{
    return reply && reply->answer.frame.size() == 1 && reply->answer.frame[0] == 0xE5;
}

/// First two octets of Slave_Diag; throws if it is not answered for ten seconds.
std::array<std::uint8_t, 2> station_status(Talk& talk, Child& daemon)
{
    for (int i = 0; i < 10 && daemon.alive(); ++i) {
        const auto reply = talk.ask(slave_diag(talk.next_fc()));
        if (!reply) continue;
        const auto diagnosis = diagnosis_in(reply->answer.frame);
        if (diagnosis.empty()) throw std::runtime_error{"the answer to Slave_Diag is none"};
        return {diagnosis[0], diagnosis[1]};
    }
    throw std::runtime_error{daemon.alive() ? "the daemon does not answer Slave_Diag"
                                            : "the daemon has ended"};
}

/// Slave_Diag, Set_Prm, Chk_Cfg, and Slave_Diag until the station is ready.
void start_up(Talk& talk, Child& daemon)
{
    constexpr std::uint8_t kNotReady = 0x02;
    constexpr std::uint8_t kCfgFault = 0x04;
    constexpr std::uint8_t kPrmFault = 0x40;
    constexpr std::uint8_t kPrmReq = 0x01;
    constexpr std::uint8_t kStatDiag = 0x02;
    station_status(talk, daemon);
    if (!is_sc(talk.ask(set_prm(talk.next_fc())))) throw std::runtime_error{"Set_Prm is not acknowledged"};
    if (!is_sc(talk.ask(chk_cfg(talk.next_fc())))) throw std::runtime_error{"Chk_Cfg is not acknowledged"};
    const Instant limit = io::monotonic_now() + 10s;
    while (io::monotonic_now() < limit) {
        const auto [first, second] = station_status(talk, daemon);
        if ((first & (kCfgFault | kPrmFault)) != 0)
            throw std::runtime_error{"the daemon refuses the start-up"};
        if ((first & kNotReady) == 0 && (second & (kPrmReq | kStatDiag)) == 0) return;
        ::usleep(10'000);
    }
    throw std::runtime_error{"the station does not become ready"};
}

/// One responder with everything that is measured of it.
struct Target {
    Port& port;
    Talk talk{port};
    Sample sample;

    /// Throws if the answer is wrong, or there is none at all.
    void exchange()
    {
        static const Octets kFirst = data_exchange(0x6D);
        static const Octets kEven = data_exchange(0x5D);
        static const Octets kOdd = data_exchange(0x7D);
        const std::uint8_t fc = talk.next_fc();
        const auto reply = talk.ask(fc == 0x6D ? kFirst : fc == 0x5D ? kEven : kOdd);
        if (!reply) throw std::runtime_error{sample.name + " has fallen silent"};
        if (!is_data_exchange_reply(reply->answer.frame))
            throw std::runtime_error{sample.name + " gave a wrong answer to Data_Exchange"};
        sample.times.push_back(reply->answer.time);
        sample.retries += reply->retries;
    }
};

void pause()
{
    constexpr timespec kTime{.tv_sec = 0, .tv_nsec = std::chrono::nanoseconds{kPause}.count()};
    ::nanosleep(&kTime, nullptr);
}

/// `rounds` telegrams to each target, in an order that is drawn anew each round. `drive` is emptied now and
/// then: the daemon asks there for a drive that is not simulated.
void run(std::span<Target* const> targets, std::size_t rounds, std::mt19937& random, Port& drive)
{
    std::vector<Target*> order(targets.begin(), targets.end());
    for (std::size_t round = 0; round < rounds; ++round) {
        std::shuffle(order.begin(), order.end(), random);
        for (Target* const target : order) {
            pause();
            target->exchange();
        }
        if (round % 1000 == 0) drive.drain();
    }
}

/// Up and down once for each reply, and down in the end; throws if not. A request that comes while the last
/// reply would still be on a wire (a pty has none) finds the line active: then it goes down and up again
/// first, which is more than a real one costs.
void check_driver_enable(const stand_in::ChipFile& chip, std::size_t replies)
{
    const Instant limit = io::monotonic_now() + 1s;
    while (chip.high(kDriverLine) && io::monotonic_now() < limit) ::usleep(1'000);
    std::printf("driver enable: %u times up, %u times down\n", chip.rises(kDriverLine),
                chip.falls(kDriverLine));
    if (chip.high(kDriverLine) || chip.rises(kDriverLine) != chip.falls(kDriverLine) ||
        chip.rises(kDriverLine) < replies)
        throw std::runtime_error{"the driver enable was not switched for each reply"};
}

/// One run. The processor `cpu` is for the responders.
Ratios measure(const Options& options, const std::filesystem::path& folder, int cpu)
{
    const bool gpio = options.direction == "gpio";
    const stand_in::ChipFile chip{folder / "gpiochip0"};
    Port bus, null_bus, second_bus, hasty_bus, drive;
    Child daemon = start_daemon({.program = options.daemon,
                                 .profiles = options.profiles,
                                 .bus = bus.path(),
                                 .drive = drive.path(),
                                 .folder = folder,
                                 .gpio_chip = gpio ? chip.path() : std::filesystem::path{},
                                 .cpu = cpu,
                                 .max_tsdr = kPatientTsdr});
    Target board{.port = bus, .sample = {.name = "dpslaved"}};
    start_up(board.talk, daemon);
    const pid_t bus_thread = bus_thread_of(daemon.pid());
    Scheduling scheduling = scheduling_of(bus_thread);
    scheduling.cpu = cpu;

    const Octets reply = data_exchange_reply(0x00);
    Child null = start_null_responder(null_bus.path(), reply, scheduling, kMinTsdr);
    Child second = start_null_responder(second_bus.path(), reply, scheduling, kMinTsdr);
    Child hasty_one = start_null_responder(hasty_bus.path(), reply, scheduling, 0ns);
    Target base{.port = null_bus, .sample = {.name = "null responder"}};
    Target again{.port = second_bus, .sample = {.name = "null responder, a second one"}};
    Target hasty{.port = hasty_bus, .sample = {.name = "hasty one, without min T_SDR"}};

    const std::array<Target*, 4> targets{&board, &base, &again, &hasty};
    const std::array<const Child*, 4> processes{&daemon, &null, &second, &hasty_one};
    std::mt19937 random{options.seed};
    run(targets, std::min<std::size_t>(options.telegrams / 10, 1000), random,
        drive); // caches and queues warm up
    for (std::size_t i = 0; i < targets.size(); ++i) {
        targets[i]->sample.times.clear();
        targets[i]->sample.times.reserve(options.telegrams);
        targets[i]->sample.retries = 0;
        targets[i]->sample.cpu = -processes[i]->cpu();
    }
    const auto thread_before = cpu_of_thread(daemon.pid(), bus_thread);
    run(targets, options.telegrams, random, drive);
    const auto thread_used = cpu_of_thread(daemon.pid(), bus_thread) - thread_before;
    for (std::size_t i = 0; i < targets.size(); ++i) targets[i]->sample.cpu += processes[i]->cpu();

    std::printf(
        "Data_Exchange, 8 octets out and 32 in, pty set to 1.5 Mbit/s, %zu telegrams each in random order "
        "(seed %u), all responders %s, driver enable: %s\n",
        options.telegrams, options.seed, text(scheduling).c_str(), options.direction.c_str());
    Sample bus_only = board.sample;
    bus_only.name = "dpslaved, CPU of its bus thread";
    bus_only.cpu = thread_used;
    board.sample.name = "dpslaved, CPU of the whole process";
    print_header();
    for (const Sample* sample : {&bus_only, &board.sample, &base.sample, &again.sample, &hasty.sample})
        print(*sample);
    std::printf("ratios\n");
    const Ratios found = ratios(bus_only, base.sample);
    print("bus thread / null", found);
    print("whole process / null", ratios(board.sample, base.sample));
    print("null / null (A/A)", ratios(again.sample, base.sample));
    print("bus thread / hasty", ratios(bus_only, hasty.sample));
    if (gpio) check_driver_enable(chip, options.telegrams);
    return found;
}

void show_log(const std::filesystem::path& folder)
{
    std::ifstream log{folder / "log"};
    for (std::string line; std::getline(log, line);) std::fprintf(stderr, "  dpslaved: %s\n", line.c_str());
}

} // namespace
} // namespace dpslave::bench

int main(int argc, char** argv)
{
    using namespace dpslave::bench;
    Options options;
    CLI::App app{"Turnaround of dpslaved against a minimal null responder, over ptys.", "bench_turnaround"};
    app.footer(
        "Exit status: 0 all limits kept (or --quick) · 1 a limit broken · 2 wrong usage · 3 the bench could "
        "not run");
    app.add_option("--daemon", options.daemon, "The program dpslaved")->required()->check(CLI::ExistingFile);
    app.add_option("--profiles", options.profiles, "Its profile folder")
        ->required()
        ->check(CLI::ExistingDirectory);
    auto* number = app.add_option("--telegrams", options.telegrams, "To each responder")
                       ->capture_default_str()
                       ->check(CLI::Range(100, 10'000'000));
    auto* runs = app.add_option("--runs", options.runs, "The median of so many runs is judged")
                     ->capture_default_str()
                     ->check(CLI::Range(1, 1000));
    app.add_option("--seed", options.seed, "Of the order of the telegrams")->capture_default_str();
    app.add_option("--direction", options.direction,
                   "Driver enable of the daemon: none, or gpio (a stand-in)")
        ->capture_default_str()
        ->check(CLI::IsMember({"none", "gpio"}));
    app.add_flag("--quick", options.quick, "One run of 200 telegrams, nothing judged")
        ->excludes(number)
        ->excludes(runs);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (options.quick) {
        options.telegrams = 200;
        options.runs = 1;
    }
    const int cpu = reserve_cpu();
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL); // the pauses are short
    std::vector<Ratios> found;
    while (found.size() < options.runs) {
        const Folder folder;
        try {
            found.push_back(measure(options, folder.path(), cpu));
        } catch (const std::exception& error) {
            std::fprintf(stderr, "bench_turnaround: %s\n", error.what());
            show_log(folder.path());
            return 3;
        }
    }
    if (options.quick) {
        std::printf("not judged: too few telegrams\n");
        return 0;
    }
    const Ratios middle = median(found);
    print(options.runs == 1 ? "bus thread / null" : "bus thread / null, median", middle);
    return judge(middle, options.direction == "gpio" ? kGpioLimits : kLimits) ? 0 : 1;
}
