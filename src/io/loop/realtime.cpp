// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/realtime.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace dpslave::io {
namespace {

constexpr int kHeapStep = 16 * 1024; ///< octets

std::string text(int error)
{
    return std::system_category().message(error);
}

/// Returns whether there is enough memory for some threads and for what they allocate: with everything locked
/// the complete stack of a new thread counts against the limit.
bool has_memory_for_threads()
{
    constexpr std::size_t kStacks = 32 * kThreadStack;
    void* const probe =
        ::mmap(nullptr, kStacks, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (probe == MAP_FAILED) return false;
    ::munmap(probe, kStacks);
    return true;
}

std::string not_locked(const std::string& why)
{
    rlimit limit{};
    std::string now;
    if (::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        now = ", the limit is " + std::to_string(limit.rlim_cur / 1024) + " KiB";
    return "memory is not locked (" + why + now +
           "): replies may be late under memory pressure. Allow it with LimitMEMLOCK=infinity in the unit or the capability CAP_IPC_LOCK, or set lock_memory = false in [realtime]";
}

} // namespace

void make_stacks_small()
{
    pthread_attr_t attributes;
    if (::pthread_attr_init(&attributes) != 0) return;
    if (::pthread_attr_setstacksize(&attributes, kThreadStack) == 0)
        ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
}

void keep_memory()
{
    // Locked memory stays: nothing goes back to the system at free() to be faulted in again by the next
    // malloc(), and no block gets a mapping of its own that goes with it.
    ::mallopt(M_TRIM_THRESHOLD, -1);
    ::mallopt(M_MMAP_MAX, 0);
    // The heap grows by 128 KiB at a time: what is asked for beyond the need would count as locked although
    // it is empty.
    ::mallopt(M_TOP_PAD, kHeapStep);
    // An arena of its own for each thread would reserve 64 MiB, which counts as locked although it is empty.
    ::mallopt(M_ARENA_MAX, 1);
}

std::vector<std::string> lock_memory()
{
    if (::mlockall(MCL_CURRENT | MCL_FUTURE) < 0) return {not_locked(text(errno))};
    if (has_memory_for_threads()) return {};
    ::munlockall();
    return {not_locked("not enough for the threads")};
}

void unlock_deep_stack(std::size_t kept)
{
    pthread_attr_t attributes;
    if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return;
    void* lowest = nullptr;
    std::size_t size = 0;
    const bool known = ::pthread_attr_getstack(&attributes, &lowest, &size) == 0;
    ::pthread_attr_destroy(&attributes);
    if (!known) return;
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<std::uintptr_t>(lowest);
    const auto end = (reinterpret_cast<std::uintptr_t>(&attributes) - kept) / page * page;
    if (end <= begin) return;
    ::munlock(lowest, end - begin);
    ::madvise(lowest, end - begin, MADV_DONTNEED);
}

std::vector<std::string> enter_realtime(int priority, int cpu)
{
    std::vector<std::string> warnings;
    if (::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL) < 0)
        warnings.push_back("timers are not exact (PR_SET_TIMERSLACK: " + text(errno) +
                           "): replies may start 50 us late");

    if (cpu >= 0) {
        cpu_set_t set;
        CPU_ZERO(&set);
        if (cpu < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(cpu), &set);
        if (const int error = ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set); error != 0)
            warnings.push_back("the thread is not pinned to processor " + std::to_string(cpu) + " (" +
                               text(error) +
                               "): set cpu in [realtime] to a processor of this machine (`lscpu`), or to -1");
    }
    if (priority > 0) {
        sched_param param{};
        param.sched_priority = priority;
        if (const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &param); error != 0)
            warnings.push_back(
                "the thread runs with ordinary scheduling instead of SCHED_FIFO " + std::to_string(priority) +
                " (" + text(error) + "): replies may be late on a busy machine. Allow it with LimitRTPRIO=" +
                std::to_string(priority) +
                " in the unit or the capability CAP_SYS_NICE, or set priority = 0 in [realtime]");
    }
    return warnings;
}

RaisedPriority::RaisedPriority(int priority) noexcept
{
    if (priority <= 0) return;
    sched_param param{};
    param.sched_priority = priority;
    raised_ = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &param) == 0;
}

RaisedPriority::~RaisedPriority()
{
    const sched_param ordinary{};
    if (raised_) ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
}

ShallowIdle::ShallowIdle() : held_(::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC))
{
    constexpr std::int32_t kLongestWait = 0; // us
    if (held_ && ::write(held_.get(), &kLongestWait, sizeof kLongestWait) != sizeof kLongestWait)
        held_.reset();
}

std::uint64_t page_faults_of_thread() noexcept
{
    rusage used{};
    if (::getrusage(RUSAGE_THREAD, &used) != 0) return 0;
    return static_cast<std::uint64_t>(used.ru_minflt) + static_cast<std::uint64_t>(used.ru_majflt);
}

void name_thread(const char* name)
{
    static_cast<void>(::pthread_setname_np(::pthread_self(), name));
}

} // namespace dpslave::io
