// SPDX-License-Identifier: Apache-2.0
/// Characters as bits on a line with errors, and a UART that samples them: start bit, data bits (lowest
/// first), even parity or none, stop bit. Everything comes from one seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace test {

struct Character {
    std::uint8_t octet = 0;
    bool good = true; ///< false: wrong parity, or no stop bit
};

enum class Parity : std::uint8_t { without, even };

class BitLine {
public:
    /// `errors`: of each bit, the chance to arrive inverted, 0 up to and without 1. `data_bits`: 7 or 8.
    BitLine(double errors, unsigned data_bits, std::uint32_t seed, Parity parity = Parity::even);

    /// What a UART receives of octets that follow each other behind a pause of T_SYN, which has its errors,
    /// too. A character whose start bit was hit begins with the next zero.
    std::vector<Character> received(const std::vector<std::uint8_t>& octets);

    std::uint64_t hits() const { return hits_; } ///< bits that were inverted until now
    void heal() { errors_ = 0; }                 ///< no more errors

private:
    void put(bool level);
    std::uint64_t next_distance();

    double errors_;
    unsigned data_bits_;
    Parity parity_;
    std::mt19937 random_;
    std::uint64_t until_hit_;
    std::uint64_t hits_ = 0;
    std::vector<std::uint8_t> levels_;
};

} // namespace test
