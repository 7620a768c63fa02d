// SPDX-License-Identifier: Apache-2.0
/// Makes frames of the octets of a Modbus RTU line. libmodbus cannot receive an echo or the answer to
/// function 8 (it reads 5 of its 8 octets), and discards the good frame after noise. It is pure.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/drive/frame_notes.hpp"

#include <bitset>
#include <chrono>
#include <cstdint>
#include <vector>

namespace dpslave::modbus {

/// CRC-16 of MODBUS over Serial Line V1.02, 6.2.2; sent low octet first.
std::uint16_t crc16(Bytes octets);

/// There may be noise before a frame. A frame counts wherever it begins if it is the echo of the request, or
/// of the unit and function asked (an exception included), is as long as it says, has a right checksum and no
/// bad character, and does not lie inside a longer frame of a unit of the line whose begin was heard,
/// whatever the checksum of that one. Any other frame counts only from the first octet after a silence on, or
/// directly after a frame.
class FrameReceiver {
public:
    enum class Found : std::uint8_t {
        nothing,
        frame,
        broken,
        rest, ///< after something broken
    };

    /// A request goes out: a copy of it is a frame as well. `pdu` has no unit and no checksum.
    void sent(std::uint8_t unit, Bytes pdu);

    /// The next octet, which was on the line at `end` at the latest. After something broken no frame is found
    /// until silence(), which gives the rest.
    Found feed(std::uint8_t octet, Instant end = kNever);
    /// The port has heard a character with wrong parity, or a break. It breaks an answer that has begun;
    /// before that it is noise.
    Found fault(Instant end = kNever);
    /// The line has been silent for longer than within a frame.
    Found silence();
    bool in_frame() const { return !octets_.empty() || skips_; }

    Bytes frame() const { return frame_; } ///< unit first, without checksum; of the last Found::frame

    /// Returns all octets of the last result as on the wire; a bad character is 00.
    Bytes piece() const { return piece_; }
    Bytes noise() const { return noise_; } ///< that came before the last Found::frame
    /// Returns the latest time at which the last Found::frame can have begun, if a character takes
    /// `character`.
    Instant begun(std::chrono::nanoseconds character) const;
    /// Returns the flaw of the last Found::broken. no_frame: noise, in which no answer has begun.
    drive::Judgement flaw() const { return flaw_; }

private:
    bool has_length() const;
    bool is_asked(std::size_t from) const;
    bool is_wanted(std::size_t from) const;
    bool is_inside_another(std::size_t from) const;
    std::size_t extent(std::size_t from) const;
    bool answer_has_begun() const;
    Found frame_from(std::size_t from);
    Found broken(drive::Judgement flaw);

    std::vector<std::uint8_t> octets_;
    std::vector<Instant> ends_;    ///< of each of them
    std::size_t behind_fault_ = 0; ///< place after the last bad character among them
    std::vector<std::uint8_t> frame_;
    std::vector<Instant> frame_ends_;
    std::vector<std::uint8_t> request_; ///< with checksum
    std::bitset<256> units_;            ///< asked so far: the units of the line
    std::vector<std::uint8_t> rest_;    ///< while it skips
    std::vector<std::uint8_t> piece_, noise_;
    drive::Judgement flaw_{};
    bool skips_ = false;
};

} // namespace dpslave::modbus
