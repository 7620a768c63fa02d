// SPDX-License-Identifier: Apache-2.0
/// One language of lamps each in a file of its own, and the patterns that they share.
#pragma once

#include "dpslave/led/pattern.hpp"

#include <array>

namespace dpslave::led {

inline constexpr Pattern kOff{std::chrono::milliseconds{0}, std::chrono::milliseconds{0}};
inline constexpr Pattern kOn{std::chrono::milliseconds{0}, std::chrono::milliseconds{1}};
inline constexpr Pattern kFlash1Hz{std::chrono::milliseconds{1000}, std::chrono::milliseconds{500}};

/// The lamps and the words of a language for one condition.
struct Shown {
    std::vector<Lamp> lamps;
    std::string_view meaning;
};
Shown option_board(const Condition& condition, bool is_620);
Shown technology_box(const Condition& condition);
Shown controller(const Condition& condition);

} // namespace dpslave::led
