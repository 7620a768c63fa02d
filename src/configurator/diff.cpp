// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"
#include "facts.hpp"
#include "line_diff.hpp"
#include "meaning.hpp"

#include "dpslave/base/printable.hpp"

namespace dpslave::configurator {
namespace {

std::string shown(const std::optional<std::string>& value)
{
    return value ? printable(*value) : "not there";
}

Json optional(const std::optional<std::string>& value)
{
    return value ? Json(printable(*value)) : Json();
}

} // namespace

Outcome diff(const Files& files, std::string_view left, std::string_view right, const std::string& profile,
             const std::string& table)
{
    Outcome outcome;
    const gsd::Document of_left = gsd::parse(left), of_right = gsd::parse(right);
    if (!of_left.has_section) outcome.refusals.push_back("the first file: " + not_read(of_left));
    if (!of_right.has_section) outcome.refusals.push_back("the second file: " + not_read(of_right));
    outcome.exit = outcome.refusals.empty() ? kFine : kNo;
    if (outcome.exit != kFine) return outcome;
    say_unread(of_left, "the first file: ", outcome);
    say_unread(of_right, "the second file: ", outcome);
    gsd::MapHints left_hints = hints_of(files, profile, table, of_left, outcome),
                  right_hints = hints_of(files, profile, table, of_right, outcome);
    if (outcome.exit != kFine) return outcome;
    for (gsd::MapHints* hints : {&left_hints, &right_hints}) {
        add_names(*hints, left);
        add_names(*hints, right);
    }

    std::vector<Difference> all = differences(of_left, of_right);
    for (Difference& one :
         map_differences(gsd::io_map(of_left, left_hints), gsd::io_map(of_right, right_hints)))
        all.push_back(std::move(one));
    Json meaning = Json::array(), text = Json::array();
    for (const Difference& one : all) {
        outcome.lines.push_back(printable(one.what) + ": " + shown(one.left) + " -> " + shown(one.right));
        meaning.push_back(
            {{"what", printable(one.what)}, {"left", optional(one.left)}, {"right", optional(one.right)}});
    }
    outcome.lines.emplace_back(all.empty() ? "Both files say the same." : "The files say different things.");
    bool headed = false;
    for (const Line& line : compare_lines(left, right)) {
        text.push_back(
            {{"left", line.left}, {"right", line.right}, {"line", printable(utf8_of_latin1(line.text))}});
        if (line.left > 0 && line.right > 0) continue;
        if (!headed) outcome.lines.insert(outcome.lines.end(), {"", "Lines that only one file has:"});
        headed = true;
        outcome.lines.push_back(std::string{line.left > 0 ? "- " : "+ "} +
                                std::to_string(line.left + line.right) + ": " +
                                printable(utf8_of_latin1(line.text)));
    }
    outcome.exit = all.empty() ? kFine : kNo;
    outcome.facts = text_of({{"same", all.empty()}, {"meaning", meaning}, {"text", text}});
    return outcome;
}

} // namespace dpslave::configurator
