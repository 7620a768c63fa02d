// SPDX-License-Identifier: Apache-2.0
#include "dpslave/profile/profile.hpp"

#include <charconv>

namespace dpslave::profile {
namespace {

/// Reads digits only, from `min` to `max`.
std::optional<unsigned> number_of(std::string_view text, unsigned min, unsigned max)
{
    unsigned number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < min || number > max)
        return std::nullopt;
    return number;
}

} // namespace

std::optional<MirroredLamp> parse_lamp(std::string_view text)
{
    MirroredLamp lamp;
    if (text == "none") return lamp;
    lamp.inverted = text.starts_with('!');
    if (lamp.inverted) text.remove_prefix(1);
    const auto point = text.find('.');
    const auto tag = number_of(text.substr(0, point), 1, 0xFFFF);
    if (!tag) return std::nullopt;
    lamp.tag = static_cast<std::uint16_t>(*tag);
    if (point == std::string_view::npos) return lamp;
    const auto bit = number_of(text.substr(point + 1), 0, 15);
    if (!bit) return std::nullopt;
    lamp.mask = static_cast<std::uint16_t>(1U << *bit);
    return lamp;
}

} // namespace dpslave::profile
