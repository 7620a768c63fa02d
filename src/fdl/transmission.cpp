// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/transmission.hpp"

#include "dpslave/fdl/telegram.hpp"

namespace dpslave::fdl {
namespace {

std::chrono::nanoseconds on_line(std::size_t octets, Baud baud)
{
    return duration_of(Tbit{static_cast<std::uint32_t>(octets) * kCharacter.count}, baud);
}

} // namespace

std::chrono::nanoseconds transmission_guard(Baud baud) noexcept
{
    return on_line(2 * kMaxTelegram, baud);
}

void Transmission::begin(std::size_t octets, Instant at, Baud baud) noexcept
{
    dpslave::Transmission::begin(on_line(octets, baud), at, {on_line(1, baud), transmission_guard(baud)});
}

} // namespace dpslave::fdl
