// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/sent.hpp"

#include "parameters.hpp"
#include "text.hpp"

#include "dpslave/gsd/identifier.hpp"

#include <algorithm>

namespace dpslave::gsd {
namespace {

constexpr std::size_t kLongestUser = 237; ///< octets of User_Prm_Data (wire reference 4.4)
constexpr std::string_view kLongest = "Max_User_Prm_Data_Len";
constexpr std::string_view kConstants = "Ext_User_Prm_Data_Const";
constexpr std::string_view kReference = "Ext_User_Prm_Data_Ref";

constexpr std::uint32_t kMostOctets = 244; ///< of Chk_Cfg, and of the data of one direction

bool is_modular(const Document& document)
{
    return document.number("Modular_Station").value_or(0) == 1;
}

/// The new style: constants, and the defaults over them, at their offsets.
class Area {
public:
    explicit Area(const std::map<std::uint32_t, ParameterType>& types) : types_(types) {}

    void put(const std::vector<Entry>& entries)
    {
        for (const Entry& entry : entries)
            if (entry.index && same_any_case(entry.keyword, kConstants)) constants(entry);
        for (const Entry& entry : entries)
            if (entry.index && same_any_case(entry.keyword, kReference)) reference(entry);
    }
    void resize(std::size_t length)
    {
        taken_.octets.resize(std::min(length, kLongestUser));
        taken_.lines.resize(taken_.octets.size());
    }
    const LinedOctets& taken() const { return taken_; }

private:
    void constants(const Entry& entry)
    {
        std::size_t at = *entry.index;
        for (const std::uint8_t octet : parse_octets(entry.value).value_or(std::vector<std::uint8_t>{}))
            bits(at++, 0xFF, octet, entry.line);
    }

    /// High octet first.
    void reference(const Entry& entry)
    {
        const auto found = types_.find(parse_number(entry.value).value_or(0x10000));
        if (found == types_.end()) return;
        const ParameterType& type = found->second;
        const auto value = static_cast<std::uint64_t>(type.value);
        for (std::size_t i = 0; i < type.octets; ++i) {
            const std::uint64_t octet = value >> 8 * (type.octets - 1 - i) << type.shift;
            bits(*entry.index + i, type.bits, static_cast<std::uint8_t>(octet), entry.line);
        }
    }

    void bits(std::size_t at, std::uint8_t mask, std::uint8_t octet, unsigned line)
    {
        if (at >= kLongestUser) return;
        if (at >= taken_.octets.size()) resize(at + 1);
        std::uint8_t& there = taken_.octets[at];
        there = static_cast<std::uint8_t>((there & ~mask) | (octet & mask));
        taken_.lines[at] = line;
    }

    const std::map<std::uint32_t, ParameterType>& types_;
    LinedOctets taken_;
};

unsigned line_of(const Document& document, std::string_view keyword)
{
    const Entry* entry = document.find(keyword);
    return entry == nullptr ? 0 : entry->line;
}

LinedOctets old_style(const Document& document)
{
    LinedOctets user;
    const unsigned line = line_of(document, "User_Prm_Data");
    for (const std::uint8_t octet : document.octets("User_Prm_Data")) user.add(octet, line);
    const std::size_t length =
        std::min<std::size_t>(document.number("User_Prm_Data_Len").value_or(0), kLongestUser);
    user.octets.resize(length);
    user.lines.resize(length);
    return user;
}

const Block* block_of(const Document& document, const Module& module)
{
    const auto found = std::find_if(document.blocks.begin(), document.blocks.end(), [&](const Block& block) {
        return block.kind == "Module" && block.line == module.line;
    });
    return found == document.blocks.end() ? nullptr : &*found;
}

std::optional<std::uint32_t> own_length(const Block& module)
{
    std::optional<std::uint32_t> length;
    for (const Entry& entry : module.body)
        if (same_any_case(entry.keyword, "Ext_Module_Prm_Data_Len")) length = parse_number(entry.value);
    return length;
}

/// A keyword of it is enough: Max_User_Prm_Data_Len is missing in many public files (wire reference 9.4).
bool is_new_style(const Document& document)
{
    return std::any_of(document.keywords.begin(), document.keywords.end(), [](const Entry& entry) {
        return same_any_case(entry.keyword, kLongest) || same_any_case(entry.keyword, kConstants) ||
               same_any_case(entry.keyword, kReference);
    });
}

LinedOctets new_style(const Document& document, const std::map<std::uint32_t, ParameterType>& types)
{
    Area device{types};
    device.put(document.keywords);
    return device.taken();
}

/// A module without a length of its own adds the octets that it lists.
LinedOctets of_module(const Document& document, const std::map<std::uint32_t, ParameterType>& types,
                      const Module& module)
{
    const Block* block = block_of(document, module);
    if (block == nullptr) return {};
    Area own{types};
    own.put(block->body);
    if (const auto length = own_length(*block)) own.resize(*length);
    return own.taken();
}

/// The octets of the modules follow those of the device.
void add_modules(const Document& document, const std::map<std::uint32_t, ParameterType>& types,
                 const std::vector<const Module*>& modules, LinedOctets& user)
{
    for (const Module* module : modules) {
        const LinedOctets own = of_module(document, types, *module);
        for (std::size_t i = 0; i < own.octets.size(); ++i) user.add(own.octets[i], own.lines[i]);
    }
    const std::size_t longest = document.number(kLongest).value_or(kLongestUser);
    const std::size_t length = std::min({user.octets.size(), longest, kLongestUser});
    user.octets.resize(length);
    user.lines.resize(length);
}

std::string names_of(const Document& document)
{
    std::string all;
    for (const Module& module : document.modules) all += (all.empty() ? "" : ", ") + in_quotes(module.name);
    return all;
}

/// Returns nullptr if there is none; `why` then says it.
const Module* named(const Document& document, const std::string& name, std::string& why)
{
    if (name.starts_with('#')) {
        const std::size_t place = parse_number(std::string_view{name}.substr(1)).value_or(0);
        if (place >= 1 && place <= document.modules.size()) return &document.modules[place - 1];
        why = "the file has no module " + name + ": it has " + count_of(document.modules.size(), "module") +
              '.';
        return nullptr;
    }
    const Module* found = nullptr;
    for (const Module& module : document.modules) {
        if (!same_any_case(module.name, name)) continue;
        if (found != nullptr) {
            why =
                "several modules have the name " + in_quotes(name) + ": write #1 for the first of the file.";
            return nullptr;
        }
        found = &module;
    }
    if (found == nullptr)
        why = "the file has no module " + in_quotes(name) + "; it has: " + names_of(document) + '.';
    return found;
}

} // namespace

void LinedOctets::add(std::uint8_t octet, unsigned line)
{
    octets.push_back(octet);
    lines.push_back(line);
}

Plugging plugging_of(const Document& document)
{
    return plugged_modules(document).empty() ? Plugging::choice : Plugging::fixed;
}

Limits limits_of(const Document& document)
{
    const bool modular = is_modular(document);
    const auto most = [&](std::string_view keyword) {
        return modular ? document.number(keyword).value_or(kMostOctets) : 2 * kMostOctets;
    };
    return {.modules =
                std::min(document.number("Max_Module").value_or(modular ? kMostOctets : 1), kMostOctets),
            .in = most("Max_Input_Len"),
            .out = most("Max_Output_Len"),
            .data = modular ? document.number("Max_Data_Len").value_or(2 * kMostOctets) : 2 * kMostOctets};
}

std::string broken_limit(const Document& document, const std::vector<const Module*>& modules, bool with_line)
{
    const Limits limits = limits_of(document);
    std::vector<std::uint8_t> cfg;
    for (const Module* module : modules)
        cfg.insert(cfg.end(), module->identifiers.begin(), module->identifiers.end());
    const Identifier sum = sum_of_identifiers(cfg).value_or(Identifier{});
    const auto words = [&](std::string_view keyword, std::size_t most, const std::string& has) {
        const unsigned line = with_line ? line_of(document, keyword) : 0;
        return std::string{keyword} + (line > 0 ? " in line " + std::to_string(line) : "") + " allows " +
               std::to_string(most) + ", and " + has + '.';
    };
    if (modules.size() > limits.modules)
        return words("Max_Module", limits.modules, count_of(modules.size(), "module") + " are more");
    if (sum.in > limits.in)
        return words("Max_Input_Len", limits.in, "the modules make " + count_of(sum.in, "octet"));
    if (sum.out > limits.out)
        return words("Max_Output_Len", limits.out, "the modules make " + count_of(sum.out, "octet"));
    if (sum.in + sum.out > limits.data)
        return words("Max_Data_Len", limits.data, "the modules make " + count_of(sum.in + sum.out, "octet"));
    return {};
}

std::vector<const Module*> plugged_modules(const Document& document)
{
    if (!is_modular(document) && document.modules.size() == 1) return {&document.modules.front()};
    return document.number("FixPresetModules").value_or(0) == 1 ? preset_modules(document)
                                                                : std::vector<const Module*>{};
}

std::vector<const Module*> preset_modules(const Document& document)
{
    std::vector<const Module*> out;
    for (const Module& module : document.modules)
        if (module.preset) out.push_back(&module);
    return out;
}

Sent sent_by_master(const Document& document, const std::vector<const Module*>& modules)
{
    const auto is_on = [&](std::string_view keyword) { return document.number(keyword).value_or(0) == 1; };
    Sent sent;
    const auto ident = document.number("Ident_Number").value_or(0);
    sent.ident = static_cast<std::uint16_t>(ident <= 0xFFFF ? ident : 0);
    sent.ident_line = line_of(document, "Ident_Number");
    sent.sync = is_on("Sync_Mode_supp");
    sent.sync_line = line_of(document, "Sync_Mode_supp");
    sent.freeze = is_on("Freeze_Mode_supp");
    sent.freeze_line = line_of(document, "Freeze_Mode_supp");
    const auto types = parameter_types(document);
    const bool is_new = is_new_style(document);
    sent.user = is_new ? new_style(document, types) : old_style(document);
    add_modules(document, types, modules, sent.user);
    sent.length_line = line_of(document, is_new ? kLongest : "User_Prm_Data_Len");
    if (is_new && sent.length_line == 0 && !sent.user.lines.empty())
        sent.length_line = sent.user.lines.front();
    for (const Module* module : modules)
        for (const std::uint8_t octet : module->identifiers) sent.cfg.add(octet, module->line);
    return sent;
}

std::vector<std::uint8_t> own_parameters(const Document& document, const Module& module)
{
    return of_module(document, parameter_types(document), module).octets;
}

bool any_own_parameters(const Document& document)
{
    return std::any_of(document.modules.begin(), document.modules.end(),
                       [&](const Module& module) { return !own_parameters(document, module).empty(); });
}

std::vector<std::uint8_t> set_prm_of(const Sent& sent)
{
    constexpr unsigned kLockReq = 0x80, kSyncReq = 0x20, kFreezeReq = 0x10;
    const unsigned status = kLockReq | (sent.sync ? kSyncReq : 0) | (sent.freeze ? kFreezeReq : 0);
    std::vector<std::uint8_t> octets{static_cast<std::uint8_t>(status),
                                     0,
                                     0,
                                     11, // min T_SDR
                                     static_cast<std::uint8_t>(sent.ident >> 8),
                                     static_cast<std::uint8_t>(sent.ident & 0xFF),
                                     0};
    octets.insert(octets.end(), sent.user.octets.begin(), sent.user.octets.end());
    return octets;
}

std::optional<std::vector<const Module*>>
modules_named(const Document& document, const std::vector<std::string>& names, std::string& why)
{
    std::vector<const Module*> out;
    for (const std::string& name : names) {
        out.push_back(named(document, name, why));
        if (out.back() == nullptr) return std::nullopt;
    }
    why = broken_limit(document, out);
    if (!why.empty()) return std::nullopt;
    return out;
}

/// The shortest list: for each place of `cfg` the module that a list ends with there.
std::optional<std::vector<const Module*>> modules_in(const Document& document,
                                                     const std::vector<std::uint8_t>& cfg)
{
    constexpr std::size_t kNever = SIZE_MAX;
    std::vector<std::size_t> count(cfg.size() + 1, kNever);
    std::vector<const Module*> last(cfg.size() + 1, nullptr);
    count[0] = 0;
    for (std::size_t at = 0; at < cfg.size(); ++at)
        for (const Module& module : document.modules) {
            const std::size_t length = module.identifiers.size();
            if (count[at] == kNever || length == 0 || at + length > cfg.size()) continue;
            const auto here = cfg.begin() + static_cast<std::ptrdiff_t>(at);
            if (!std::equal(module.identifiers.begin(), module.identifiers.end(), here)) continue;
            if (count[at] + 1 >= count[at + length]) continue;
            count[at + length] = count[at] + 1;
            last[at + length] = &module;
        }
    if (count.back() == kNever) return std::nullopt;
    std::vector<const Module*> out;
    for (std::size_t at = cfg.size(); at > 0; at -= last[at]->identifiers.size()) out.push_back(last[at]);
    std::reverse(out.begin(), out.end());
    return out;
}

} // namespace dpslave::gsd
