// SPDX-License-Identifier: Apache-2.0
/// Octets as PROFIBUS has them: views, big-endian words, and a buffer that cannot grow beyond its bound.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace dpslave {

using Bytes = std::span<const std::uint8_t>;

/// A text as octets; it outlives them.
inline Bytes bytes_of(std::string_view text)
{
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// The word at `offset`, high octet first. Precondition: offset + 2 <= bytes.size().
constexpr std::uint16_t be16(Bytes bytes, std::size_t offset)
{
    return static_cast<std::uint16_t>((bytes[offset] << 8) | bytes[offset + 1]);
}
constexpr std::uint8_t high(std::uint16_t word)
{
    return static_cast<std::uint8_t>(word >> 8);
}
constexpr std::uint8_t low(std::uint16_t word)
{
    return static_cast<std::uint8_t>(word & 0xFF);
}

/// Up to N octets in place; trivially copyable, so that it may cross between threads. A call that does not
/// fit returns false and changes nothing.
template <std::size_t N>
class ByteBuffer {
    static_assert(N <= 0xFFFF);

public:
    static constexpr std::size_t capacity() { return N; }
    constexpr std::size_t size() const { return size_; }
    constexpr bool empty() const { return size_ == 0; }
    constexpr Bytes bytes() const { return Bytes{data_}.first(size_); }
    constexpr operator Bytes() const { return bytes(); }
    constexpr void clear() { size_ = 0; }

    constexpr bool push(std::uint8_t octet)
    {
        if (size_ == N) return false;
        data_[size_++] = octet;
        return true;
    }
    constexpr bool push16(std::uint16_t word)
    {
        if (size_ + 2u > N) return false;
        return push(high(word)) && push(low(word));
    }
    constexpr bool append(Bytes more)
    {
        if (more.size() > N - size_) return false;
        for (const std::uint8_t octet : more) data_[size_++] = octet;
        return true;
    }
    constexpr bool assign(Bytes all)
    {
        if (all.size() > N) return false;
        clear();
        return append(all);
    }

    /// Compares the octets up to size(); those after it do not count.
    friend constexpr bool operator==(const ByteBuffer& a, const ByteBuffer& b)
    {
        const Bytes one = a.bytes(), other = b.bytes();
        return std::equal(one.begin(), one.end(), other.begin(), other.end());
    }

private:
    std::array<std::uint8_t, N> data_{};
    std::uint16_t size_ = 0;
};

/// "68 05 05 68": two upper-case digits an octet, one blank between.
std::string hex(Bytes bytes);

} // namespace dpslave
