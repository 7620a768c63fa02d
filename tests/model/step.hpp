// SPDX-License-Identifier: Apache-2.0
/// One step of the model check: something that comes to a slave from outside. It says all that is needed to
/// repeat it, so steps can be left out of a list, printed and read back.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace test {

struct Step {
    enum class Kind : std::uint8_t {
        request, ///< numbers: FC, SA, DSAP, SSAP (-1: none); octets: user data
        sdn,     ///< the same
        wait,    ///< time passes and the slave is told
        inputs,  ///< numbers: layouts ago, every input tried, scale missing; octets: words
        answer,  ///< numbers: orders ago, AccessError, value
        diag,    ///< numbers: fault; octets: blocks
        restart, ///< the application stops the slave and starts it again
    };
    Kind kind = Kind::wait;
    std::int64_t after = 0; ///< nanoseconds since the step before
    std::array<int, 4> numbers{};
    std::size_t length = 0;
    std::array<std::uint8_t, 244> octets{};

    std::span<const std::uint8_t> data() const { return std::span{octets}.first(length); }
    void push(unsigned octet)
    {
        if (length < octets.size()) octets[length++] = static_cast<std::uint8_t>(octet);
    }
};
using Steps = std::vector<Step>;

/// One line: kind, time, numbers, octets. "request 1000 109 2 61 62 | 88 14".
std::string show(const Step& step);
/// Lines as show() writes them. Throws std::invalid_argument for anything else.
Steps steps_of(std::string_view lines);

} // namespace test
