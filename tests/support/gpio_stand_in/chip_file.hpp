// SPDX-License-Identifier: Apache-2.0
/// A GPIO chip that is a file: what the stand-in of libgpiod, in the process under test, and the test itself
/// see of it. Shared by processes, so every number is read and written whole.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace dpslave::stand_in {

inline constexpr std::size_t kMostLines = 32;
inline constexpr std::array<char, 8> kMagic{'g', 'p', 'i', 'o', 'f', 'i', 'l', 'e'};
/// Byte n behind this one is locked by the process that has line n, so that the kernel gives it back, as it
/// does a line.
inline constexpr long kLocks = 1L << 20;

using Number = std::atomic<std::uint32_t>;
using Moment = std::atomic<std::int64_t>; // CLOCK_MONOTONIC, ns
static_assert(Number::is_always_lock_free && Moment::is_always_lock_free);

/// Written with one pwrite(2) an edge: an edge costs one system call, as with a real chip. It stays as it is
/// when its owner dies, which is what many chips do, and the hard case.
struct Level {
    Number high;
    Number rises;
    Number falls;
};

struct Line {
    Level level;
    Number active_low; ///< of the last request
    Number requests;
    Number edges; ///< orders to set it, whether they changed it or not
    std::array<char, 32> consumer;
};

/// What the process under test writes to its port while one of the lines is watched.
struct Watch {
    std::array<char, 128> port; ///< empty: nothing is watched
    Number line;
    Number baud;
    Number writes;
    Number writes_while_inactive;
    Number releases;         ///< edges to inactive with which a write ended
    Number releases_early;   ///< of these, before the last stop bit had gone
    Number releases_in_time; ///< of these, within one character after it (A-027)
    Moment written_at;       ///< 0: no write is open
    Number octets;           ///< of that write
};

struct Chip {
    std::array<char, 8> magic;
    std::array<char, 32> label;
    Number lines;
    Number gone;       ///< the chip is not there
    Number generation; ///< how often it went: a line taken before that is dead
    Number edge_us;    ///< how long an edge takes
    std::array<Line, kMostLines> line;
    Watch watch;
};

} // namespace dpslave::stand_in
