// SPDX-License-Identifier: Apache-2.0
/// When a daemon wrote its replies, seen from outside of it: what the library in its process notes, and the
/// test reads. Shared by two processes, so every number is read and written whole.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace dpslave::reply_watch {

/// The environment variable that names the file of the record.
inline constexpr const char* kVariable = "DPSLAVE_REPLY_WATCH";

using Moment = std::atomic<std::int64_t>; // CLOCK_MONOTONIC, ns
using Count = std::atomic<std::uint64_t>;
static_assert(Moment::is_always_lock_free && Count::is_always_lock_free);

struct Record {
    std::array<char, 256> port; ///< the tty of the bus; a link to it counts as the tty that it leads to now
    Moment window;              ///< ns, from the end of a request that was read to the begin of its reply
    Moment read_at;             ///< the last read(2) that brought octets has returned
    Count replies;              ///< write(2) to the port
    Count late;                 ///< of these, begun after the window
    Moment slowest;             ///< ns, of all replies
};

} // namespace dpslave::reply_watch
