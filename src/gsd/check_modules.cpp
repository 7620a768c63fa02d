// SPDX-License-Identifier: Apache-2.0
#include "check_parts.hpp"
#include "text.hpp"

#include "dpslave/gsd/device.hpp"
#include "dpslave/gsd/identifier.hpp"
#include "dpslave/gsd/sent.hpp"

#include <map>

namespace dpslave::gsd {
namespace {

constexpr std::size_t kMaxCfgOctets = 244; ///< of Chk_Cfg, and of a module from GSD_Revision 1 on

/// Judges one module by itself: its count, its form, and the limits of the device.
void check_identifiers(Judge& judge, const Module& module)
{
    if (module.identifiers.empty()) return; // the parser has reported why
    const std::string has = "the module " + in_quotes(module.name) + " has " +
                            count_of(module.identifiers.size(), "identifier octet") + ": ";
    if (module.identifiers.size() > kMaxCfgOctets)
        judge.say(module.line, Weight::error,
                  has + std::to_string(kMaxCfgOctets) + " are allowed. Split it.");
    else if (judge.revision == 0 && module.identifiers.size() > kMaxModuleOctets)
        judge.say(module.line, kLivesInTheField,
                  has + std::to_string(kMaxModuleOctets) + " are allowed without GSD_Revision. Split it.");
    const auto sum = sum_of_identifiers(module.identifiers);
    if (!sum) {
        judge.say(module.line, Weight::error,
                  "the identifiers of the module " + in_quotes(module.name) +
                      " are cut short: an octet of the special format announces more octets than follow.");
        return;
    }
    const struct {
        const char* keyword;
        std::size_t octets;
        const char* what;
    } directions[] = {{"Max_Input_Len", sum->in, "input"}, {"Max_Output_Len", sum->out, "output"}};
    for (const auto& direction : directions)
        if (const auto max = judge.document.number(direction.keyword); max && direction.octets > *max)
            judge.say(module.line, Weight::error,
                      "the module " + in_quotes(module.name) + " has " +
                          count_of(direction.octets, std::string{direction.what} + " octet") +
                          ", more than " + direction.keyword + ": correct one of the two.");
}

void check_names(Judge& judge)
{
    std::map<std::string, unsigned> names;
    std::map<std::uint32_t, unsigned> references;
    for (const Module& module : judge.document.modules) {
        if (module.name.size() > kMaxText)
            judge.say(module.line, Weight::error,
                      "the module's name has " + std::to_string(module.name.size()) +
                          " characters: 32 are allowed.");
        const auto [first, is_first] = names.try_emplace(module.name, module.line);
        if (!is_first && !module.name.empty())
            judge.say(module.line, kLivesInTheField,
                      "the module " + in_quotes(module.name) + " is there already (line " +
                          std::to_string(first->second) + "): give it a name of its own.");
        if (!module.reference) {
            if (judge.revision >= 3)
                judge.say(
                    module.line, Weight::error,
                    "the module " + in_quotes(module.name) +
                        " has no reference number, which GSD_Revision 3 demands: write one in the next line.");
            continue;
        }
        const auto [same_number, is_new] = references.try_emplace(*module.reference, module.line);
        if (!is_new)
            judge.say(module.line, Weight::error,
                      "the reference number " + std::to_string(*module.reference) + " of the module " +
                          in_quotes(module.name) + " belongs to the one of line " +
                          std::to_string(same_number->second) + " already: take another.");
    }
}

void check_station(Judge& judge)
{
    const Document& document = judge.document;
    if (document.modules.empty())
        return judge.say(
            0, Weight::error,
            "there is no module, so Chk_Cfg has no octet: add at least one Module ... EndModule.");
    const bool modular = judge.on("Modular_Station");
    const auto max = document.number("Max_Module");
    if (!modular && document.modules.size() != 1)
        judge.say(document.modules[1].line, kLivesInTheField,
                  "a compact station has one module: remove the others, or write Modular_Station = 1.");
    if (!modular && max && *max != 1)
        judge.say(judge.line_of("Max_Module"), kLivesInTheField,
                  "a compact station has one module: write Max_Module = 1, or Modular_Station = 1.");

    const auto plugged = preset_modules(document);
    if (!modular || plugged.empty()) return;
    if (max && plugged.size() > *max)
        judge.say(plugged.back()->line, Weight::error,
                  "more modules are preset than Max_Module allows: correct one of the two.");
    std::size_t in = 0, out = 0;
    for (const Module* module : plugged) {
        const auto sum = sum_of_identifiers(module->identifiers);
        in += sum ? sum->in : 0;
        out += sum ? sum->out : 0;
    }
    if (in > document.number("Max_Input_Len").value_or(244) ||
        out > document.number("Max_Output_Len").value_or(244))
        judge.say(plugged.back()->line, Weight::error,
                  "the preset modules have " + std::to_string(in) + " input and " + std::to_string(out) +
                      " output octets, more than Max_Input_Len or Max_Output_Len: correct one of the two.");
}

} // namespace

void check_modules(Judge& judge)
{
    if (judge.on("Station_Type")) return; // a master has none
    check_station(judge);
    check_names(judge);
    for (const Module& module : judge.document.modules) check_identifiers(judge, module);
}

} // namespace dpslave::gsd
