// SPDX-License-Identifier: Apache-2.0
#include "process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <iostream>
#include <system_error>

namespace dpslave::test {
namespace {

/// Lines of each transcript that are shown when a test has failed.
constexpr std::size_t kShownOfAFailure = 200;
/// Lines of a transcript that are shown when something was not said in time.
constexpr std::size_t kShown = 25;

[[noreturn]] void fail(const std::string& what)
{
    throw std::system_error{errno, std::system_category(), what};
}

struct Pipe {
    Pipe()
    {
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
    }
    std::array<int, 2> ends{};
    int read_end() const { return ends[0]; }
    int write_end() const { return ends[1]; }
};

/// As exec wants it: pointers to strings that live somewhere else, closed by a null pointer.
std::vector<char*> pointers(std::vector<std::string>& strings)
{
    std::vector<char*> result;
    for (std::string& one : strings) result.push_back(one.data());
    result.push_back(nullptr);
    return result;
}

/// The test's own, without the variables of a service manager, and with `more`.
std::vector<std::string> environment_with(const Environment& more)
{
    Environment all;
    for (char** one = environ; *one != nullptr; ++one) {
        const std::string_view entry{*one};
        const auto equals = entry.find('=');
        if (equals != std::string_view::npos) all.emplace(entry.substr(0, equals), entry.substr(equals + 1));
    }
    for (const char* foreign :
         {"JOURNAL_STREAM", "NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID", "DPSLAVED_DATA"})
        all.erase(foreign);
    for (const auto& [name, value] : more) all.insert_or_assign(name, value);
    std::vector<std::string> result;
    for (const auto& [name, value] : all) result.push_back(name + '=' + value);
    return result;
}

/// Between fork and exec: nothing but system calls.
[[noreturn]] void become(char* const* arguments, char* const* environment, int in, int out, int err)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::signal(SIGPIPE, SIG_DFL);
    if (::dup2(in, STDIN_FILENO) >= 0 && ::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(err, STDERR_FILENO) >= 0)
        ::execve(arguments[0], arguments, environment);
    ::_exit(127);
}

int milliseconds(std::chrono::nanoseconds time)
{
    return static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(time).count());
}

} // namespace

// ---- what is said

void Transcript::add(std::string line)
{
    const std::lock_guard lock(mutex_);
    lines_.push_back(std::move(line));
    changed_.notify_all();
}

void Transcript::close()
{
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
}

std::optional<std::size_t> Transcript::find(std::string_view text, std::size_t from) const
{
    for (std::size_t i = from; i < lines_.size(); ++i)
        if (lines_[i].find(text) != std::string::npos) return i;
    return std::nullopt;
}

std::optional<std::size_t> Transcript::await(std::string_view text, std::size_t from,
                                             std::chrono::nanoseconds limit) const
{
    std::unique_lock lock(mutex_);
    std::optional<std::size_t> found;
    std::size_t seen = from;
    changed_.wait_for(lock, limit, [&] {
        found = find(text, seen);
        seen = std::max(seen, lines_.size());
        return found || closed_;
    });
    return found;
}

std::vector<std::string> Transcript::lines(std::size_t from) const
{
    const std::lock_guard lock(mutex_);
    return {lines_.begin() + static_cast<std::ptrdiff_t>(std::min(from, lines_.size())), lines_.end()};
}

std::size_t Transcript::size() const
{
    const std::lock_guard lock(mutex_);
    return lines_.size();
}

::testing::AssertionResult Reader::says(std::string_view text, std::chrono::nanoseconds limit)
{
    if (const auto found = transcript_.await(text, at_, limit)) {
        at_ = *found + 1;
        return ::testing::AssertionSuccess();
    }
    auto failure = ::testing::AssertionFailure() << '"' << text << "\" was not said. Instead:";
    const auto instead = transcript_.lines(at_);
    const std::size_t left_out = instead.size() > kShown ? instead.size() - kShown : 0;
    for (std::size_t i = left_out; i < instead.size(); ++i) failure << "\n  " << instead[i];
    return failure;
}

std::size_t Reader::how_often(std::string_view text) const
{
    const auto lines = transcript_.lines(at_);
    return static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(text) != std::string::npos;
    }));
}

// ---- programs

Process::Process(std::vector<std::string> command, const Environment& environment)
{
    std::signal(SIGPIPE, SIG_IGN); // a write to a program that has ended fails instead
    for (const std::string& word : command) name_ += (name_.empty() ? "" : " ") + word;
    const Pipe in, out, err;
    const auto arguments = pointers(command);
    auto strings = environment_with(environment);
    const auto variables = pointers(strings);
    pid_ = ::fork();
    if (pid_ == 0)
        become(arguments.data(), variables.data(), in.read_end(), out.write_end(), err.write_end());
    for (const int other_end : {in.read_end(), out.write_end(), err.write_end()}) ::close(other_end);
    if (pid_ < 0) fail("fork");
    pidfd_ = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)); // glibc 2.36 declares no C function
    if (pidfd_ < 0) fail("pidfd_open");
    input_ = in.write_end();
    listener_ = std::thread{[this, o = out.read_end(), e = err.read_end()] { listen(o, e); }};
}

Process::~Process()
{
    if (!status_) ::kill(pid_, SIGKILL);
    wait();
    ::close(input_);
    ::close(pidfd_);
    if (listener_.joinable()) listener_.join();
    if (!::testing::Test::HasFailure() && std::uncaught_exceptions() == 0) return;
    std::cout << "---- " << name_ << '\n';
    const auto lines = transcript_.lines();
    const std::size_t first = lines.size() > kShownOfAFailure ? lines.size() - kShownOfAFailure : 0;
    if (first != 0) std::cout << "   (" << first << " lines before these)\n";
    for (std::size_t i = first; i < lines.size(); ++i) std::cout << "   | " << lines[i] << '\n';
}

void Process::listen(int out, int err)
{
    std::array<pollfd, 2> ends{{{out, POLLIN, 0}, {err, POLLIN, 0}}};
    std::array<std::string*, 2> all{&out_, &err_};
    std::array<std::size_t, 2> done{};
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        ::poll(ends.data(), ends.size(), -1);
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (ends[i].fd < 0 || ends[i].revents == 0) continue;
            std::array<char, 4096> part{};
            const ssize_t got = ::read(ends[i].fd, part.data(), part.size());
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) {
                if (done[i] < all[i]->size()) transcript_.add(all[i]->substr(done[i]));
                ::close(ends[i].fd);
                ends[i].fd = -1;
                continue;
            }
            all[i]->append(part.data(), static_cast<std::size_t>(got));
            for (auto end = all[i]->find('\n', done[i]); end != std::string::npos;
                 end = all[i]->find('\n', done[i])) {
                transcript_.add(all[i]->substr(done[i], end - done[i]));
                done[i] = end + 1;
            }
        }
    }
    transcript_.close();
}

void Process::send_line(std::string_view line)
{
    std::string octets{line};
    octets += '\n';
    static_cast<void>(::write(input_, octets.data(), octets.size()) < 0);
}

std::optional<int> Process::wait(std::chrono::nanoseconds limit)
{
    if (status_) return status_;
    pollfd ended{pidfd_, POLLIN, 0};
    if (::poll(&ended, 1, milliseconds(limit)) != 1) return std::nullopt;
    int how = 0;
    if (::waitpid(pid_, &how, 0) != pid_) return std::nullopt;
    status_ = WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how);
    listener_.join();
    return status_;
}

void Process::send(int signal)
{
    if (!status_) ::kill(pid_, signal);
}

std::optional<int> Process::end(int signal)
{
    if (!status_) ::kill(pid_, signal);
    return wait();
}

Outcome run(std::vector<std::string> command, const Environment& environment)
{
    Process program{std::move(command), environment};
    const auto status = program.wait();
    if (!status) return {};
    return {*status, program.out_, program.err_};
}

} // namespace dpslave::test
