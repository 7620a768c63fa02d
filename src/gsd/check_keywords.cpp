// SPDX-License-Identifier: Apache-2.0
#include "check_parts.hpp"
#include "keywords.hpp"
#include "text.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace dpslave::gsd {
namespace {

/// PROFIsafe, and extensions of DP (wire reference 9.2): their keywords are not judged here.
constexpr std::string_view kOfOthers[] = {"F_", "X_", "DXB_"};

bool is_of_others(std::string_view keyword)
{
    return std::any_of(std::begin(kOfOthers), std::end(kOfOthers),
                       [&](std::string_view begin) { return keyword.starts_with(begin); });
}

/// A master has keywords of its own, and only the form of its file is judged.
void unknown(Judge& judge, const Entry& entry)
{
    if (judge.on("Station_Type")) return;
    const std::string what = "unknown keyword " + in_quotes(entry.keyword) + ": ";
    if (const std::string_view nearest = nearest_keyword(entry.keyword); !nearest.empty())
        return judge.slip(entry.line, what + "the standard spells it " + in_quotes(nearest) + '.');
    judge.say(entry.line, Weight::warning,
              what + "tools ignore what they do not know. If it is a slip, look up the spelling.");
}

void check_number(Judge& judge, const Entry& entry, const Keyword& keyword)
{
    const auto number = parse_number(entry.value);
    const std::string range = std::to_string(keyword.min) + " to " + std::to_string(keyword.max);
    if (!number)
        judge.say(entry.line, Weight::error,
                  std::string{keyword.name} + " = " + entry.value + " is not a number: write one from " +
                      range + ", decimal or as 0x1AF.");
    else if (*number < keyword.min || *number > keyword.max)
        judge.say(entry.line, Weight::error,
                  std::string{keyword.name} + " = " + entry.value + " is out of range: it may be " + range +
                      '.');
}

void check_text(Judge& judge, const Entry& entry, const Keyword& keyword)
{
    const auto text = parse_quoted(entry.value);
    if (!text)
        judge.say(entry.line, Weight::error,
                  std::string{keyword.name} + " is a text: put its value between \" and \".");
    else if (!text->rest.empty())
        judge.say(entry.line, Weight::error,
                  std::string{text->rest} + " follows the text of " + std::string{keyword.name} +
                      ": remove it; a text cannot have a \" inside.");
    else if (text->text.size() > keyword.max)
        judge.say(entry.line, Weight::error,
                  "the text of " + std::string{keyword.name} + " has " + std::to_string(text->text.size()) +
                      " characters: " + std::to_string(keyword.max) + " are allowed.");
}

void check_family(Judge& judge, const Entry& entry)
{
    const auto number = parse_number(trimmed(std::string_view{entry.value}.substr(0, entry.value.find('@'))));
    if (!number || *number > 12)
        judge.say(
            entry.line, Weight::error,
            "Slave_Family = " + entry.value +
                ": write a number from 0 to 12 (0 general, 1 drives, 5 controllers), if wanted with @text after it.");
}

void check_value(Judge& judge, const Entry& entry, const Keyword& keyword)
{
    switch (keyword.kind) {
        case Kind::boolean:
            if (entry.value != "0" && entry.value != "1")
                judge.say(entry.line,
                          parse_number(entry.value).value_or(2) < 2 ? Weight::pedantic : Weight::error,
                          std::string{keyword.name} + " = " + entry.value + ": write 0 or 1.");
            break;
        case Kind::number: check_number(judge, entry, keyword); break;
        case Kind::text: check_text(judge, entry, keyword); break;
        case Kind::family: check_family(judge, entry); break;
        case Kind::octets:
            if (!parse_octets(entry.value))
                judge.say(
                    entry.line, Weight::error,
                    std::string{keyword.name} +
                        " is a list of octets: write numbers from 0 to 255 with one comma between two of them.");
            break;
        case Kind::other: break;
    }
}

using Seen = std::map<std::pair<std::string, std::uint32_t>, unsigned>; ///< keyword and index: line

void check_one(Judge& judge, const Entry& entry, Section section, Seen& seen)
{
    if (entry.keyword.empty()) return;
    const Keyword* keyword = find_keyword(entry.keyword);
    if (keyword == nullptr && is_of_others(entry.keyword)) return;
    if (keyword == nullptr) return unknown(judge, entry);
    if ((keyword->places & section) == 0)
        return judge.say(entry.line, Weight::error,
                         std::string{keyword->name} + " belongs in a module: move it there.");
    if (entry.keyword != keyword->name)
        judge.say(entry.line, Weight::pedantic,
                  in_quotes(entry.keyword) + ": the standard spells it " + in_quotes(keyword->name) + '.');
    if (keyword->indexed && !entry.index)
        judge.say(entry.line, Weight::error,
                  std::string{keyword->name} + " needs a number in ( and ): write " +
                      std::string{keyword->name} + "(0) and the like.");
    check_value(judge, entry, *keyword);
    const auto [first, is_first] =
        seen.try_emplace({to_lower(entry.keyword), entry.index.value_or(0)}, entry.line);
    const bool may_repeat = same_any_case(keyword->name, "Ext_User_Prm_Data_Ref"); // bits of one octet
    if (!is_first && !may_repeat)
        judge.say(entry.line, Weight::warning,
                  std::string{keyword->name} + " is here a second time (first in line " +
                      std::to_string(first->second) + "): remove one of them.");
    if (judge.revision > 0 && keyword->revision > judge.revision)
        judge.say(entry.line, Weight::warning,
                  std::string{keyword->name} + " exists from GSD_Revision " +
                      std::to_string(keyword->revision) + " on, and the file says " +
                      std::to_string(judge.revision) + ": raise GSD_Revision or remove the keyword.");
    if (keyword->dpv1 && !judge.dpv1 && parse_number(entry.value).value_or(1) != 0)
        judge.say(entry.line, Weight::warning,
                  std::string{keyword->name} +
                      " has a meaning with DPV1_Slave = 1 only: add that, or remove this line.");
}

void check_module(Judge& judge, const Block& module)
{
    Seen seen;
    DataArea area;
    for (const Entry& entry : module.body)
        if (!area.has(entry.keyword, entry.value)) check_one(judge, entry, kModule, seen);
}

} // namespace

void check_keywords(Judge& judge)
{
    Seen seen;
    for (const Entry& entry : judge.document.keywords) check_one(judge, entry, kUnit, seen);
    for (const Block& block : judge.document.blocks)
        if (block.kind == "Module") check_module(judge, block);
    if (judge.document.modules.empty()) return;
    const unsigned first_module = judge.document.modules.front().line;
    for (const Entry& entry : judge.document.keywords)
        if (entry.line > first_module)
            judge.say(entry.line, Weight::pedantic,
                      entry.keyword + " is after the first module: the standard requires it before.");
}

} // namespace dpslave::gsd
