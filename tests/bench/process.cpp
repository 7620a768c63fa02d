// SPDX-License-Identifier: Apache-2.0
/// M10 and M12: what the daemon takes to start, and its memory, against a program that links the same
/// libraries and does nothing.
#include "rows.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/fd.hpp"

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

namespace dpslave::bench {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr std::uint8_t kFirstStation = 5;
constexpr int kTries = 5;

struct Options {
    std::filesystem::path daemon, sleeper, profiles;
    std::filesystem::path folder; ///< of configuration, socket and log
    bool quick = false;
};

/// A pty; the daemon opens the end that has a name.
struct Pty {
    Pty() : near(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC))
    {
        if (!near || ::grantpt(near.get()) != 0 || ::unlockpt(near.get()) != 0)
            throw std::runtime_error{"no pty can be had"};
        name = ::ptsname(near.get());
        far = io::Fd{::open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
        termios raw{};
        ::tcgetattr(far.get(), &raw);
        ::cfmakeraw(&raw);
        ::tcsetattr(far.get(), TCSANOW, &raw);
    }

    io::Fd near, far; ///< the far one stays open, so that the daemon's end is no hang-up
    std::string name;
};

/// A program; SIGTERM and the wait for its end when it goes.
class Child {
public:
    /// What it says goes to `log`.
    Child(const std::vector<std::string>& command, const std::filesystem::path& log)
    {
        std::vector<char*> words;
        words.reserve(command.size() + 1);
        for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
        words.push_back(nullptr);
        posix_spawn_file_actions_t actions{};
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                           0600);
        ::posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
        if (::posix_spawn(&pid_, words[0], &actions, nullptr, words.data(), environ) != 0)
            throw std::runtime_error{command.front() + " cannot be started"};
        ::posix_spawn_file_actions_destroy(&actions);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child()
    {
        if (pid_ > 0) ::kill(pid_, SIGTERM);
        wait();
    }

    void wait()
    {
        if (pid_ > 0) ::waitpid(pid_, nullptr, 0);
        pid_ = -1;
    }
    /// A field of /proc/PID/status in KiB.
    unsigned kib(const std::string& field) const
    {
        std::ifstream file{fmt::format("/proc/{}/status", pid_)};
        for (std::string name; file >> name;) {
            unsigned value = 0;
            if (name == field + ":" && file >> value) return value;
            file.ignore(1000, '\n');
        }
        return 0;
    }

private:
    pid_t pid_ = -1;
};

/// The recorder keeps nothing: the memory of its rings is what the operator chose.
constexpr std::string_view kWithoutRings = "[trace]\nbus_kib = 0\nsamples_kib = 0\ndrive_kib = 0\n";

/// `trace`: the table of that name. Each station has a drive line of its own, as drives whose port is no bus
/// need it.
std::vector<std::string> daemon_command(const Options& options, const Pty& bus, const std::vector<Pty>& lines,
                                        std::string_view trace)
{
    const std::filesystem::path file = options.folder / "dpslaved.toml";
    std::ofstream out{file};
    out << fmt::format("[bus]\nport = \"{}\"\nbaud = 1500000\ndirection = \"none\"\nmax_tsdr = 1023\n"
                       "[control]\nsocket = \"{}\"\noperator_group = \"root\"\n"
                       "{}",
                       bus.name, (options.folder / "socket").string(), trace);
    for (std::size_t i = 0; i < lines.size(); ++i)
        out << fmt::format("[[line]]\nname = \"{0}\"\nport = \"{1}\"\nprotocol = \"ei-ascii\"\nbaud = 19200\n"
                           "[[station]]\nname = \"s{0}\"\naddress = {2}\nprofile = \"590\"\nline = \"{0}\"\n"
                           "unit = \"00\"\nwhen_drive_lost = \"hold\"\n",
                           i, lines[i].name, kFirstStation + i);
    if (!out.flush()) throw std::runtime_error{file.string() + " cannot be written"};
    return {options.daemon, "--config", file, "--profiles", options.profiles};
}

/// Asks for FDL_Status until it is answered.
void await_answer(const Pty& bus)
{
    constexpr std::uint8_t kMaster = 2, kFdlStatus = 0x49;
    constexpr std::array<std::uint8_t, 6> kRequest{
        0x10, kFirstStation, kMaster, kFdlStatus, kFirstStation + kMaster + kFdlStatus, 0x16};
    const Instant limit = io::monotonic_now() + 30s;
    while (io::monotonic_now() < limit) {
        if (::write(bus.near.get(), kRequest.data(), kRequest.size()) < 0)
            ::tcflush(bus.near.get(), TCOFLUSH); // nobody reads yet
        pollfd ready{.fd = bus.near.get(), .events = POLLIN, .revents = 0};
        constexpr timespec kSlot{.tv_sec = 0, .tv_nsec = 200'000};
        std::array<std::uint8_t, 6> reply{};
        if (::ppoll(&ready, 1, &kSlot, nullptr) <= 0) continue;
        if (::read(bus.near.get(), reply.data(), reply.size()) != static_cast<ssize_t>(reply.size()) ||
            reply[0] != kRequest[0] || reply[1] != kMaster || reply[2] != kFirstStation || reply[3] != 0)
            throw std::runtime_error{"what the daemon sends is no answer to FDL_Status"};
        return;
    }
    throw std::runtime_error{"the daemon does not answer FDL_Status"};
}

nanoseconds time_of(const std::function<void()>& what)
{
    const Instant began = io::monotonic_now();
    what();
    return io::monotonic_now() - began;
}

nanoseconds start_of_daemon(const Options& options)
{
    const Pty bus;
    const std::vector<Pty> lines(1);
    const auto command = daemon_command(options, bus, lines, "");
    std::optional<Child> daemon;
    return time_of([&] {
        daemon.emplace(command, options.folder / "log");
        await_answer(bus);
    });
}

nanoseconds start_of_libraries(const Options& options)
{
    const std::vector<std::string> command{options.sleeper, "exit"};
    return time_of([&] { Child{command, options.folder / "log"}.wait(); });
}

double median_ms(const std::vector<nanoseconds>& times)
{
    std::vector<double> ms;
    for (const nanoseconds one : times) ms.push_back(std::chrono::duration<double, std::milli>{one}.count());
    return median(ms);
}

Row measure_start(const Options& options)
{
    Row row{.id = "M10",
            .metric = "exec to the first answer to FDL_Status / exec to exit of the libraries",
            .limit = 2,
            .noise = Noise::p50};
    std::vector<double> daemon_ms, libraries_ms;
    std::mt19937 random{1};
    for (std::size_t block = 0; block < (options.quick ? 1 : kBlocks); ++block) {
        std::vector<nanoseconds> daemon, one, other;
        // The end of a daemon costs what is started behind it: in an order that is drawn it meets all alike.
        std::array<std::vector<nanoseconds>*, 3> order{&one, &daemon, &other};
        for (int i = 0; i < (options.quick ? 1 : 15); ++i) {
            std::shuffle(order.begin(), order.end(), random);
            for (auto* const times : order)
                times->push_back(times == &daemon ? start_of_daemon(options) : start_of_libraries(options));
        }
        daemon_ms.push_back(median_ms(daemon));
        libraries_ms.push_back(median_ms(one));
        row.blocks.push_back(daemon_ms.back() / libraries_ms.back());
        row.aa.push_back(median_ms(other) / libraries_ms.back());
    }
    fmt::print("    start of the daemon {:.2f} ms, of its libraries {:.2f} ms\n", median(daemon_ms),
               median(libraries_ms));
    return row;
}

void await_line(const std::filesystem::path& log, const std::string& words)
{
    const Instant limit = io::monotonic_now() + 30s;
    while (io::monotonic_now() < limit) {
        std::ifstream file{log};
        for (std::string line; std::getline(file, line);)
            if (line.find(words) != std::string::npos) return;
        ::usleep(20'000);
    }
    throw std::runtime_error{"nobody said: " + words};
}

double memory_of_libraries(const Options& options)
{
    const std::filesystem::path log = options.folder / "log";
    const Child sleeper{{options.sleeper}, log};
    await_line(log, "locked");
    return sleeper.kib("VmRSS");
}

/// When it has done everything once.
double memory_of_daemon(const Options& options, std::size_t stations, std::string_view trace)
{
    const Pty bus;
    const std::vector<Pty> lines(stations);
    const std::filesystem::path log = options.folder / "log";
    const Child daemon{daemon_command(options, bus, lines, trace), log};
    await_line(log, fmt::format("s{}: the drive does not answer", stations - 1));
    await_answer(bus);
    return daemon.kib("VmRSS");
}

Row measure_memory(const Options& options, std::size_t stations, double limit)
{
    Row row{.id = "M12",
            .metric = fmt::format("RSS without the recorder's / that of the libraries, locked: {} station{}",
                                  stations, stations == 1 ? "" : "s, each on a line of its own"),
            .limit = limit,
            .noise = Noise::p50};
    std::vector<double> daemons, libraries;
    for (std::size_t block = 0; block < (options.quick ? 1 : kBlocks); ++block) {
        libraries.push_back(memory_of_libraries(options));
        daemons.push_back(memory_of_daemon(options, stations, kWithoutRings));
        row.blocks.push_back(daemons.back() / libraries.back());
        row.aa.push_back(memory_of_libraries(options) / libraries.back());
    }
    fmt::print(
        "    {} station(s) {:.0f} kB, the libraries {:.0f} kB; with the recorder as shipped {:.0f} kB\n",
        stations, median(daemons), median(libraries), memory_of_daemon(options, stations, ""));
    return row;
}

std::vector<Row> measure(const Options& options)
{
    std::vector<Row> rows{measure_start(options)};
    for (int tried = 1; rows[0].is_noisy() && !options.quick && tried < kTries; ++tried)
        rows[0] = measure_start(options);
    rows.push_back(measure_memory(options, 1, 1.3));
    rows.push_back(measure_memory(options, 32, 1.6));
    return rows;
}

} // namespace
} // namespace dpslave::bench

int main(int argc, char** argv)
{
    using namespace dpslave::bench;
    Options options;
    std::filesystem::path json;
    CLI::App app{"Measures the start and the memory of dpslaved.", "bench_process"};
    app.footer("Exit status: 0 all limits kept (or --quick) · 1 a limit broken · 2 wrong usage · 3 the bench "
               "could not run · 77 the machine is too noisy");
    app.add_option("--daemon", options.daemon, "The program dpslaved")->required()->check(CLI::ExistingFile);
    app.add_option("--sleeper", options.sleeper, "A program with the same libraries")
        ->required()
        ->check(CLI::ExistingFile);
    app.add_option("--profiles", options.profiles, "The profile folder")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("--json", json, "File for the figures of each block");
    app.add_flag("--quick", options.quick, "One start each, nothing judged");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    std::string folder = (std::filesystem::temp_directory_path() / "dpslave-bench-XXXXXX").string();
    int status = 3;
    try {
        if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error{"no temporary folder"};
        options.folder = folder;
        const std::vector<Row> rows = measure(options);
        for (const Row& row : rows)
            fmt::print("{:<5} {:<70} {:7.3f}  A/A {:<6} limit {:<5} {}\n", row.id, row.metric, row.ratio(),
                       row.aa_ratio() ? fmt::format("{:.3f}", *row.aa_ratio()) : "-", row.limit,
                       options.quick ? "not judged" : verdict(row));
        if (!json.empty()) write_json(json, rows, nlohmann::json::object());
        status = options.quick ? 0 : exit_status(rows);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_process: {}\n", error.what());
    }
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
    return status;
}
