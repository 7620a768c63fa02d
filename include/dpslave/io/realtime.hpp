// SPDX-License-Identifier: Apache-2.0
/// What keeps the bus thread from waiting: memory that is never paged out, SCHED_FIFO, exact timers.
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

/// Threads that start from now on have a stack of kThreadStack, which is locked as a whole where memory is
/// locked. Where the system refuses it they have the usual one of 8 MiB.
void make_stacks_small();

/// What is freed stays with the process, and all threads share it. Call it before the first thread starts,
/// where the memory is to be locked.
void keep_memory();

/// Locks all memory of the process, present and future: the stacks of all threads are then there as a whole.
/// That takes milliseconds. Where only part would be granted it is not done at all, because a thread could
/// fail to start later.
std::vector<std::string> lock_memory();

/// Of the calling thread: gives back the part of its stack that no thread was seen to need, 16 KiB below this
/// call, and locks it no more. For a thread that may wait for a page of memory.
void unlock_deep_stack();

/// For the calling thread: timer slack 1 ns, pinned to processor `cpu` (-1 = not), and
/// SCHED_FIFO with `priority` 1..99 (0 = ordinary scheduling).
std::vector<std::string> enter_realtime(int priority, int cpu);

/// While this object exists the processors enter no deep idle state: the exit latency is 8
/// to 30 us instead of up to 3 ms between an interrupt and its thread (wire reference 11.1). Without effect
/// where /dev/cpu_dma_latency does not exist or may not be opened.
class ShallowIdle {
public:
    ShallowIdle();

private:
    Fd held_; // closing it ends the request
};

/// Page faults of the calling thread since it began, minor and major: with locked memory
/// the count does not grow while it serves.
std::uint64_t page_faults_of_thread() noexcept;

/// Names the calling thread for ps, top and gdb: "bus". At most 15 characters.
void name_thread(const char* name);

} // namespace dpslave::io
