// SPDX-License-Identifier: Apache-2.0
/// Keeps the bus thread from waiting: by memory that is never paged out, SCHED_FIFO, and exact timers.
/// Everything here is an improvement that a machine may refuse: the answer is a list of sentences for the
/// log, and an empty one means that all was granted.
#pragma once

#include "dpslave/io/fd.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::io {

/// The stack of every thread but the first, with what the C library keeps there (about 4 KiB).
/// Measured on amd64 without optimisation, by the pages touched (/proc/PID/smaps, lock_memory = false): the
/// bus thread 12 KiB, a drive thread 12 KiB, through start-up, exchange, faults in the log, a port that
/// vanishes and reloads. 128 KiB is also the least that glibc takes on arm64.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::size_t kThreadStack = 2048 * 1024; // their frames are many times larger
#else
inline constexpr std::size_t kThreadStack = 128 * 1024;
#endif

/// Gives threads that start from now on a stack of kThreadStack, all of which is locked if memory is locked.
/// If the system refuses it they have the usual stack of 8 MiB.
void make_stacks_small();

/// Makes freed memory stay with the process, and all threads share it. Call it before another thread
/// allocates, if the memory is to be locked.
void keep_memory();

/// Locks all memory of the process, present and future: the complete stacks of all threads are then in
/// memory. It takes milliseconds. If only part would be granted nothing is locked, because a thread could
/// fail to start later.
std::vector<std::string> lock_memory();

/// No drive thread was seen to need more of its stack.
inline constexpr std::size_t kKeptStack = 16 * 1024;
/// Gives back what the calling thread's stack has more than `kept` octets below this call, and locks it no
/// more. Call it in a thread that may wait for a page of memory.
void unlock_deep_stack(std::size_t kept = kKeptStack);

/// Sets the calling thread: timer slack 1 ns, pinned to processor `cpu` (-1 = not), and SCHED_FIFO with
/// `priority` 1..99 (0 = ordinary scheduling).
std::vector<std::string> enter_realtime(int priority, int cpu);

/// While this object exists the calling thread runs SCHED_FIFO with `priority`; 0, or where the system
/// refuses it: as before. Its end is in the same thread. After it the thread has ordinary scheduling.
class RaisedPriority {
public:
    explicit RaisedPriority(int priority) noexcept;
    ~RaisedPriority();
    RaisedPriority(const RaisedPriority&) = delete;
    RaisedPriority& operator=(const RaisedPriority&) = delete;

private:
    bool raised_ = false;
};

/// While this object exists the processors enter no deep idle state: the exit latency is 8 to 30 us instead
/// of up to 3 ms between an interrupt and its thread (wire reference 11.1). It has no effect if
/// /dev/cpu_dma_latency does not exist or may not be opened.
class ShallowIdle {
public:
    ShallowIdle();

private:
    Fd held_; // closing it ends the request
};

/// Page faults of the calling thread since it began, minor and major: with locked memory
/// the count does not grow while it serves.
std::uint64_t page_faults_of_thread() noexcept;

/// Names the calling thread for ps, top and gdb: "bus". The name has at most 15 characters.
void name_thread(const char* name);

} // namespace dpslave::io
