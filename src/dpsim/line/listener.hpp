// SPDX-License-Identifier: Apache-2.0
/// A UART that listens at one rate to characters that are sent at another: what it takes their bits for.
/// Pure.
#pragma once

#include "dpsim/common/telegram.hpp"

#include <vector>

namespace dpslave::sim {

class Listener {
public:
    /// `bits`: of a character, 11 (start, eight data bits, even parity, stop) or 10 (without parity). Rates
    /// in bit/s, above 0.
    Listener(unsigned bits, std::uint32_t sent_at, std::uint32_t heard_at);

    std::uint32_t sent_at() const { return sent_at_; }
    std::uint32_t heard_at() const { return heard_at_; }

    /// Characters that follow each other without a gap: those that are heard by their end. One without stop
    /// bit or with wrong parity is 00, as a tty with INPCK delivers it.
    Octets hear(Bytes sent);
    /// The line rests: the character that has begun ends in ones.
    Octets rest();

private:
    Octets sample(bool resting);
    bool level_at(double bit) const;

    unsigned bits_;
    std::uint32_t sent_at_, heard_at_;
    std::vector<bool> levels_; ///< of the line, one each bit time of the sender
    double from_ = 0;          ///< up to where they were listened to
    bool awaits_mark_ = false; ///< after a missing stop bit only a one lets a character begin
};

} // namespace dpslave::sim
