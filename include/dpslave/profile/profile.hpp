// SPDX-License-Identifier: Apache-2.0
/// A device type read from config/profiles/NAME.toml and its tag table from config/tags/*.csv: checked whole,
/// then constant.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/dp/personality.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/drive/tag.hpp"
#include "dpslave/led/pattern.hpp"
#include "dpslave/profile/fault.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::profile {

struct Profile {
    std::string name;                   ///< "590"
    std::string device;                 ///< in words: "Eurotherm Drives 590 with PROFIBUS-DP option board"
    std::string order_code;             ///< for `dpctl info` (A-002)
    std::string firmware;               ///< of the host that the board needs: "V4.2 onwards" (A-003)
    std::string manual;                 ///< "HA389815"
    std::optional<std::uint16_t> ident; ///< none: the station must say it
    dp::Personality personality;        ///< its ident is *ident, or 0 where open
    std::uint8_t min_address = 0, max_address = 125;
    drive::TagTable tags;
    std::filesystem::path tag_file;
    bool tags_only_from_table = false;
    drive::MnemonicRule mnemonics = drive::MnemonicRule::none;
    drive::OutputLoss output_loss = drive::OutputLoss::zero;
    led::Language leds = led::Language::option_board;
    std::optional<std::uint32_t> recommended_baud; ///< of the drive line; another rate is a warning (A-037)
    std::vector<std::string> protocols;            ///< legal back-ends: "ei-ascii"
};

/// Reads `folder`/NAME.toml and the table it names (../tags/FILE beside the folder). All faults of both files
/// in one list.
Result<Profile, Faults> load_profile(const std::filesystem::path& folder, const std::string& name);

/// Reads a tag table.
Result<drive::TagTable, Faults> load_tags(const std::filesystem::path& file);

/// The names for which `folder` holds a profile, sorted: for messages.
std::vector<std::string> profile_names(const std::filesystem::path& folder);

} // namespace dpslave::profile
