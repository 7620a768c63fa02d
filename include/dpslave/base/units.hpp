// SPDX-License-Identifier: Apache-2.0
/// Numbers with a unit have a type: bit times, rates and moments cannot be mixed up.
#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dpslave {

/// The time line of the bus: CLOCK_MONOTONIC, which only io/ reads.
/// It has no now(): the pure layers get each moment as an argument.
struct BusClock {
    using duration = std::chrono::nanoseconds;
    using rep = duration::rep;
    using period = duration::period;
    using time_point = std::chrono::time_point<BusClock>;
    static constexpr bool is_steady = true;
};
using Instant = BusClock::time_point;

/// "No deadline": later than every moment.
inline constexpr Instant kNever = Instant::max();

/// A transmission rate of PROFIBUS in bit/s that a tty can reach (wire reference 1.2).
enum class Baud : std::uint32_t {
    k9_6 = 9'600,
    k19_2 = 19'200,
    k45_45 = 45'450, ///< fixed only, never searched
    k93_75 = 93'750,
    k187_5 = 187'500,
    k500 = 500'000,
    k1500 = 1'500'000,
};

/// Every rate, lowest first; `index_of` gives the place of one in this list.
inline constexpr std::array kBauds{Baud::k9_6,   Baud::k19_2, Baud::k45_45, Baud::k93_75,
                                   Baud::k187_5, Baud::k500,  Baud::k1500};

constexpr std::size_t index_of(Baud baud)
{
    for (std::size_t i = 0; i < kBauds.size(); ++i)
        if (kBauds[i] == baud) return i;
    return 0;
}

/// Below 93.75 kbit/s: dwells and allowances are longer there.
constexpr bool is_slow(Baud baud)
{
    return index_of(baud) < index_of(Baud::k93_75);
}

/// The rate with this number of bit/s; nothing if PROFIBUS has none.
constexpr std::optional<Baud> baud_of(std::uint32_t bits_per_second)
{
    for (const Baud baud : kBauds)
        if (static_cast<std::uint32_t>(baud) == bits_per_second) return baud;
    return std::nullopt;
}

/// Returns the spelling of the GSD keywords: "9.6", "187.5", "1.5M".
std::string_view text(Baud baud) noexcept;

/// A number of bit times (T_bit). Its duration depends on the rate: duration_of().
struct Tbit {
    std::uint32_t count{};
    friend constexpr auto operator<=>(Tbit, Tbit) = default;
    friend constexpr Tbit operator+(Tbit a, Tbit b) { return {a.count + b.count}; }
};
constexpr Tbit operator""_tbit(unsigned long long count)
{
    return {static_cast<std::uint32_t>(count)};
}

/// `bits` at `baud`, rounded up to the next nanosecond: a pause is never too short.
constexpr std::chrono::nanoseconds duration_of(Tbit bits, Baud baud)
{
    const auto rate = static_cast<std::uint64_t>(baud);
    return std::chrono::nanoseconds{(bits.count * std::uint64_t{1'000'000'000} + rate - 1) / rate};
}
static_assert(duration_of(Tbit{60}, Baud::k9_6) == std::chrono::microseconds{6250});
static_assert(duration_of(Tbit{150}, Baud::k1500) == std::chrono::microseconds{100});

/// One character on the wire: start, eight data bits, even parity, stop (wire reference 1.1).
inline constexpr Tbit kCharacter{11};

} // namespace dpslave
