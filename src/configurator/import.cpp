// SPDX-License-Identifier: Apache-2.0
// Makes from a GSD file the mapping that makes it: what the profile says is not repeated, what it cannot say
// is named.
#include "import.hpp"

#include "device.hpp"
#include "facts.hpp"
#include "mapping.hpp"
#include "meaning.hpp"
#include "plant_keys.hpp"
#include "recognise.hpp"
#include "verdict.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/gsd/sent.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

/// Returns the profile that the file is for; if it is empty, `outcome` says why that is not known.
std::string find_profile(const Files& files, std::string_view file, const gsd::Document& document,
                         Outcome& outcome)
{
    const Recognised found = recognise(files, file, document);
    if (found.profiles.size() == 1 && !found.is_guess) return found.profiles.front().name;
    outcome.exit = kNo;
    const std::string ident = "Ident_Number " + hex_of(document.number("Ident_Number").value_or(0));
    const std::string model = "Model_Name \"" + printable(document.text("Model_Name")) + '"';
    if (found.profiles.empty()) {
        outcome.refusals.push_back("the file is for another device: no profile has " + ident + ", " + model +
                                   " or Vendor_Name \"" + printable(document.text("Vendor_Name")) +
                                   "\". Choose the GSD file of a device that has a profile.");
        return {};
    }
    Json candidates = Json::array();
    std::string names;
    for (const profile::Profile& profile : found.profiles) {
        candidates.push_back(profile.name);
        names += (names.empty() ? "" : ", ") + profile.name;
    }
    outcome.facts = text_of({{"candidates", candidates}});
    outcome.refusals.push_back("the file does not say which device it is for: " + ident + " and " + model +
                               " do not belong to one profile alone. Name the profile, one of " + names +
                               '.');
    return {};
}

class Importer {
public:
    /// `cfg`: the master's last Chk_Cfg; empty = not known.
    Importer(const gsd::Document& document, const profile::Profile& profile, std::vector<std::uint8_t> cfg)
        : document_(document), profile_(profile), cfg_(std::move(cfg))
    {
        mapping_.profile = profile.name;
    }

    Result<profile::Mapping, std::vector<std::string>> read()
    {
        identity();
        parameters();
        if (refused_.empty()) {
            max_tsdr();
            own_modules();
            own_lengths();
        }
        if (!refused_.empty()) return Failure{std::move(refused_)};
        return std::move(mapping_);
    }
    /// Returns what a person has to know of it.
    const std::vector<std::string>& remarks() const { return remarks_; }

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

    bool is_fixed() const { return gsd::plugging_of(document_) == gsd::Plugging::fixed; }

    /// Sets the parameters as the station accepts them, with the keys that it needs for this file.
    void parameters()
    {
        modules_can_be_read();
        const bool asks = !cfg_.empty() && !is_fixed();
        if (asks) known_ = gsd::modules_in(document_, cfg_);
        const auto& modules = known_;
        if (asks && !modules)
            refused_.push_back("the Chk_Cfg " + profile::hex_octets(cfg_) +
                               " is not made of the modules of the file.");
        if (!refused_.empty()) return;
        const PlantKeys found = plant_keys(profile_, document_, modules);
        const profile::FileVerdict& verdict = found.verdict;
        if (verdict.refused)
            refuse(found);
        else if (found.is_ambiguous)
            refused_.emplace_back(
                "the file does not say where in User_Prm_Data its tags begin: several places would do. Ask who made the file, and write a mapping with tags_at.");
        else if (!is_fixed() && !modules && verdict.other_lists && gsd::any_own_parameters(document_))
            refused_.emplace_back(
                "the modules of the file bring parameters of their own: what is sent depends on the modules of the master's project. Give the Chk_Cfg that the master sends.");
        if (!refused_.empty()) return;
        profile::Selection& selection = mapping_.selection;
        selection.tags_at = found.keys.tags_at;
        selection.identifiers = found.keys.identifiers;
        if (const std::string names = names_of(found.keys); !names.empty())
            remarks_.push_back("the station takes this file only with " + names +
                               " of the mapping: write into its [[station]] what is there.");
        if (verdict.tags_are_open) return; // the master's project has them
        const bool is_known = is_fixed() || modules || !verdict.other_lists;
        selection.demand = is_known && verdict.taken.demand;
        std::vector<profile::GsdParameter> words = profile::parameters_of(verdict.taken);
        if (is_known) {
            selection.list = std::move(words);
        } else if (!words.empty()) {
            selection.tags.emplace();
            for (const profile::GsdParameter& word : words) selection.tags->push_back(word.tag);
            remarks_.emplace_back(
                "the directions of the tags are in the master's project: its modules say them.");
        }
    }

    /// One that cannot be read is never left out.
    void modules_can_be_read()
    {
        for (const gsd::Module& module : document_.modules)
            if (module.identifiers.empty())
                refused_.push_back("line " + std::to_string(module.line) +
                                   ": the identifiers of the module \"" + utf8_of_latin1(module.name) +
                                   "\" cannot be read: correct the line, or remove the module.");
    }

    void refuse(const PlantKeys& found)
    {
        const profile::Refused& why = *found.verdict.refused;
        std::string words = why.line > 0 ? "line " + std::to_string(why.line) + ": " : "";
        words += sentence(why) + ' ';
        if (!found.verdict.limit.empty()) words += found.verdict.limit + ' ';
        for (const std::string& one : found.no_identifiers)
            words += "An identifier of its modules, " + one + ' ';
        refused_.push_back(words + "The file is for another device than the profile " + profile_.name +
                           ", or it is faulty.");
    }

    /// The modules of the file, where the profile would make others.
    void own_modules()
    {
        const gsd::Document made = again();
        const auto same = [](const gsd::Module& a, const gsd::Module& b) {
            return a.name == b.name && a.identifiers == b.identifiers;
        };
        const bool is_same = std::equal(document_.modules.begin(), document_.modules.end(),
                                        made.modules.begin(), made.modules.end(), same) &&
                             gsd::plugging_of(document_) == gsd::plugging_of(made);
        if (is_same) return;
        std::vector<const gsd::Module*> own;
        if (is_fixed())
            own = gsd::plugged_modules(document_);
        else
            for (const gsd::Module& module : document_.modules) own.push_back(&module);
        for (const gsd::Module* module : own)
            mapping_.selection.modules.push_back(
                {printable(utf8_of_latin1(module->name)), module->identifiers, is_fixed()});
    }

    void own_lengths()
    {
        profile::PlantLengths& lengths = mapping_.selection.lengths;
        const gsd::Document made = again();
        const auto own = [&](std::string_view keyword, std::uint32_t most) -> std::optional<std::uint32_t> {
            const auto theirs = document_.number(keyword);
            if (!theirs || *theirs > most || made.number(keyword) == theirs) return std::nullopt;
            return theirs;
        };
        const std::size_t theirs =
            gsd::sent_by_master(document_, known_ ? *known_ : gsd::plugged_modules(document_))
                .user.octets.size();
        if (theirs != gsd::sent_by_master(made, gsd::plugged_modules(made)).user.octets.size())
            lengths.user_prm_data = static_cast<std::uint32_t>(theirs);
        lengths.max_module = own("Max_Module", 0xFF);
        lengths.max_input = own("Max_Input_Len", 0xFF);
        lengths.max_output = own("Max_Output_Len", 0xFF);
        lengths.max_data = own("Max_Data_Len", 0xFFFF);
    }

    /// The file that the mapping makes.
    gsd::Document again() const
    {
        return gsd::parse(gsd::write(profile::draft_of(profile_, mapping_.selection).device));
    }

    /// The machine's own MaxTsdr: what the file has where it has more than the profile.
    void max_tsdr()
    {
        const gsd::Document made = again();
        for (const gsd::Entry& entry : made.keywords) {
            if (!entry.keyword.starts_with("MaxTsdr_")) continue;
            const auto ours = made.number(entry.keyword), theirs = document_.number(entry.keyword);
            if (ours && theirs && *theirs > *ours && *theirs <= 0xFFFF)
                mapping_.selection.max_tsdr = std::max(mapping_.selection.max_tsdr.value_or(0), *theirs);
        }
    }

    const gsd::Document& document_;
    const profile::Profile& profile_;
    const std::vector<std::uint8_t> cfg_;
    profile::Mapping mapping_;
    std::vector<std::string> refused_, remarks_;
    std::optional<std::vector<const gsd::Module*>> known_; ///< of a choice: those of the master's Chk_Cfg
};

/// Collects what the mapping does not make again.
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
            if (matters(one)) what_matters.push_back(what);
            facts.push_back({{"line", one.line},
                             {"keyword", what},
                             {"left", one.left ? Json(printable(*one.left)) : Json()},
                             {"right", one.right ? Json(printable(*one.right)) : Json()},
                             {"text", sentence}});
        }
    }

    Json facts = Json::array();
    std::vector<std::string> what_matters; ///< a master would send or wait for something else

private:
    /// Returns whether a master takes this from the file for its telegrams and its times. A keyword that is
    /// missing is 0 where it is a yes or no, and not said where it is a length.
    static bool matters(const Difference& one)
    {
        const std::string what = to_lower(one.what);
        const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
            return std::find(names.begin(), names.end(), what) != names.end();
        };
        const bool is_flag = what.ends_with("_supp") || is_one_of({"fail_safe", "fail_safe_required",
                                                                   "dpv1_slave", "c1_read_write_required"});
        if (is_flag && !is_one_of({"auto_baud_supp", "fms_supp", "set_slave_add_supp", "f_device_supp"}))
            return one.left.value_or("0") != one.right.value_or("0");
        const bool is_sent = what == "set_prm" || what == "chk_cfg" || what == "ident_number" ||
                             what.starts_with("module ") || what.starts_with("parameters of module ") ||
                             what == "fixpresetmodules";
        const bool is_limit = what.starts_with("maxtsdr_") || what == "min_slave_intervall" ||
                              (what.starts_with("max_") && (what.ends_with("_len") || what == "max_module"));
        return is_sent || (is_limit && one.left && one.right);
    }

    Outcome& outcome_;
};

/// Refused unless that is wanted: `lossy`.
Json lost_of(Outcome& outcome, std::string_view file, const gsd::Document& document,
             const profile::Draft& draft, const ImportOptions& options)
{
    const std::string made = gsd::write(draft.device);
    Lost lost{outcome};
    lost.add(differences(document, gsd::parse(made), options.cfg), "a mapping cannot hold it.");
    lost.add(name_differences(file, made), "the tag table has no name for it. Take the table that has it.");
    std::string matters;
    for (const std::string& what : lost.what_matters) matters += (matters.empty() ? "" : ", ") + what;
    if (!matters.empty() && !options.lossy) {
        outcome.exit = kNo;
        outcome.refusals.push_back(
            "a master would send or wait for something else with the file that this mapping makes: " +
            matters + ". Keep the plant's own file, or import it with losses.");
    }
    return lost.facts;
}

/// Returns nullopt if no table was given; one that cannot be read was refused before.
std::optional<profile::OwnTable> table_of(const Files& files, const std::string& table)
{
    if (table.empty()) return std::nullopt;
    const auto text = input::read_text(files.source, table);
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
    return Importer{document, profile, {}}.read();
}

Outcome import_file(const Files& files, std::string_view file, const ImportOptions& options)
{
    const gsd::Document document = gsd::parse(file);
    if (!document.has_section) return refused(not_read(document));
    if (document.number("Station_Type") == 1U)
        return refused("the file is that of a master (Station_Type = 1): choose the file of the slave.");
    if (document.text("Model_Name").find("T630") != std::string::npos)
        return refused("the file is for a T630, which this project does not replace.");
    Outcome outcome;
    say_unread(document, "", outcome);
    const std::string name =
        options.profile.empty() ? find_profile(files, file, document, outcome) : options.profile;
    if (outcome.exit != kFine) return outcome;
    const auto device = load(files, name, options.table, outcome);
    if (!device) return outcome;
    Importer importer{document, *device, options.cfg};
    const auto read = importer.read();
    if (!read) {
        outcome.exit = kNo;
        for (const std::string& sentence : read.error()) outcome.refusals.push_back(printable(sentence));
        return outcome;
    }
    profile::Mapping mapping = *read;
    mapping.table = table_of(files, options.table);
    const profile::Draft draft = profile::draft_of(*device, mapping.selection);
    Json facts;
    add_mapping(facts, mapping);
    for (const std::string& remark : importer.remarks()) outcome.messages.push_back("note: " + remark);
    for (const profile::Note& note : draft.notes)
        if (note.refuses)
            outcome.refusals.push_back(printable(note.text));
        else
            outcome.messages.push_back("warning: " + printable(note.text));
    if (!outcome.refusals.empty()) outcome.exit = kNo; // the mapping is there all the same, to be corrected
    facts["lost"] = lost_of(outcome, file, document, draft, options);
    put_mapping_file(outcome, mapping, device->tags);
    outcome.facts = text_of(facts);
    return outcome;
}

} // namespace dpslave::configurator
