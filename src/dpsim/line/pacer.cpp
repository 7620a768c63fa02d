// SPDX-License-Identifier: Apache-2.0
#include "pacer.hpp"

#include <algorithm>

namespace dpslave::sim {

Instant Pacer::after(std::uint64_t characters) const
{
    const std::uint64_t bits = characters * bits_;
    const std::uint64_t seconds = bits / baud_, rest = bits % baud_;
    return burst_began_ + std::chrono::seconds{seconds} +
           std::chrono::nanoseconds{(rest * std::uint64_t{1'000'000'000} + baud_ - 1) / baud_};
}

void Pacer::take(Bytes octets, Instant now)
{
    if (octets.empty()) return;
    if (now > after(burst_length_)) { // the line was idle
        burst_began_ = now;
        burst_length_ = 0;
    }
    for (const std::uint8_t octet : octets) {
        ++burst_length_;
        last_due_ = std::max(last_due_, after(burst_length_) + delay_); // a shorter delay does not overtake
        if (cut_) {
            ++lost_;
        } else if (const auto arrived = through_noise(octet)) {
            queue_.push_back({*arrived, last_due_});
        }
    }
}

Octets Pacer::due_by(Instant now)
{
    Octets due;
    while (!queue_.empty() && queue_.front().due <= now) {
        due.push_back(queue_.front().octet);
        queue_.pop_front();
    }
    passed_ += due.size();
    return due;
}

void Pacer::set_baud(std::uint32_t baud)
{
    burst_began_ = after(burst_length_);
    burst_length_ = 0;
    baud_ = baud;
}

void Pacer::set_cut(bool cut)
{
    cut_ = cut;
    if (!cut) return;
    lost_ += queue_.size();
    queue_.clear();
}

std::optional<std::uint8_t> Pacer::through_noise(std::uint8_t octet)
{
    if (errors_ <= 0) return octet;
    std::bernoulli_distribution hit(errors_);
    // An octet above 7F on a line of 10 bits is of 8N1: eight data bits, no parity. Else 8E1 or 7E1.
    const bool parity = bits_ == 11 || octet < 0x80;
    const unsigned data_bits = bits_ == 10 && parity ? 7 : 8;
    unsigned flipped = 0, hits = 0;
    bool broken = false;
    for (unsigned bit = 0; bit < bits_; ++bit) {
        if (!hit(random_)) continue;
        if (bit == 0 || bit == bits_ - 1) {
            broken = true; // start or stop bit
        } else {
            ++hits;
            if (bit <= data_bits) flipped |= 1U << (bit - 1);
        }
    }
    if (hits != 0 || broken) ++spoilt_;
    if (broken) return std::nullopt;
    if (parity && hits % 2 == 1) return std::uint8_t{0};
    return static_cast<std::uint8_t>(octet ^ flipped);
}

} // namespace dpslave::sim
