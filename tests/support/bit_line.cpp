// SPDX-License-Identifier: Apache-2.0
#include "bit_line.hpp"

#include <bit>
#include <cmath>

namespace test {
namespace {

constexpr unsigned kPause = 33; ///< T_SYN, in bit times

} // namespace

BitLine::BitLine(double errors, unsigned data_bits, std::uint32_t seed, Parity parity)
    : errors_(errors), data_bits_(data_bits), parity_(parity), random_(seed), until_hit_(next_distance())
{}

/// How many bits arrive well before the next one that does not: of a geometric distribution.
std::uint64_t BitLine::next_distance()
{
    if (errors_ <= 0) return UINT64_MAX;
    const double chance = (static_cast<double>(random_()) + 0.5) / 4294967296.0;
    return static_cast<std::uint64_t>(std::log(chance) / std::log1p(-errors_));
}

void BitLine::put(bool level)
{
    const bool hit = errors_ > 0 && until_hit_ == 0;
    levels_.push_back(level != hit ? 1 : 0);
    if (hit) {
        ++hits_;
        until_hit_ = next_distance();
    } else {
        --until_hit_;
    }
}

std::vector<Character> BitLine::received(const std::vector<std::uint8_t>& octets)
{
    levels_.clear();
    for (unsigned i = 0; i < kPause; ++i) put(true);
    for (const std::uint8_t octet : octets) {
        put(false);
        for (unsigned bit = 0; bit < data_bits_; ++bit) put((octet >> bit & 1U) != 0);
        if (parity_ == Parity::even) put(std::popcount(octet) % 2 != 0);
        put(true);
    }
    const std::size_t end = levels_.size();
    const std::size_t stop_bit = data_bits_ + (parity_ == Parity::even ? 2 : 1); // the start bit is 0
    const std::size_t length = stop_bit + 1;
    levels_.insert(levels_.end(), length, 1); // then the line rests

    std::vector<Character> all;
    for (std::size_t at = 0; at < end;) {
        if (levels_[at] != 0) {
            ++at;
            continue;
        }
        unsigned octet = 0;
        for (unsigned bit = 0; bit < data_bits_; ++bit) octet |= unsigned{levels_[at + 1 + bit]} << bit;
        const bool parity = parity_ == Parity::without ||
                            (levels_[at + 1 + data_bits_] != 0) == (std::popcount(octet) % 2 != 0);
        const bool stop = levels_[at + stop_bit] != 0;
        all.push_back({static_cast<std::uint8_t>(octet), parity && stop});
        at += length;
        while (!stop && at < end && levels_[at] == 0) ++at; // a start bit is a change to zero
    }
    return all;
}

} // namespace test
