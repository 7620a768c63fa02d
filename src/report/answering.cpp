// SPDX-License-Identifier: Apache-2.0
#include "dpslave/report/answering.hpp"

namespace dpslave::report {

Answering answering_of(const drive::FoundUnit& found)
{
    const auto numbers = [](const std::vector<std::uint16_t>& tags) {
        return std::vector<std::int64_t>(tags.begin(), tags.end());
    };
    Answering one{.protocol = std::string{drive::name(found.setting.protocol)},
                  .baud = found.setting.baud,
                  .format = drive::text(found.setting.format),
                  .unit = drive::unit_text(found.setting.protocol, found.unit),
                  .identity = found.identity,
                  .version = found.version};
    if (const std::string words = drive::identity_words(found.identity.value_or("")); !words.empty())
        one.device = words;
    for (const drive::RuleTally& tally : found.rules)
        one.rules.push_back({.rule = std::string{drive::text(tally.rule)},
                             .answering = numbers(tally.answering),
                             .denied = numbers(tally.denied),
                             .silent = numbers(tally.silent),
                             .unasked = numbers(tally.unasked),
                             .nameless = tally.nameless});
    for (const drive::MnemonicRule rule : drive::best_rules(found.rules))
        one.best_rules.emplace_back(drive::text(rule));
    return one;
}

} // namespace dpslave::report
