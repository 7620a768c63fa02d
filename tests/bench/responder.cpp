// SPDX-License-Identifier: Apache-2.0
#include "responder.hpp"

#include "support/paths.hpp"

#include "dpslave/io/fd.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace dpslave::bench {
namespace {

namespace fs = std::filesystem;

/// MaxTsdr, in bit times: no master takes more.
constexpr unsigned kPatientTsdr = 1023;

pid_t fork_child()
{
    const pid_t child = ::fork();
    if (child < 0) throw std::system_error{errno, std::system_category(), "fork"};
    if (child == 0) ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    return child;
}

void write_config(const DaemonSetup& setup, const fs::path& file)
{
    std::ofstream out{file};
    out << "[bus]\nport = \"" << setup.bus << "\"\nbaud = 1500000\n";
    if (setup.gpio_chip.empty())
        out << "direction = \"none\"\n";
    else
        out << "direction = \"gpio\"\ngpio_chip = \"" << setup.gpio_chip.string()
            << "\"\ngpio_line = " << kDriverLine << "\n";
    out << "max_tsdr = " << kPatientTsdr
        << "\n[realtime]\npriority = 80\nlock_memory = true\ncpu = " << setup.cpu << "\n"
        << "[control]\nsocket = " << control_socket(setup.folder) << "\n"
        << "[[line]]\nname = \"p3\"\nport = \"" << setup.drive
        << "\"\nprotocol = \"ei-ascii\"\nbaud = 9600\n";
    for (std::size_t i = 0; i < setup.stations; ++i)
        out << "[[station]]\nname = \"bench" << i << "\"\naddress = " << kSlave + i
            << "\nprofile = \"590\"\nline = \"p3\"\nunit = \"" << i / 10 << i % 10
            << "\"\nwhen_drive_lost = \"hold\"\n"; // there is none
    out << setup.keys;
    if (!out.flush()) throw std::runtime_error{file.string() + " cannot be written"};
}

/// A program that is started by hand may run on every processor, wherever the bench itself runs.
void may_run_everywhere()
{
    cpu_set_t all;
    std::memset(&all, 0xFF, sizeof all);
    ::sched_setaffinity(0, sizeof all, &all);
}

bool pin(int cpu)
{
    if (cpu < 0) return true;
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<std::size_t>(cpu), &set);
    return ::sched_setaffinity(0, sizeof set, &set) == 0;
}

std::chrono::nanoseconds read(clockid_t clock)
{
    timespec time{};
    if (::clock_gettime(clock, &time) != 0)
        throw std::system_error{errno, std::system_category(), "clock_gettime"};
    return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
}

/// All that the child does: as little as an answer can cost a slave that keeps its deadlines. Wait for octets
/// or the time, read, look at the length and the address, wait for `min_tsdr`, write.
[[noreturn]] void respond(const char* path, const Octets& reply, const Scheduling& scheduling,
                          std::chrono::nanoseconds min_tsdr)
{
    const int tty = ::open(path, O_RDWR | O_NOCTTY); // raw already; read() waits
    sched_param param{};
    param.sched_priority = scheduling.priority;
    if (tty < 0 || !pin(scheduling.cpu) || ::sched_setscheduler(0, scheduling.policy, &param) != 0)
        ::_exit(1);
    ::mlockall(MCL_CURRENT | MCL_FUTURE); // where the daemon may, this may
    std::array<std::uint8_t, 512> room;
    std::size_t have = 0;
    pollfd waiting{.fd = tty, .events = POLLIN, .revents = 0};
    const timespec heartbeat{.tv_sec = 0, .tv_nsec = 100'000'000};
    for (;;) {
        if (::ppoll(&waiting, 1, &heartbeat, nullptr) == 0) continue;
        const ssize_t got = ::read(tty, room.data() + have, room.size() - have);
        if (got <= 0) ::_exit(2);
        const auto opens = read(CLOCK_MONOTONIC) + min_tsdr;
        have += static_cast<std::size_t>(got);
        if (have < 6 || have < room[1] + std::size_t{6}) continue;
        const bool is_ours = room[0] == 0x68 && room[1] == room[2] && room[3] == 0x68 &&
                             have == room[1] + std::size_t{6} && ((room[4] ^ reply[5]) & 0x7F) == 0;
        have = 0;
        if (!is_ours) continue;
        while (min_tsdr.count() != 0 && read(CLOCK_MONOTONIC) < opens) {
        }
        if (::write(tty, reply.data(), reply.size()) != static_cast<ssize_t>(reply.size())) ::_exit(3);
    }
}

} // namespace

std::string text(const Scheduling& scheduling)
{
    std::string words = "ordinary scheduling";
    if (scheduling.policy != SCHED_OTHER) words = "policy " + std::to_string(scheduling.policy);
    if (scheduling.policy == SCHED_FIFO) words = "SCHED_FIFO " + std::to_string(scheduling.priority);
    return words + (scheduling.cpu < 0 ? ", not pinned" : ", processor " + std::to_string(scheduling.cpu));
}

Child::Child(Child&& other) noexcept : pid_(std::exchange(other.pid_, -1)) {}

Child& Child::operator=(Child&& other) noexcept
{
    std::swap(pid_, other.pid_);
    return *this;
}

Child::~Child()
{
    if (!alive()) return;
    ::kill(pid_, SIGTERM);
    constexpr timespec kPause{.tv_sec = 0, .tv_nsec = 10'000'000};
    for (int i = 0; i < 500 && alive(); ++i) ::nanosleep(&kPause, nullptr);
    if (!alive()) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
}

bool Child::alive()
{
    if (pid_ > 0 && ::waitpid(pid_, nullptr, WNOHANG) == pid_) pid_ = -1;
    return pid_ > 0;
}

std::chrono::nanoseconds Child::cpu() const
{
    clockid_t clock = 0;
    if (::clock_getcpuclockid(pid_, &clock) != 0)
        throw std::runtime_error{"a process has ended: its CPU time cannot be read"};
    return read(clock);
}

std::chrono::nanoseconds Child::wait()
{
    rusage used{};
    if (::wait4(std::exchange(pid_, -1), nullptr, 0, &used) < 0)
        throw std::system_error{errno, std::system_category(), "wait4"};
    const auto time = [](const timeval& value) -> std::chrono::nanoseconds {
        return std::chrono::seconds{value.tv_sec} + std::chrono::microseconds{value.tv_usec};
    };
    return time(used.ru_utime) + time(used.ru_stime);
}

Child start_child(const std::function<void()>& body)
{
    const pid_t child = fork_child();
    if (child == 0) {
        const sched_param ordinary{};
        ::sched_setscheduler(0, SCHED_OTHER, &ordinary);
        may_run_everywhere();
        body();
        ::_exit(127);
    }
    return Child{child};
}

std::chrono::nanoseconds cpu_of_caller()
{
    return read(CLOCK_THREAD_CPUTIME_ID);
}

int reserve_cpu()
{
    cpu_set_t mine;
    CPU_ZERO(&mine);
    if (::sched_getaffinity(0, sizeof mine, &mine) != 0 || CPU_COUNT(&mine) < 2) return -1;
    std::size_t last = CPU_SETSIZE - 1;
    while (!CPU_ISSET(last, &mine)) --last;
    CPU_CLR(last, &mine);
    if (::sched_setaffinity(0, sizeof mine, &mine) != 0) return -1;
    return static_cast<int>(last);
}

fs::path control_socket(const fs::path& folder)
{
    return folder / "control.sock";
}

Child start_daemon(const DaemonSetup& setup)
{
    const fs::path config = setup.folder / "dpslaved.toml";
    write_config(setup, config);
    const std::string log = setup.folder / "log";
    return start_child([&] {
        const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(out, STDOUT_FILENO);
        ::dup2(out, STDERR_FILENO);
        for (const char* name : {"NOTIFY_SOCKET", "JOURNAL_STREAM", "WATCHDOG_USEC"}) ::unsetenv(name);
        if (!setup.gpio_chip.empty())
            ::setenv("LD_LIBRARY_PATH", test::built_path("tests/gpio_stand_in").c_str(), 1);
        ::execl(setup.program.c_str(), setup.program.c_str(), "--config", config.c_str(), "--profiles",
                setup.profiles.c_str(), nullptr);
    });
}

pid_t bus_thread_of(pid_t daemon)
{
    pid_t best = daemon;
    int highest = -1;
    for (const auto& entry : fs::directory_iterator{"/proc/" + std::to_string(daemon) + "/task"}) {
        const pid_t thread = std::stoi(entry.path().filename());
        std::string name;
        std::getline(std::ifstream{entry.path() / "comm"}, name);
        if (name == "bus") return thread;
        if (const int priority = scheduling_of(thread).priority; priority > highest) {
            highest = priority;
            best = thread;
        }
    }
    return best;
}

Scheduling scheduling_of(pid_t thread)
{
    sched_param param{};
    Scheduling scheduling;
    scheduling.policy = ::sched_getscheduler(thread);
    if (scheduling.policy < 0 || ::sched_getparam(thread, &param) != 0)
        throw std::system_error{errno, std::system_category(), "sched_getscheduler"};
    scheduling.policy &= ~SCHED_RESET_ON_FORK;
    scheduling.priority = param.sched_priority;
    return scheduling;
}

std::chrono::nanoseconds cpu_of_thread(pid_t daemon, pid_t thread)
{
    // The CPU clock of a thread is for its own process only; the kernel's book of the scheduler is for all.
    std::ifstream book{"/proc/" + std::to_string(daemon) + "/task/" + std::to_string(thread) + "/schedstat"};
    std::int64_t ran = 0;
    book >> ran;
    return std::chrono::nanoseconds{ran};
}

std::size_t resident_octets(pid_t process)
{
    std::ifstream status{"/proc/" + std::to_string(process) + "/status"};
    std::string word;
    std::size_t kib = 0;
    while (status >> word)
        if (word == "VmRSS:") status >> kib;
    if (kib == 0) throw std::runtime_error{"a process has ended: its memory cannot be read"};
    return kib * 1024;
}

Child start_null_responder(const std::string& path, const Octets& reply, const Scheduling& scheduling,
                           std::chrono::nanoseconds min_tsdr)
{
    const pid_t child = fork_child();
    if (child == 0) respond(path.c_str(), reply, scheduling, min_tsdr);
    return Child{child};
}

} // namespace dpslave::bench
