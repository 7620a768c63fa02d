// SPDX-License-Identifier: Apache-2.0
/// Every fuzz target uses this: the input taken piece by piece, and the end of the program where a judgement
/// fails.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

namespace fuzz {

/// The octets that libFuzzer made. Behind their end there are zeros.
class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

    bool at_end() const { return rest_.empty(); }
    std::uint8_t octet()
    {
        if (rest_.empty()) return 0;
        const std::uint8_t first = rest_.front();
        rest_ = rest_.subspan(1);
        return first;
    }
    std::uint16_t word()
    {
        const unsigned high = octet();
        return static_cast<std::uint16_t>(high << 8 | octet());
    }
    /// The next `most` octets, or as many as are left.
    std::span<const std::uint8_t> octets(std::size_t most)
    {
        const auto taken = rest_.first(std::min(most, rest_.size()));
        rest_ = rest_.subspan(taken.size());
        return taken;
    }

private:
    std::span<const std::uint8_t> rest_;
};

/// The input as text.
inline std::string_view text_of(const std::uint8_t* data, std::size_t size)
{
    return size == 0 ? std::string_view{} : std::string_view{reinterpret_cast<const char*>(data), size};
}

/// A finding unless `holds`: libFuzzer keeps the input.
inline void demand(bool holds, const char* rule)
{
    if (holds) return;
    std::fprintf(stderr, "BROKEN: %s\n", rule);
    std::abort();
}

} // namespace fuzz
