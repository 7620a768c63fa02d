// SPDX-License-Identifier: Apache-2.0
#include "load.hpp"

#include "dpslave/io/clock.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>

namespace dpslave::bench {
namespace {

using std::chrono::nanoseconds;

constexpr std::chrono::milliseconds kPeriod{100};

Child start_dpctl(const std::filesystem::path& dpctl, const std::filesystem::path& socket,
                  const std::vector<const char*>& words)
{
    std::vector<const char*> line{dpctl.c_str(), "--socket", socket.c_str()};
    line.insert(line.end(), words.begin(), words.end());
    line.push_back(nullptr);
    return start_child([&line] {
        const int nowhere = ::open("/dev/null", O_RDWR);
        for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, fd);
        ::execv(line.front(), const_cast<char* const*>(line.data()));
    });
}

/// Never ends by itself.
void burn(nanoseconds in_each_period, nanoseconds first)
{
    std::vector<std::uint32_t> memory(64 * 1024);
    Instant next = io::monotonic_now() + first;
    for (std::uint32_t sum = 0;; next += kPeriod) {
        std::this_thread::sleep_for(next - io::monotonic_now());
        const nanoseconds end = cpu_of_caller() + in_each_period;
        while (cpu_of_caller() < end)
            for (std::size_t i = 0; i < memory.size(); i += 16) memory[i] = sum += memory[i] + 1;
    }
}

} // namespace

Callers::Callers(const std::filesystem::path& dpctl, const std::filesystem::path& socket,
                 const CallerPlan& plan)
{
    for (const auto& words : plan.follow) followers_.push_back(start_dpctl(dpctl, socket, words));
    asks_ = std::jthread{
        [this, dpctl, socket, plan](const std::stop_token& stop) { ask(stop, dpctl, socket, plan); }};
}

void Callers::ask(const std::stop_token& stop, const std::filesystem::path& dpctl,
                  const std::filesystem::path& socket, const CallerPlan& plan)
{
    std::mutex mutex;
    std::condition_variable_any ends;
    for (Instant next = io::monotonic_now() + plan.period / 2;; next += plan.period) {
        std::unique_lock lock{mutex};
        ends.wait_for(lock, stop, next - io::monotonic_now(), [] { return false; });
        if (stop.stop_requested()) return;
        Child one = start_dpctl(dpctl, socket, {plan.ask});
        asked_ += one.wait().count();
    }
}

nanoseconds Callers::cpu() const
{
    nanoseconds all{asked_.load()};
    for (const Child& one : followers_) all += one.cpu();
    return all;
}

Strangers::Strangers(double share)
{
    static constexpr std::size_t kProcesses = 5;
    const std::chrono::duration<double, std::nano> in_each = share * kPeriod / kProcesses;
    for (std::size_t i = 0; i < kProcesses; ++i)
        processes_.push_back(start_child([&in_each, i] {
            burn(std::chrono::duration_cast<nanoseconds>(in_each), i * kPeriod / kProcesses);
        }));
}

nanoseconds Strangers::cpu() const
{
    nanoseconds all{};
    for (const Child& one : processes_) all += one.cpu();
    return all;
}

} // namespace dpslave::bench
