// SPDX-License-Identifier: Apache-2.0
#include "probe_report.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::app {

namespace {

void put(std::array<char, 8>& into, std::string_view text)
{
    std::copy_n(text.begin(), std::min(text.size(), into.size() - 1), into.begin());
}

std::optional<std::string> unless_empty(const std::array<char, 8>& text)
{
    return text[0] == '\0' ? std::nullopt : std::optional<std::string>{text.data()};
}

void put(ProbeRule& into, const std::vector<std::uint16_t>& tags, drive::Sight::Kind kind)
{
    for (const std::uint16_t tag : tags)
        if (into.count < into.tags.size()) into.tags[into.count++] = {tag, kind};
}

} // namespace

void put_found(const drive::LineSearch& search, ProbeReport& report)
{
    using Kind = drive::Sight::Kind;
    for (const drive::FoundUnit& one : search.found()) {
        if (report.count == report.answers.size()) return;
        ProbeAnswer& answer = report.answers[report.count++];
        answer.setting = one.setting;
        answer.unit = one.unit;
        put(answer.identity, one.identity.value_or(""));
        put(answer.version, one.version.value_or(""));
        for (const drive::RuleTally& tally : one.rules) {
            ProbeRule& rule = answer.rules[answer.rule_count++];
            rule.rule = tally.rule;
            rule.nameless = tally.nameless;
            put(rule, tally.answering, Kind::value);
            put(rule, tally.denied, Kind::denied);
            put(rule, tally.silent, Kind::silence);
        }
    }
}

drive::FoundUnit found_of(const ProbeAnswer& answer)
{
    drive::FoundUnit found{.setting = answer.setting, .unit = answer.unit, .identity = {}, .version = {}};
    found.identity = unless_empty(answer.identity);
    found.version = unless_empty(answer.version);
    for (std::size_t i = 0; i < answer.rule_count; ++i) {
        const ProbeRule& rule = answer.rules[i];
        drive::RuleTally& tally = found.rules.emplace_back();
        tally.rule = rule.rule;
        tally.nameless = rule.nameless;
        for (std::size_t k = 0; k < rule.count; ++k) {
            const bool is_value = rule.tags[k].kind == drive::Sight::Kind::value;
            const bool is_denied = rule.tags[k].kind == drive::Sight::Kind::denied;
            (is_value    ? tally.answering
             : is_denied ? tally.denied
                         : tally.silent)
                .push_back(rule.tags[k].number);
        }
    }
    found.tags_asked = answer.rule_count > 0;
    return found;
}

} // namespace dpslave::app
