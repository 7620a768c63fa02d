// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/rule_trial.hpp"

#include <algorithm>
#include <array>

namespace dpslave::drive {

namespace {

/// Low ones, which only the rules `ac` and `pno` write with a digit first; and some whose PNO has a letter,
/// which `pno` and `590plus` write in upper case and `ac` in lower case. They follow the table of EI-ASCII
/// reference, section 3.
constexpr std::array<std::uint16_t, 24> kUsualTags{1,   10,  11,   12,   26,   27,   43,   55,
                                                   56,  74,  91,   107,  123,  150,  200,  250,
                                                   288, 340, 1010, 1011, 1026, 1027, 1043, 1058};

} // namespace

std::vector<MnemonicRule> known_rules()
{
    std::vector<MnemonicRule> all;
    for (const NamedRule& one : kMnemonicRules) all.push_back(one.rule);
    return all;
}

std::vector<Tag> usual_trial_tags()
{
    std::vector<Tag> tags;
    for (const std::uint16_t number : kUsualTags) tags.push_back(unlisted_tag(number));
    return tags;
}

std::vector<Tag> sample_of(const TagTable& table, std::size_t most)
{
    const std::vector<Tag>& all = table.all();
    const std::size_t count = std::min(all.size(), most);
    std::vector<Tag> tags;
    for (std::size_t i = 0; i < count; ++i) tags.push_back(all[i * all.size() / count]);
    return tags;
}

RuleTrial::RuleTrial(std::vector<Tag> tags, std::vector<MnemonicRule> rules)
    : tags_(std::move(tags)), rules_(std::move(rules))
{
    std::erase_if(tags_, [](const Tag& tag) { return tag.type == TagType::string; });
}

std::vector<MnemonicRule> RuleTrial::rules_of(LineProtocol protocol) const
{
    return protocol == LineProtocol::modbus_rtu ? std::vector{MnemonicRule::none} : rules_;
}

std::optional<Look> RuleTrial::look_for(LineProtocol protocol, const Tag& tag, MnemonicRule rule) const
{
    if (protocol == LineProtocol::modbus_rtu)
        return Look{.mnemonic = {}, .reg = tag.modbus_register.value_or(tag.number)};
    const auto mnemonic =
        rule == MnemonicRule::none ? mnemonic_of(tag, rule) : mnemonic_by_rule(tag.number, rule);
    if (!mnemonic) return std::nullopt;
    return Look{.mnemonic = *mnemonic, .reg = 0};
}

std::vector<Look> RuleTrial::questions(LineProtocol protocol) const
{
    std::vector<Look> all;
    for (const MnemonicRule rule : rules_of(protocol))
        for (const Tag& tag : tags_)
            if (const auto look = look_for(protocol, tag, rule)) all.push_back(*look);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

std::vector<RuleTally> RuleTrial::tally(LineProtocol protocol,
                                        const std::map<Look, Sight::Kind>& sights) const
{
    std::vector<RuleTally> tallies;
    for (const MnemonicRule rule : rules_of(protocol)) {
        RuleTally& one = tallies.emplace_back();
        one.rule = rule;
        for (const Tag& tag : tags_) {
            const auto look = look_for(protocol, tag, rule);
            const auto seen = look ? sights.find(*look) : sights.end();
            if (!look)
                ++one.nameless;
            else if (seen == sights.end())
                one.unasked.push_back(tag.number);
            else if (seen->second == Sight::Kind::value)
                one.answering.push_back(tag.number);
            else if (seen->second == Sight::Kind::denied)
                one.denied.push_back(tag.number);
            else
                one.silent.push_back(tag.number);
        }
        // A table without mnemonics has no tally.
        if (rule == MnemonicRule::none && one.named() == 0) tallies.pop_back();
    }
    return tallies;
}

std::vector<MnemonicRule> best_rules(std::span<const RuleTally> tallies)
{
    std::size_t most = 1;
    for (const RuleTally& one : tallies) most = std::max(most, one.answering.size());
    std::vector<MnemonicRule> best;
    for (const RuleTally& one : tallies)
        if (one.answering.size() == most) best.push_back(one.rule);
    return best;
}

} // namespace dpslave::drive
