// SPDX-License-Identifier: Apache-2.0
#include "ieee.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <string_view>

namespace dpslave::modbus {
namespace {

bool is_single(const drive::Tag& tag)
{
    return tag.type == drive::TagType::number && tag.is_real;
}

/// The second register holds this for everything that is no single.
constexpr std::uint16_t kNoNumber = 0x8000;

float single_of(IeeePair pair)
{
    return std::bit_cast<float>((std::uint32_t{pair[0]} << 16) | pair[1]);
}

/// The shortest decimal that is this single and no other, without an exponent.
std::string decimal_of(float value)
{
    std::array<char, 64> room{}; // 39 digits before the point, or 45 zeros and 9 digits after it
    const auto end =
        std::to_chars(room.data(), room.data() + room.size(), value, std::chars_format::fixed).ptr;
    return {room.data(), end};
}

/// Rounds "12.34" with one decimal to 123, and to 124 if the first digit cut off is 5 or more. It returns
/// nullopt beyond 65536.
std::optional<std::int32_t> rounded_counts(std::string_view decimal, unsigned decimals)
{
    constexpr std::int32_t kTooMany = 65'536;
    const std::size_t point = decimal.find('.');
    const std::string_view whole = decimal.substr(0, point);
    const std::string_view fraction = point == decimal.npos ? std::string_view{} : decimal.substr(point + 1);
    const auto digit = [&fraction](std::size_t i) { return i < fraction.size() ? fraction[i] - '0' : 0; };
    std::int32_t counts = 0;
    for (std::size_t i = 0; i < whole.size() + decimals; ++i) {
        counts = 10 * counts + (i < whole.size() ? whole[i] - '0' : digit(i - whole.size()));
        if (counts > kTooMany) return std::nullopt;
    }
    return counts + (digit(decimals) >= 5 ? 1 : 0);
}

} // namespace

bool is_ieee(const drive::Tag& tag)
{
    return tag.modbus_register.value_or(0) >= kIeeeArea;
}

std::optional<std::uint16_t> word_of(const drive::Tag& tag, IeeePair pair)
{
    if (!is_single(tag)) return pair[0];
    const float value = single_of(pair);
    if (!std::isfinite(value)) return std::nullopt;
    const auto size = rounded_counts(decimal_of(std::fabs(value)), tag.decimals);
    if (!size) return std::nullopt;
    const std::int32_t counts = std::signbit(value) ? -*size : *size;
    const std::int32_t least = tag.is_unsigned ? 0 : -32'768;
    const std::int32_t most = tag.is_unsigned ? 65'535 : 32'767;
    if (counts < least || counts > most) return std::nullopt;
    return static_cast<std::uint16_t>(counts);
}

IeeePair pair_of(const drive::Tag& tag, std::uint16_t word)
{
    if (!is_single(tag)) return {word, kNoNumber};
    const std::int32_t counts = tag.is_unsigned ? std::int32_t{word} : static_cast<std::int16_t>(word);
    double scale = 1;
    for (unsigned i = 0; i < tag.decimals; ++i) scale *= 10;
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(counts / scale));
    return {static_cast<std::uint16_t>(bits >> 16), static_cast<std::uint16_t>(bits & 0xFFFF)};
}

std::string ieee_flaw(const drive::Tag& tag, IeeePair pair)
{
    const std::string where = " in tag " + std::to_string(tag.number);
    const float value = single_of(pair);
    if (std::isnan(value)) return "the drive itself has no number" + where + " (NaN)";
    if (std::isinf(value)) return "the drive itself has an infinite value" + where;
    std::array<char, 32> room{};
    const auto end = std::to_chars(room.data(), room.data() + room.size(), value).ptr;
    return "the drive itself has " + std::string{room.data(), end} + where + ", which with " +
           std::to_string(tag.decimals) + (tag.decimals == 1 ? " decimal" : " decimals") +
           " does not fit 16 bits";
}

} // namespace dpslave::modbus
