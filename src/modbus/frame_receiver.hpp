// SPDX-License-Identifier: Apache-2.0
/// Makes frames of the octets of a Modbus RTU line. libmodbus cannot receive an echo or the answer to
/// function 8 (it reads 5 of its 8 octets), and throws away the good frame behind a bad one. Pure.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/drive/line_frames.hpp"

#include <cstdint>
#include <vector>

namespace dpslave::modbus {

/// CRC-16 of MODBUS over Serial Line V1.02, 6.2.2; sent low octet first.
std::uint16_t crc16(Bytes octets);

class FrameReceiver {
public:
    enum class Found : std::uint8_t {
        nothing,
        frame,
        broken,
        rest, ///< behind something broken
    };

    /// A request goes out: a copy of it is a frame as well. Unit first, without check sum.
    void sent(std::uint8_t unit, Bytes pdu);

    /// The next octet. After something broken nothing is found until silence(), which gives the rest.
    Found feed(std::uint8_t octet);
    /// The port has heard a character with wrong parity, or a break.
    Found fault();
    /// Nothing came for longer than within a frame.
    Found silence();
    bool in_frame() const { return !octets_.empty() || skips_; }

    Bytes frame() const { return frame_; } ///< unit first, without check sum; of the last Found::frame

    /// Of what was found last, all octets of the wire; a bad character is 00.
    Bytes piece() const { return piece_; }
    drive::Judgement flaw() const { return flaw_; } ///< of the last Found::broken

private:
    bool has_length() const;
    Found found(Found what);
    Found broken(drive::Judgement flaw);

    std::vector<std::uint8_t> octets_;
    std::vector<std::uint8_t> frame_;
    std::vector<std::uint8_t> request_; ///< with check sum
    std::vector<std::uint8_t> rest_;    ///< while it skips
    std::vector<std::uint8_t> piece_;
    drive::Judgement flaw_{};
    bool skips_ = false;
};

} // namespace dpslave::modbus
