// SPDX-License-Identifier: Apache-2.0
#include "listener.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace dpslave::sim {

Listener::Listener(unsigned bits, std::uint32_t sent_at, std::uint32_t heard_at)
    : bits_(bits), sent_at_(sent_at), heard_at_(heard_at)
{}

Octets Listener::hear(Bytes sent)
{
    for (const std::uint8_t octet : sent) {
        levels_.push_back(false);
        for (unsigned bit = 0; bit < 8; ++bit) levels_.push_back((octet >> bit & 1U) != 0);
        if (bits_ == 11) levels_.push_back(std::popcount(octet) % 2 != 0);
        levels_.push_back(true);
    }
    return sample(false);
}

Octets Listener::rest()
{
    Octets heard = sample(true);
    levels_.clear();
    from_ = 0;
    awaits_mark_ = false;
    return heard;
}

/// A resting line is one.
bool Listener::level_at(double bit) const
{
    const auto index = static_cast<std::size_t>(bit);
    return index >= levels_.size() || levels_[index];
}

/// Each bit is looked at in its middle, as the listener counts from the edge of the start bit. Bits that may
/// go on in the next characters are kept, unless the line is idle.
Octets Listener::sample(bool resting)
{
    const double bit = static_cast<double>(sent_at_) / heard_at_;
    const auto end = static_cast<double>(levels_.size());
    Octets heard;
    while (from_ < end) {
        if (level_at(from_)) { // no start bit yet
            awaits_mark_ = false;
            from_ = std::floor(from_) + 1;
            continue;
        }
        if (awaits_mark_) {
            from_ = std::floor(from_) + 1;
            continue;
        }
        const auto middle_of = [&](unsigned n) { return from_ + (n + 0.5) * bit; };
        const double stop = middle_of(bits_ - 1);
        if (stop >= end && !resting) break;
        if (level_at(middle_of(0))) { // too short for a start bit
            from_ = middle_of(0);
            continue;
        }
        unsigned octet = 0;
        for (unsigned n = 0; n < 8; ++n) octet |= level_at(middle_of(1 + n)) ? 1U << n : 0U;
        const bool parity = bits_ != 11 || level_at(middle_of(9)) == (std::popcount(octet) % 2 != 0);
        awaits_mark_ = !level_at(stop);
        heard.push_back(static_cast<std::uint8_t>(parity && !awaits_mark_ ? octet : 0));
        from_ = stop;
    }
    const auto passed = std::min(levels_.size(), static_cast<std::size_t>(from_));
    levels_.erase(levels_.begin(), levels_.begin() + static_cast<std::ptrdiff_t>(passed));
    from_ -= static_cast<double>(passed);
    return heard;
}

} // namespace dpslave::sim
