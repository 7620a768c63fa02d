// SPDX-License-Identifier: Apache-2.0
/// Under which rule of the mnemonics how many tags of a drive answer. It is pure. An answer shows that
/// the drive has this mnemonic. It is no proof that the mnemonic stands for this tag.
#pragma once

#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/frame_notes.hpp"
#include "dpslave/drive/tag.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace dpslave::drive {

/// The results of the tags under one rule, ascending. Modbus has no rule: there it is `none`, by register.
struct RuleTally {
    MnemonicRule rule = MnemonicRule::none; ///< none: by the mnemonics of the table itself
    std::vector<std::uint16_t> answering, denied, silent;
    std::vector<std::uint16_t> unasked; ///< they have a mnemonic, and the search ended before
    std::uint32_t nameless = 0;         ///< tags that have no mnemonic under this rule

    std::size_t named() const { return answering.size() + denied.size() + silent.size() + unasked.size(); }
};

/// The rules that fit: most tags answer under them, at least one. Several: these tags do not tell them apart.
std::vector<MnemonicRule> best_rules(std::span<const RuleTally> tallies);

class RuleTrial {
public:
    /// Asks for `tags` under `rules`, for a Modbus line by their registers. A STRING is not asked for.
    RuleTrial(std::vector<Tag> tags, std::vector<MnemonicRule> rules);

    /// Returns the questions, each once: rules can give two tags the same mnemonic.
    std::vector<Look> questions(LineProtocol protocol) const;
    /// Counts the results; `sights` has the answer to each question. A question that is missing was not
    /// asked.
    std::vector<RuleTally> tally(LineProtocol protocol, const std::map<Look, Sight::Kind>& sights) const;

private:
    std::optional<Look> look_for(LineProtocol protocol, const Tag& tag, MnemonicRule rule) const;
    std::vector<MnemonicRule> rules_of(LineProtocol protocol) const;

    std::vector<Tag> tags_;
    std::vector<MnemonicRule> rules_;
};

/// All known rules.
std::vector<MnemonicRule> known_rules();

/// Returns numbers for a search without tags: the rules make different mnemonics of them, so that a drive
/// that follows one rule denies some under the others.
std::vector<Tag> usual_trial_tags();

/// Returns at most `most` rows of a table, evenly spaced.
std::vector<Tag> sample_of(const TagTable& table, std::size_t most);

} // namespace dpslave::drive
