// SPDX-License-Identifier: Apache-2.0
/// Does a station take what a master sends for a GSD file? The slave's own checks decide, and nothing beside
/// them.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/dp/personality.hpp"
#include "dpslave/dp/refusal.hpp"
#include "dpslave/gsd/sent.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::profile {

struct Refused {
    dp::RefusalDetail detail;
    unsigned line = 0; ///< of the file, that says the octet; 0: none does
};
/// "Chk_Cfg would be refused: Cfg_Data has more identifiers than User_Prm_Data has tags, octet 3, expected
/// ...; name ...".
std::string sentence(const Refused& refused);

/// Returns what the telegrams configure: it calls dp::check_set_prm(), then dp::check_chk_cfg() with its
/// tags.
Result<dp::Configuration, Refused> judge(const dp::Personality& personality, const gsd::Sent& sent);

struct FileVerdict {
    std::optional<Refused> refused = {};          ///< nullopt: the station accepts it
    std::vector<const gsd::Module*> modules = {}; ///< that were judged
    /// If the modules are a choice: those that the station accepts in no list.
    std::vector<const gsd::Module*> not_usable = {};
    dp::Configuration taken{}; ///< without a refusal
    gsd::Plugging plugging = gsd::Plugging::fixed;
    std::string limit = {};     ///< of a refused choice: which limit of the file ends its lists; a sentence
    bool other_lists = false;   ///< if the modules are a choice: another list is accepted as well
    bool tags_are_open = false; ///< the file has no tag but room for them: the master's project has them
};

/// A file whose modules are a choice is refused only if no list of them within Max_Module is accepted.
/// `modules`: this list is judged instead. If the tags are open, any are put in.
FileVerdict judge_file(const dp::Personality& personality, const gsd::Document& document,
                       const std::optional<std::vector<const gsd::Module*>>& modules = {});

/// Returns the telegrams with `tags` in User_Prm_Data, from the place of the first one on; the octets there
/// are replaced.
gsd::Sent with_tags(gsd::Sent sent, const dp::PrmLayout& layout, const std::vector<std::uint16_t>& tags);

} // namespace dpslave::profile
