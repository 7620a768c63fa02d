// SPDX-License-Identifier: Apache-2.0
// From a GSD file to the mapping that makes it: what the profile says is not repeated, what it cannot say is
// named.
#include "import.hpp"

#include "device.hpp"
#include "facts.hpp"
#include "mapping.hpp"
#include "meaning.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

std::string joined(const std::vector<std::string>& names)
{
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    return all;
}

/// Its words in capital letters.
std::vector<std::string> words_of(const std::string& text)
{
    std::vector<std::string> words(1);
    for (const char c : text)
        if (c == ' ')
            words.emplace_back();
        else
            words.back() += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    std::erase(words, "");
    return words;
}

/// "EUROTHERM" and "EUROTHERM CONTROLS" may be one vendor: they share a word.
bool may_be_same_vendor(const std::string& a, const std::string& b)
{
    const std::vector<std::string> ours = words_of(b), theirs = words_of(a);
    return std::find_first_of(theirs.begin(), theirs.end(), ours.begin(), ours.end()) != theirs.end();
}

/// Which profiles a file may be of. 0x0533 is three profiles and several have no ident (C-033), so one is
/// found only where ident and model fit together. A profile without ident takes no file of another vendor.
struct Candidates {
    std::vector<std::string> both, ident, model, open;

    void add(const profile::Profile& profile, const gsd::Document& document)
    {
        const bool same_ident = profile.ident && document.number("Ident_Number") == *profile.ident;
        const bool same_model = document.text("Model_Name") == gsd::latin1(profile.gsd.model);
        if (same_ident && same_model) both.push_back(profile.name);
        if (same_ident) ident.push_back(profile.name);
        if (!profile.ident && same_model) model.push_back(profile.name);
        if (!profile.ident &&
            may_be_same_vendor(document.text("Vendor_Name"), gsd::latin1(profile.gsd.vendor)))
            open.push_back(profile.name);
    }

    const std::vector<std::string>& narrowest() const
    {
        for (const auto* names : {&both, &ident, &model})
            if (!names->empty()) return *names;
        return open;
    }
};

std::string find_profile(const Files& files, const gsd::Document& document, Outcome& outcome)
{
    Candidates candidates;
    for (const std::string& name : files.names)
        if (const auto profile = profile::load_profile(files.source, files.profiles, name))
            candidates.add(*profile, document);
    if (candidates.both.size() == 1) return candidates.both.front();
    const std::vector<std::string>& names = candidates.narrowest();
    outcome.exit = kNo;
    const std::string ident = "Ident_Number " + hex_of(document.number("Ident_Number").value_or(0));
    const std::string model = "Model_Name \"" + printable(document.text("Model_Name")) + '"';
    if (names.empty()) {
        outcome.refusals.push_back("the file is for another device: no profile has " + ident + ", " + model +
                                   " or Vendor_Name \"" + printable(document.text("Vendor_Name")) +
                                   "\". Choose the GSD file of a device that has a profile.");
        return {};
    }
    outcome.facts = text_of({{"candidates", names}});
    outcome.refusals.push_back("the file does not say which device it is for: " + ident + " and " + model +
                               " do not belong to one profile alone. Name the profile, one of " +
                               joined(names) + '.');
    return {};
}

class Importer {
public:
    Importer(const gsd::Document& document, const profile::Profile& profile)
        : document_(document), profile_(profile)
    {
        mapping_.profile = profile.name;
    }

    Result<profile::Mapping, std::vector<std::string>> read()
    {
        identity();
        parameters();
        max_tsdr();
        if (!refused_.empty()) return Failure{std::move(refused_)};
        return std::move(mapping_);
    }

private:
    std::optional<std::string> text(std::string_view keyword) const
    {
        std::string text;
        for (const char c : document_.text(keyword))
            text += is_control_octet(static_cast<std::uint8_t>(c)) ? ' ' : c;
        if (text.empty()) return std::nullopt;
        return utf8_of_latin1(text);
    }

    static bool is_control_octet(std::uint8_t octet)
    {
        return octet < 0x20 || (octet >= 0x7F && octet < 0xA0);
    }

    void identity()
    {
        profile::Selection& selection = mapping_.selection;
        const auto ident = document_.number("Ident_Number");
        if (!ident || *ident == 0 || *ident > 0xFFFF)
            refused_.emplace_back("the file has no Ident_Number from 1 to 0xFFFF.");
        else if (profile_.ident != *ident)
            selection.ident = static_cast<std::uint16_t>(*ident);
        if (document_.text("Model_Name") != gsd::latin1(profile_.gsd.model))
            selection.model = text("Model_Name");
        if (document_.text("Info_Text") != gsd::latin1(profile_.gsd.description))
            selection.description = text("Info_Text");
    }

    void parameters()
    {
        const dp::Personality& personality = profile_.personality;
        const std::vector<std::uint8_t> identifiers = identifiers_of(document_);
        const std::vector<std::uint8_t> prm = document_.user_prm_data();
        std::size_t at = personality.prm.tags_at;
        if (!identifiers.empty()) mapping_.selection.list.emplace(); // else the master's tool chooses
        for (std::size_t i = 0; i < identifiers.size(); ++i) {
            if (i == 0 && personality.demand_identifier != 0 &&
                identifiers[0] == personality.demand_identifier) {
                mapping_.selection.demand = true;
                continue;
            }
            const auto direction = direction_of(identifiers[i]);
            if (!direction) {
                refused_.push_back("identifier " + std::to_string(i + 1) + " of the modules, " +
                                   hex_of(identifiers[i]).replace(2, 2, "") + ", is none of the profile " +
                                   profile_.name + ": is the file for another device?");
                return;
            }
            const std::uint16_t tag = at + 2 <= prm.size() ? be16(prm, at) : std::uint16_t{0};
            if (tag == 0) {
                refused_.push_back(
                    "parameter " + std::to_string(mapping_.selection.list->size() + 1) +
                    " has no tag in User_Prm_Data: the file leaves it to the master's tool, or it "
                    "is for another device than the profile " +
                    profile_.name + '.');
                return;
            }
            mapping_.selection.list->push_back({*direction, tag});
            at += 2;
        }
    }

    std::optional<profile::Direction> direction_of(std::uint8_t octet) const
    {
        for (const dp::Identifier& each : profile_.personality.identifiers)
            if (each.octet == octet)
                return each.reads && each.writes ? profile::Direction::in_out
                       : each.reads              ? profile::Direction::in
                                                 : profile::Direction::out;
        return std::nullopt;
    }

    /// The machine's own MaxTsdr: what the file has where it has more than the profile.
    void max_tsdr()
    {
        profile::Selection plain = mapping_.selection;
        plain.max_tsdr.reset();
        const gsd::Document made = gsd::parse(gsd::write(profile::draft_of(profile_, plain).device));
        for (const gsd::Entry& entry : made.keywords) {
            if (!entry.keyword.starts_with("MaxTsdr_")) continue;
            const auto ours = made.number(entry.keyword), theirs = document_.number(entry.keyword);
            if (ours && theirs && *theirs > *ours && *theirs <= 0xFFFF)
                mapping_.selection.max_tsdr = std::max(mapping_.selection.max_tsdr.value_or(0), *theirs);
        }
    }

    const gsd::Document& document_;
    const profile::Profile& profile_;
    profile::Mapping mapping_;
    std::vector<std::string> refused_;
};

/// What the mapping does not make again.
class Lost {
public:
    explicit Lost(Outcome& outcome) : outcome_(outcome) {}

    /// `why`: what gets lost cannot be held.
    void add(const std::vector<Difference>& differences, std::string_view why)
    {
        for (const Difference& one : differences) {
            const std::string what = printable(one.what);
            std::string sentence = one.line > 0 ? "line " + std::to_string(one.line) + ": " : "";
            if (!one.right)
                sentence += what + " = " + printable(*one.left) + " gets lost: " + std::string{why};
            else if (!one.left)
                sentence += what + " = " + printable(*one.right) + " is added by the profile.";
            else
                sentence += what + " = " + printable(*one.left) + " becomes " + printable(*one.right) + '.';
            outcome_.messages.push_back("warning: " + sentence);
            facts.push_back({{"line", one.line},
                             {"keyword", what},
                             {"left", one.left ? Json(printable(*one.left)) : Json()},
                             {"right", one.right ? Json(printable(*one.right)) : Json()},
                             {"text", sentence}});
        }
    }

    Json facts = Json::array();

private:
    Outcome& outcome_;
};

Json lost_of(Outcome& outcome, std::string_view file, const profile::Draft& draft)
{
    const std::string made = gsd::write(draft.device);
    Lost lost{outcome};
    lost.add(differences(gsd::parse(file), gsd::parse(made)), "a mapping cannot hold it.");
    lost.add(name_differences(file, made), "the tag table has no name for it. Take the table that has it.");
    return lost.facts;
}

/// Nothing: no table was given. One that cannot be read was refused before.
std::optional<profile::OwnTable> table_of(const Files& files, const std::string& table)
{
    if (table.empty()) return std::nullopt;
    const auto text = toml::read_text(files.source, table);
    if (!text) return std::nullopt;
    return profile::OwnTable{table.substr(table.rfind('/') + 1), utf8(*text)};
}

Outcome refused(std::string sentence)
{
    return {.exit = kNo, .refusals = {std::move(sentence)}};
}

} // namespace

Result<profile::Mapping, std::vector<std::string>> mapping_of_file(const gsd::Document& document,
                                                                   const profile::Profile& profile)
{
    return Importer{document, profile}.read();
}

Outcome import_file(const Files& files, std::string_view file, const std::string& profile,
                    const std::string& table)
{
    const gsd::Document document = gsd::parse(file);
    if (!document.has_section) return refused("this is no GSD file: it has no line #Profibus_DP.");
    if (document.text("Model_Name").find("T630") != std::string::npos)
        return refused("the file is for a T630, which this project does not replace.");
    Outcome outcome;
    const std::string name = profile.empty() ? find_profile(files, document, outcome) : profile;
    if (outcome.exit != kFine) return outcome;
    const auto device = load(files, name, table, outcome);
    if (!device) return outcome;
    const auto read = mapping_of_file(document, *device);
    if (!read) {
        outcome.exit = kNo;
        outcome.refusals = read.error();
        return outcome;
    }
    profile::Mapping mapping = *read;
    mapping.table = table_of(files, table);
    const profile::Draft draft = profile::draft_of(*device, mapping.selection);
    Json facts;
    add_mapping(facts, mapping);
    for (const profile::Note& note : draft.notes)
        if (note.refuses)
            outcome.refusals.push_back(printable(note.text));
        else
            outcome.messages.push_back("warning: " + printable(note.text));
    if (!outcome.refusals.empty()) outcome.exit = kNo; // the mapping is there all the same, to be corrected
    facts["lost"] = lost_of(outcome, file, draft);
    put_mapping_file(outcome, mapping, device->tags);
    outcome.facts = text_of(facts);
    return outcome;
}

} // namespace dpslave::configurator
