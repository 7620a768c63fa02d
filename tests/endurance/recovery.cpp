// SPDX-License-Identifier: Apache-2.0
/// How long the station is off the bus when the daemon is killed, when one of its threads hangs, and when the
/// machine has lost its power. A simulated service manager restarts the daemon as dpslaved.service says:
/// WatchdogSec=, ExecStopPost=, RestartSec=. tools/run recovery runs it.
#include "bus_master.hpp"
#include "installation.hpp"
#include "service_manager.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace dpslave::endurance {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// What dpslaved.service says.
struct Unit {
    Seconds watchdog{}, restart{};
};

Seconds value_of(const std::string& unit, const std::string& key)
{
    const auto at = unit.find("\n" + key + "=");
    if (at == std::string::npos) throw std::runtime_error{"the unit has no " + key};
    return Seconds{std::stod(unit.substr(at + key.size() + 2))};
}

Unit read_unit(const std::string& path)
{
    const std::string text = test::content(path);
    return {.watchdog = value_of(text, "WatchdogSec"), .restart = value_of(text, "RestartSec")};
}

enum class Fault : std::uint8_t { killed, bus_thread_hangs, main_thread_hangs, power_lost };
constexpr std::array kFaults{Fault::killed, Fault::bus_thread_hangs, Fault::main_thread_hangs,
                             Fault::power_lost};

std::string_view text(Fault fault)
{
    switch (fault) {
        case Fault::killed: return "kill -9";
        case Fault::bus_thread_hangs: return "the bus thread hangs";
        case Fault::main_thread_hangs: return "the main thread hangs";
        case Fault::power_lost: return "power loss: the program starts";
    }
    return {};
}

/// From the fault on.
struct Recovery {
    Seconds ended{};     ///< the process was gone
    Seconds started{};   ///< the next one was started
    Seconds answered{};  ///< first answer to FDL_Status
    Seconds exchanged{}; ///< first Data_Exchange with the values of the drive
};

/// Holds one thread of a process where it is, as a debugger does. It ends with the process.
void hold(pid_t thread)
{
    if (::ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0 ||
        ::ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) != 0 ||
        ::waitpid(thread, nullptr, __WALL) != thread)
        throw std::runtime_error{"a thread of the daemon cannot be held: is ptrace permitted?"};
}

pid_t bus_thread_of(pid_t process)
{
    for (const auto& task : std::filesystem::directory_iterator{fmt::format("/proc/{}/task", process)})
        if (test::content(task.path() / "comm") == "bus") return std::stoi(task.path().filename());
    throw std::runtime_error{"the daemon has no bus thread"};
}

class Scene {
public:
    explicit Scene(const Unit& unit) : unit_(unit)
    {
        bus_.hold_open();
        installation_ = std::make_unique<Installation>(Setup{
            .bus_port = bus_.port(),
            .environment = {
                {"NOTIFY_SOCKET", folder_ / "notify"},
                {"WATCHDOG_USEC", std::to_string(static_cast<std::uint64_t>(unit.watchdog.count() * 1e6))}}});
        await_exchange();
    }

    Recovery recover(Fault fault)
    {
        const auto began = Clock::now();
        const auto passed = [&] { return Seconds{Clock::now() - began}; };
        Recovery found;
        end_by(fault);
        found.ended = passed();
        if (fault == Fault::power_lost) return from_nothing();
        // As the unit has it: ExecStopPost=, then the pause, then ExecStart=.
        installation_->release();
        std::this_thread::sleep_for(unit_.restart);
        found.started = passed();
        installation_->start_daemon();
        await_answer();
        found.answered = passed();
        await_exchange();
        found.exchanged = passed();
        return found;
    }

private:
    /// The boot of the machine is not in it: the clock starts with the program.
    Recovery from_nothing()
    {
        installation_->unplug_drive();
        installation_->plug_drive();
        const auto began = Clock::now();
        Recovery found;
        installation_->start_daemon();
        await_answer();
        found.answered = Clock::now() - began;
        await_exchange();
        found.exchanged = Clock::now() - began;
        return found;
    }

    void end_by(Fault fault)
    {
        Process& daemon = installation_->daemon();
        if (fault == Fault::killed || fault == Fault::power_lost) {
            daemon.end(SIGKILL);
            return;
        }
        const pid_t thread = fault == Fault::bus_thread_hangs ? bus_thread_of(daemon.pid()) : daemon.pid();
        hold(thread);
        // What the service manager does when no sign of life has come for WatchdogSec=.
        while (Clock::now() - manager_.last_sign_of_life() < unit_.watchdog) std::this_thread::sleep_for(1ms);
        daemon.send(SIGABRT);
        if (thread != daemon.pid())
            ::waitpid(thread, nullptr, __WALL); // a thread that is held ends before its process
        if (!daemon.wait()) throw std::runtime_error{"the daemon does not end by SIGABRT"};
    }

    void await_answer()
    {
        const Octets question = ::test::sd1(kFirst, kMaster, 0x49);
        const auto limit = Clock::now() + 30s;
        while (!bus_.ask(question, 1ms)) {
            bus_.forget_unread(); // nobody has heard it
            if (Clock::now() > limit) throw std::runtime_error{"the daemon does not answer"};
        }
    }

    void await_exchange()
    {
        slave_.restart();
        const auto limit = Clock::now() + 30s;
        do {
            bus_.exchange(slave_);
            if (Clock::now() > limit) throw std::runtime_error{"the station does not begin data exchange"};
        } while (!slave_.has_values());
    }

    Unit unit_;
    Folder folder_;
    dpslave::test::ServiceManager manager_{folder_ / "notify"};
    BusMaster bus_{0};
    SlaveTalk slave_{kFirst};
    std::unique_ptr<Installation> installation_;
};

double quantile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

/// A row: p50 / p99 / longest.
void print_row(Fault fault, const std::string& what, const std::vector<Recovery>& all,
               Seconds Recovery::*from, Seconds Recovery::*to)
{
    std::vector<double> values;
    for (const Recovery& one : all)
        values.push_back((one.*to - (from != nullptr ? one.*from : Seconds{})).count());
    fmt::print("| {} | {} | {:.3f} | {:.3f} | {:.3f} |\n", text(fault), what, quantile(values, 0.5),
               quantile(values, 0.99), quantile(values, 1));
}

void print(Fault fault, const std::vector<Recovery>& all)
{
    if (fault != Fault::power_lost) {
        print_row(fault, "until the process is gone", all, nullptr, &Recovery::ended);
        print_row(fault, "from there to the next start", all, &Recovery::ended, &Recovery::started);
    }
    print_row(fault, "from the start to the first answer", all, &Recovery::started, &Recovery::answered);
    print_row(fault, "**in all, to data exchange with values**", all, nullptr, &Recovery::exchanged);
    std::fflush(stdout);
}

void run(const Unit& unit, unsigned times)
{
    Scene scene{unit};
    fmt::print("WatchdogSec={:g}, RestartSec={:g}, {} times each\n\n| fault | s | p50 | p99 | longest |\n"
               "|---|---|---|---|---|\n",
               unit.watchdog.count(), unit.restart.count(), times);
    for (const Fault fault : kFaults) {
        std::vector<Recovery> all;
        for (unsigned i = 0; i < times; ++i) all.push_back(scene.recover(fault));
        print(fault, all);
    }
}

} // namespace
} // namespace dpslave::endurance

int main(int argc, char** argv)
{
    using namespace dpslave::endurance;
    unsigned times = 100;
    std::string unit;
    CLI::App app{"How long a station is off the bus after a fault of its daemon.", "recovery"};
    app.footer("Exit status: 0 it came back each time · 2 wrong usage · 3 not so, or it could not run");
    app.add_option("--times", times, "Each fault")->capture_default_str()->check(CLI::Range(1, 100'000));
    app.add_option("--unit", unit, "dpslaved.service")->required()->check(CLI::ExistingFile);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const rlimit none{};
    ::setrlimit(RLIMIT_CORE, &none);
    try {
        run(read_unit(unit), times);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "recovery: %s\n", error.what());
        return 3;
    }
}
