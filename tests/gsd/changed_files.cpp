// SPDX-License-Identifier: Apache-2.0
#include "changed_files.hpp"

#include "second_hand.hpp"

#include <algorithm>
#include <set>

namespace dpslave::test {
namespace {

using Octets = std::vector<std::uint8_t>;

std::size_t first_identifier(const std::string& module)
{
    return module.find("0x", module.rfind('"'));
}
void insert_identifier(std::string& module, const std::string& text)
{
    if (const std::size_t at = first_identifier(module); at != std::string::npos) module.insert(at, text);
}
void put_into(std::string& module, const std::string& line)
{
    module.insert(module.rfind("EndModule"), line);
}
void drop_identifier(std::string& module)
{
    const std::size_t at = first_identifier(module);
    const std::size_t comma = at == std::string::npos ? at : module.find(',', at);
    if (comma != std::string::npos && comma < module.find('\r', at)) module.erase(at, comma + 1 - at);
}

} // namespace

std::string ChangedFiles::next(const profile::Profile& profile)
{
    const bool is_generic = one_in(3) && profile.personality.prm.list != dp::TagList::exact;
    std::string text = made(profile, is_generic ? profile::Selection{} : selection_for(profile));
    for (std::size_t changes = one_in(3) ? 0 : 1 + below(2); changes > 0; --changes) text = change(text);
    return text;
}

profile::Selection ChangedFiles::selection_for(const profile::Profile& profile)
{
    profile::Selection selection;
    selection.list.emplace();
    const bool has_both = profile.personality.identifiers.size() > 2;
    const std::size_t most = std::min<std::size_t>(profile.personality.max_parameters, one_in(8) ? 58 : 12);
    std::set<std::uint16_t> used;
    for (std::size_t i = below(most + 1); i > 0; --i) {
        const auto tag = static_cast<std::uint16_t>(1 + below(900));
        const auto direction = static_cast<profile::Direction>(below(has_both ? 3 : 2));
        const auto& never = profile.never_written;
        if (direction != profile::Direction::in && std::find(never.begin(), never.end(), tag) != never.end())
            continue;
        if (direction != profile::Direction::in) {
            const drive::Tag* known = profile.tags.find(tag);
            if (known != nullptr && known->access == drive::Access::read_only) continue;
        }
        if (used.insert(tag).second) selection.list->push_back({direction, tag});
    }
    selection.demand = one_in(2) || selection.list->empty();
    return selection;
}

std::string ChangedFiles::change(const std::string& text)
{
    switch (below(10)) {
        case 0: return text + "Ident_Number = " + std::to_string(1 + below(0xFFFF)) + "\r\n";
        case 1: return text + (one_in(2) ? "Sync_Mode_supp = 1\r\n" : "Freeze_Mode_supp = 1\r\n");
        case 2: return text + "Max_Module = " + std::to_string(1 + below(6)) + "\r\n";
        case 3:
            if (one_in(2))
                return text + (one_in(2) ? "Max_Input_Len = " : "Max_Output_Len = ") +
                       std::to_string(2 * below(12)) + "\r\n";
            return text + "Modular_Station = " + std::to_string(below(2)) + "\r\n";
        case 4:
        case 5:
        case 6: return with_user(text);
        default: return with_modules(text);
    }
}

std::string ChangedFiles::with_user(const std::string& text)
{
    const SecondHand file = second_hand(text);
    Octets user = file.keys.contains("User_Prm_Data") ? file.octets("User_Prm_Data") : Octets{};
    user.resize(static_cast<std::size_t>(std::max(0, file.number("User_Prm_Data_Len"))));
    switch (below(7)) {
        case 6: // what a DP-V1 device has there
            if (!user.empty())
                user[below(std::min<std::size_t>(user.size(), 3))] =
                    static_cast<std::uint8_t>(1 + below(255));
            break;
        case 0: user.push_back(static_cast<std::uint8_t>(below(256))); break;
        case 1: user.insert(user.end(), {0, static_cast<std::uint8_t>(1 + below(255))}); break;
        case 2: user.resize(user.size() - std::min<std::size_t>(user.size(), 1 + below(3))); break;
        case 3: user.insert(user.begin(), 1 + below(2), std::uint8_t{0}); break;
        default:
            if (user.empty()) break;
            const std::size_t at = below(user.size());
            user[at] = one_in(3) ? std::uint8_t{0} : static_cast<std::uint8_t>(below(256));
            if (one_in(2) && at + 1 < user.size()) user[at + 1] = 0;
    }
    std::string line = "User_Prm_Data_Len = " + std::to_string(user.size()) + "\r\nUser_Prm_Data = ";
    for (std::size_t i = 0; i < user.size(); ++i) line += (i == 0 ? "" : ",") + std::to_string(user[i]);
    return text + line + "\r\n";
}

/// In hexadecimal as it is printed; words and octets, one and several, and one of the special format.
std::string ChangedFiles::identifier()
{
    static const std::vector<std::string> kForms{"0x50", "0x60", "0x50", "0x60", "0x70",           "0x73",
                                                 "0x52", "0xD0", "0xE0", "0x10", "0xC0,0x40,0x40", "0x00"};
    return kForms[below(kForms.size())];
}

std::string ChangedFiles::with_modules(const std::string& text)
{
    std::vector<std::string> modules;
    std::string rest = text;
    for (auto at = rest.find("\nModule = "); at != std::string::npos; at = rest.find("\nModule = ")) {
        const auto end = rest.find("EndModule", at) + std::string{"EndModule\r\n"}.size();
        modules.push_back(rest.substr(at + 1, end - at - 1));
        rest.erase(at + 1, end - at - 1);
    }
    const std::size_t which = below(std::max<std::size_t>(modules.size(), 1));
    switch (below(8)) {
        case 7: // one that is plugged from the start, and may be taken out
            if (!modules.empty()) put_into(modules[which], "Preset = 1\r\n");
            break;
        case 6: // one with parameters of its own
            if (modules.empty()) break;
            if (one_in(2)) put_into(modules[which], "Ext_Module_Prm_Data_Len = 2\r\n");
            put_into(modules[which],
                     "Ext_User_Prm_Data_Const(0) = 0x00," + std::to_string(below(256)) + "\r\n");
            break;
        case 5: // many more than a station has
            for (std::size_t more = modules.empty() ? 0 : (one_in(3) ? 120 : 14); more > 0; --more)
                insert_identifier(modules[which], one_in(2) ? "0x50," : "0x60,");
            break;
        case 0: // another module
            modules.push_back("Module = \"other " + std::to_string(below(1000)) + "\" " + identifier() +
                              (one_in(2) ? "," + identifier() : "") + "\r\n" +
                              std::to_string(100 + below(100)) + "\r\nEndModule\r\n");
            break;
        case 1: // one less, or none at all
            if (one_in(2)) modules.clear();
            if (!modules.empty()) modules.erase(modules.begin() + static_cast<std::ptrdiff_t>(which));
            break;
        case 2: // one identifier more
            if (!modules.empty()) insert_identifier(modules[which], identifier() + ",");
            break;
        case 3: // one identifier less
            if (!modules.empty()) drop_identifier(modules[which]);
            break;
        default: // another in place of one
            if (modules.empty()) break;
            drop_identifier(modules[which]);
            insert_identifier(modules[which], identifier() + ",");
    }
    for (const std::string& module : modules) rest += module;
    return rest;
}

std::optional<sim::GsdTelegrams> telegrams_of(const std::string& text,
                                              const std::vector<std::string>& modules)
{
    sim::MasterSettings master;
    master.sync = master.freeze = true; // what the file offers
    master.watchdog = {};
    const bool is_empty = modules.empty(); // the reader has no telegram without a module
    auto telegrams =
        sim::gsd_telegrams(is_empty ? text + "Module = \"none\" 0x10\r\n999\r\nEndModule\r\n" : text,
                           is_empty ? std::vector<std::string>{"none"} : modules, master);
    if (!telegrams) return std::nullopt;
    if (is_empty) telegrams->chk_cfg.clear();
    return *telegrams;
}

void type_tags(sim::GsdTelegrams& telegrams, std::size_t tags_at, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = 7 + tags_at + 2 * i;
        if (at + 2 > telegrams.set_prm.size()) return;
        telegrams.set_prm[at] = 0;
        telegrams.set_prm[at + 1] = static_cast<std::uint8_t>(i + 1);
    }
}

} // namespace dpslave::test
