// SPDX-License-Identifier: Apache-2.0
/// The order to look for a drive (`dpctl doctor --probe`), main -> drive, and what the search has found,
/// drive -> main: of fixed size, so that it crosses in a ring. Pure.
#pragma once

#include "dpslave/drive/line_search.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace dpslave::app {

/// Tags that are asked for under each rule: so many rows of the station's table, evenly spaced; without a
/// table the usual ones.
inline constexpr std::size_t kProbeTags = 24;

/// What became of the tags under one rule.
struct ProbeRule {
    struct Tag {
        std::uint16_t number = 0;
        drive::Sight::Kind kind = drive::Sight::Kind::silence;
    };
    drive::MnemonicRule rule = drive::MnemonicRule::none;
    std::array<Tag, kProbeTags> tags{};
    std::size_t count = 0;
    std::uint32_t nameless = 0;
};

/// What answered, drive -> main. The first few; the first few show that the line has several.
struct ProbeAnswer {
    drive::LineSetting setting;
    drive::UnitAddress unit{};
    std::array<char, 8> identity{}, version{}; ///< each ends with NUL; empty: not answered
    std::array<ProbeRule, drive::kMnemonicRules.size()> rules{};
    std::size_t rule_count = 0;
};
struct ProbeReport {
    std::uint32_t number = 0; ///< of the order
    std::uint32_t tried = 0;  ///< questions asked
    std::array<ProbeAnswer, 16> answers{};
    std::size_t count = 0;
};
/// What the search has found until now goes into `report`.
void put_found(const drive::LineSearch& search, ProbeReport& report);
drive::FoundUnit found_of(const ProbeAnswer& answer);

/// The order for it, main -> drive.
struct ProbeOrder {
    std::uint32_t number = 0;
    std::uint32_t station = 0; ///< DriveUnit::number
};

} // namespace dpslave::app
