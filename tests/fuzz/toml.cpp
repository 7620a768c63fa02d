// SPDX-License-Identifier: Apache-2.0
/// A TOML file: questions to a document, and the same text as a profile. Judged: faults lie in the text and
/// are printable; a key that nobody asked for is a fault; a value that is given lies within what was asked
/// for; a profile that is accepted keeps the limits of PROFIBUS-DP; the same text has the same faults.
#include "faults.hpp"

#include "dpslave/input/document.hpp"
#include "dpslave/profile/profile.hpp"

#include <vector>

namespace {

using namespace dpslave;
using fuzz::demand;

std::vector<std::string> lines_of(const input::Faults& faults)
{
    std::vector<std::string> lines;
    for (const auto& fault : faults) lines.push_back(to_string(fault));
    return lines;
}

/// Asks for keys of each kind, in each table. True: every key of the table is one of them.
bool question(input::Table table, int depth)
{
    if (const auto text = table.text("text"))
        demand(!text->empty() && text->find('\x1b') == std::string::npos,
               "a text is not empty and printable");
    if (const auto value = table.integer("integer", -5, 125))
        demand(*value >= -5 && *value <= 125, "an integer lies in its span");
    if (const auto value = table.real("real", 0.5, 10))
        demand(*value >= 0.5 && *value <= 10, "a real lies in its span");
    table.boolean("boolean");
    if (const auto texts = table.texts("texts", 2)) demand(texts->size() >= 2, "a list has its least length");
    if (const auto integers = table.integers("integers", 0, 9))
        for (const auto value : *integers) demand(value >= 0 && value <= 9, "each integer lies in its span");
    if (const auto chosen = table.choice<int>("choice", {{"a", 1}, {"b", 2}}))
        demand(*chosen == 1 || *chosen == 2, "a choice is one of those that are legal");
    bool all = true;
    for (const std::string& key : table.keys()) {
        constexpr std::string_view known{"|text|integer|real|boolean|texts|integers|choice|table|tables|"};
        all = all && known.find("|" + key + "|") != std::string_view::npos;
    }
    if (depth == 0) return all && !table.has("table") && !table.has("tables");
    if (table.has("table")) all = question(table.table("table"), depth - 1) && all;
    if (table.has("tables"))
        for (const auto& one : table.tables("tables")) all = question(one, depth - 1) && all;
    return all;
}

std::vector<std::string> judge_document(std::string_view text)
{
    const input::TextSource source = [text](const std::string&) -> Result<std::string, Unreadable> {
        return std::string{text};
    };
    input::Document document{source, "a.toml"};
    const bool all_known = question(document.root(), 3);
    const input::Faults faults = document.faults();
    fuzz::judge_faults(text, faults);
    if (!document.readable()) {
        demand(!faults.empty(), "a text that is no TOML has a fault");
        demand(document.root().keys().empty(), "a text that is no TOML has no keys");
    }
    demand(all_known || !faults.empty(), "a key that nobody asked for is a fault");
    return lines_of(faults);
}

std::vector<std::string> judge_profile(std::string_view text)
{
    constexpr std::string_view kTags{
        "tag,name,type,decimals,min,max\n7,SPEED,INT,2,-100.00,100.00\n9,MODE,ENUM,,,\n"};
    const input::TextSource source = [&](const std::string& name) -> Result<std::string, Unreadable> {
        return std::string{name.ends_with(".csv") ? kTags : text};
    };
    const auto profile = profile::load_profile(source, "profiles", "a");
    if (!profile) {
        demand(!profile.error().empty(), "a profile that is refused has a fault");
        // Lines of the tag table are not lines of this text; there are fewer of them.
        fuzz::judge_faults(std::string(kTags) + std::string{text}, profile.error());
        return lines_of(profile.error());
    }
    const dp::Personality& device = profile->personality;
    demand(profile->min_address <= profile->max_address && profile->max_address <= 125,
           "addresses are those of PROFIBUS");
    demand(device.max_diag_length >= 6 && device.max_diag_length <= 244, "Slave_Diag fits its telegram");
    demand(6 + device.diag_octets <= device.max_diag_length, "the diagnosis of the device fits Slave_Diag");
    demand(device.prm.min_length <= device.prm.max_length && device.prm.max_length <= 237,
           "User_Prm_Data fits its telegram");
    demand(!device.identifiers.empty(), "there is an identifier");
    demand(!profile->protocols.empty(), "there is a protocol");
    for (const Tbit tsdr : device.max_tsdr) demand(tsdr.count > 11, "max T_SDR is beyond min T_SDR");
    return {};
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzz::text_of(data, size);
    const auto faults = judge_document(text);
    if (size % 8 == 0) demand(judge_document(text) == faults, "the same text has the same faults");
    judge_profile(text);
    return 0;
}
