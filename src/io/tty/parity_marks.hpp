// SPDX-License-Identifier: Apache-2.0
/// Undoes the marks of PARMRK (termios(3)): the line discipline delivers a character with a parity or framing
/// error as FF 00 x, a break as FF 00 00, and a true FF as FF FF. It is pure. Source: wire reference 11.4.
#pragma once

#include "dpslave/base/bytes.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dpslave::io {

/// A sequence may be split over two reads at any place: the state between them is kept here.
class ParityMarks {
public:
    struct Step {
        std::size_t used = 0;       ///< octets of `raw` that are done with
        std::size_t octets = 0;     ///< good octets put into `out`
        bool bad_character = false; ///< after those octets a bad character came; it is not among them
    };

    /// Takes marked octets from `raw` until all are used, `out` is full, or a bad character is met.
    /// `out` may be `raw` itself: what is written never overtakes what is read.
    Step undo(Bytes raw, std::span<std::uint8_t> out) noexcept;

    /// Drops a sequence begun: the input was discarded.
    void reset() noexcept { seen_ = Seen::nothing; }

private:
    enum class Seen : std::uint8_t { nothing, ff, ff_00 };
    Seen seen_ = Seen::nothing;
};

} // namespace dpslave::io
