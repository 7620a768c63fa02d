// SPDX-License-Identifier: Apache-2.0
#include "gsd_station.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::sim {
namespace {

using Modules = std::vector<const GsdModule*>;

constexpr std::string_view kConst = "Ext_User_Prm_Data_Const", kRef = "Ext_User_Prm_Data_Ref";

constexpr std::size_t kLongestPrm = 237; ///< octets of User_Prm_Data (wire reference, 9.2)

std::string list_of(const GsdFile& file)
{
    std::string text;
    for (std::size_t i = 0; i < file.modules.size(); ++i)
        text += fmt::format("\n  #{} {} ({})", i + 1, printable(file.modules[i].name),
                            hex(file.modules[i].identifiers));
    return text;
}

/// "#3", or the name of exactly one module.
Result<const GsdModule*, std::string> module_of(const GsdFile& file, std::string_view name)
{
    if (name.starts_with('#'))
        if (const auto place = gsd_number(name.substr(1)); place) {
            if (*place >= 1 && *place <= static_cast<std::int64_t>(file.modules.size()))
                return &file.modules[static_cast<std::size_t>(*place) - 1];
            return Failure{fmt::format("there is no module {}. The modules are:{}", name, list_of(file))};
        }
    const GsdModule* found = nullptr;
    for (const GsdModule& module : file.modules) {
        if (!same_any_case(module.name, name)) continue;
        if (found != nullptr)
            return Failure{fmt::format(
                "several modules are called '{}': write the place of the one that is meant, as '#1'. The modules are:{}",
                printable(name), list_of(file))};
        found = &module;
    }
    if (found == nullptr)
        return Failure{
            fmt::format("no module is called '{}'. The modules are:{}", printable(name), list_of(file))};
    return found;
}

Result<Modules, std::string> plugged(const GsdFile& file, const std::vector<std::string>& names)
{
    Modules out;
    for (const std::string& name : names) {
        const auto module = module_of(file, name);
        if (!module) return Failure{module.error()};
        out.push_back(*module);
    }
    if (!names.empty()) return out;
    if (file.modules.empty()) return Failure{std::string{"there is no module in it"}};
    if (file.modules.size() == 1 && !file.entries.is_on("Modular_Station")) return Modules{&file.modules[0]};
    for (const GsdModule& module : file.modules)
        if (module.entries.is_on("Preset")) out.push_back(&module);
    if (out.empty())
        return Failure{fmt::format(
            "no module is plugged from the start: write --modules NAME,... with the names, or places as '#1', in the order of the slots. The modules are:{}",
            list_of(file))};
    return out;
}

/// Why `count` octets cannot be where `entry` says. Empty = they can.
std::string place_fault(const GsdEntry& entry, std::size_t count)
{
    if (!entry.at) return fmt::format("line {}: {} has no offset in brackets", entry.line, entry.key);
    if (*entry.at + count > kLongestPrm)
        return fmt::format("line {}: {}({}) ends after octet {} of User_Prm_Data, the last there can be",
                           entry.line, entry.key, *entry.at, kLongestPrm - 1);
    return {};
}

/// Empty = good.
std::string put_constants(const GsdEntry& entry, Octets& area)
{
    const auto octets = gsd_octets(entry.value);
    if (!octets) return fmt::format("line {}: '{}' is no list of octets", entry.line, printable(entry.value));
    if (std::string fault = place_fault(entry, octets->size()); !fault.empty()) return fault;
    area.resize(std::max(area.size(), *entry.at + octets->size()));
    std::copy(octets->begin(), octets->end(), area.begin() + static_cast<std::ptrdiff_t>(*entry.at));
    return {};
}

/// The default in the bits of the parameter; other bits of its octets stay. Empty = good.
std::string put_default(const GsdFile& file, const GsdEntry& entry, Octets& area)
{
    const auto wanted = gsd_number(entry.value);
    const auto found =
        std::find_if(file.parameters.rbegin(), file.parameters.rend(),
                     [&](const PrmBlock& each) { return each.reference >= 0 && each.reference == wanted; });
    if (found == file.parameters.rend())
        return fmt::format("line {}: there is no ExtUserPrmData = {}", entry.line, printable(entry.value));
    if (!found->fault.empty()) return found->fault;
    if (std::string fault = place_fault(entry, found->octets); !fault.empty()) return fault;
    area.resize(std::max(area.size(), *entry.at + found->octets));
    for (std::size_t i = 0; i < found->octets; ++i) { // high octet first
        const std::size_t shift = 8 * (found->octets - 1 - i);
        const auto mask = static_cast<std::uint8_t>(found->mask << found->first_bit >> shift);
        const auto bits = static_cast<std::uint8_t>(found->value << found->first_bit >> shift);
        std::uint8_t& octet = area[*entry.at + i];
        octet = static_cast<std::uint8_t>((octet & ~mask) | bits);
    }
    return {};
}

/// Constants, then the defaults of the parameters, which have priority over them.
Result<Octets, std::string> area_of(const GsdFile& file, const GsdEntries& entries)
{
    Octets area;
    std::string fault;
    for (const GsdEntry& entry : entries.all)
        if (fault.empty() && same_any_case(entry.key, kConst)) fault = put_constants(entry, area);
    for (const GsdEntry& entry : entries.all)
        if (fault.empty() && same_any_case(entry.key, kRef)) fault = put_default(file, entry, area);
    if (!fault.empty()) return Failure{std::move(fault)};
    return area;
}

/// User_Prm_Data of the device. Old and new style exclude each other; where both are there, a tool that knows
/// the new one takes it. Its Max_User_Prm_Data_Len is a limit, and no length to be filled up.
Result<Octets, std::string> device_prm(const GsdFile& file)
{
    const GsdEntries& entries = file.entries;
    if (entries.find("Max_User_Prm_Data_Len") != nullptr || entries.find(kConst) != nullptr ||
        entries.find(kRef) != nullptr)
        return area_of(file, entries);
    const auto length = entries.number("User_Prm_Data_Len", kLongestPrm, 0);
    if (!length) return Failure{length.error()};
    const GsdEntry* const list = entries.find("User_Prm_Data");
    if (list == nullptr) return Octets(*length, 0);
    auto octets = gsd_octets(list->value);
    if (!octets)
        return Failure{fmt::format("line {}: '{}' is no list of octets", list->line, printable(list->value))};
    octets->resize(*length);
    return *octets;
}

Result<Octets, std::string> module_prm(const GsdFile& file, const GsdModule& module)
{
    const bool is_safe =
        std::any_of(module.entries.all.begin(), module.entries.all.end(),
                    [](const GsdEntry& entry) { return to_lower(entry.key).starts_with("f_ext_"); });
    if (is_safe)
        return Failure{fmt::format("module '{}' has parameters of PROFIsafe, which dpsim does not make",
                                   printable(module.name))};
    auto area = area_of(file, module.entries);
    if (!area) return area;
    const auto length = module.entries.number("Ext_Module_Prm_Data_Len", kLongestPrm,
                                              static_cast<std::uint32_t>(area->size()));
    if (!length) return Failure{length.error()};
    area->resize(*length);
    return area;
}

/// Returns a sentence if the station has more than the file allows; empty if all is good.
std::string limit_fault(const GsdFile& file, const GsdStation& station)
{
    struct Limit {
        std::string_view key;
        std::size_t has;
        bool modular_only;
    };
    const Limit limits[]{{"Max_Module", station.modules.size(), true},
                         {"Max_Input_Len", station.lengths.inputs, true},
                         {"Max_Output_Len", station.lengths.outputs, true},
                         {"Max_Data_Len", station.lengths.inputs + station.lengths.outputs, true},
                         {"Max_User_Prm_Data_Len", station.user_prm.size(), false}};
    for (const Limit& limit : limits) {
        if (limit.modular_only && !file.entries.is_on("Modular_Station")) continue;
        const auto most = file.entries.number(limit.key, 0xFFFF, 0xFFFF);
        if (!most) return most.error();
        if (limit.has > *most)
            return fmt::format("{} = {}, but the modules make {}: plug fewer or others", limit.key, *most,
                               limit.has);
    }
    return {};
}

} // namespace

Result<GsdStation, std::string> station_of(const GsdFile& file, const std::vector<std::string>& modules)
{
    GsdStation station{.vendor = file.entries.text("Vendor_Name"), .model = file.entries.text("Model_Name")};
    if (file.entries.find("Ident_Number") == nullptr)
        return Failure{std::string{"there is no Ident_Number in it"}};
    const auto ident = file.entries.number("Ident_Number", 0xFFFF, 0);
    if (!ident) return Failure{ident.error()};
    station.ident = static_cast<std::uint16_t>(*ident);
    station.sync = file.entries.is_on("Sync_Mode_supp");
    station.freeze = file.entries.is_on("Freeze_Mode_supp");

    auto prm = device_prm(file);
    if (!prm) return Failure{prm.error()};
    station.user_prm = std::move(*prm);
    const auto chosen = plugged(file, modules);
    if (!chosen) return Failure{chosen.error()};
    for (const GsdModule* const module : *chosen) {
        if (!module->fault.empty()) return Failure{module->fault};
        const auto part = module_prm(file, *module);
        if (!part) return Failure{part.error()};
        station.modules.push_back(module->name);
        station.user_prm.insert(station.user_prm.end(), part->begin(), part->end());
        station.cfg.insert(station.cfg.end(), module->identifiers.begin(), module->identifiers.end());
    }
    const auto lengths = cfg_lengths(station.cfg);
    if (!lengths) return Failure{lengths.error()};
    station.lengths = *lengths;
    if (station.cfg.size() > 244)
        return Failure{fmt::format("{} identifier octets, but 244 are the limit", station.cfg.size())};
    if (station.user_prm.size() > kLongestPrm)
        return Failure{fmt::format("User_Prm_Data of {} octets, but {} are the limit",
                                   station.user_prm.size(), kLongestPrm)};
    if (std::string fault = limit_fault(file, station); !fault.empty()) return Failure{std::move(fault)};
    return station;
}

void apply(const GsdStation& station, MasterSettings& settings)
{
    settings.ident = station.ident;
    settings.user_prm = station.user_prm;
    settings.cfg = station.cfg;
    settings.sync = settings.sync && station.sync;
    settings.freeze = settings.freeze && station.freeze;
}

Result<GsdTelegrams, std::string>
gsd_telegrams(std::string_view text, const std::vector<std::string>& modules, MasterSettings others)
{
    const auto file = parse_gsd(text);
    if (!file) return Failure{file.error()};
    const auto station = station_of(*file, modules);
    if (!station) return Failure{station.error()};
    apply(*station, others);
    return GsdTelegrams{set_prm_unit(others), others.cfg};
}

} // namespace dpslave::sim
