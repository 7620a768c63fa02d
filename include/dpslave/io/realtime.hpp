// SPDX-License-Identifier: Apache-2.0
/// What keeps the bus thread from waiting: memory that is never paged out, SCHED_FIFO, exact timers.
/// Everything here is an improvement that a machine may refuse: the answer is a list of sentences for the
/// log, and an empty one means that all was granted.
#pragma once

#include "dpslave/io/fd.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::io {

/// Locks all memory of the process, present and future, and keeps what is freed. Call it before the threads
/// start: their stacks are then there as a whole. Where only part would be granted it is not done at all,
/// because a thread could fail to start later.
std::vector<std::string> lock_memory();

/// For the calling thread: its stack touched, timer slack 1 ns, pinned to processor `cpu` (-1 = not), and
/// SCHED_FIFO with `priority` 1..99 (0 = ordinary scheduling).
std::vector<std::string> enter_realtime(int priority, int cpu);

/// While it lives the processors do not fall so deeply asleep that waking up takes longer than answering: 8
/// to 30 us instead of up to 3 ms between an interrupt and its thread (wire reference 11.1). A wish: where
/// /dev/cpu_dma_latency is not there or not ours nothing happens.
class ShallowIdle {
public:
    ShallowIdle();

private:
    Fd held_; // closing it ends the wish
};

/// Page faults of the calling thread since it began, minor and major: 0 more while it serves is what locked
/// memory is for.
std::uint64_t page_faults_of_thread() noexcept;

/// Names the calling thread for ps, top and gdb: "bus". At most 15 characters.
void name_thread(const char* name);

} // namespace dpslave::io
