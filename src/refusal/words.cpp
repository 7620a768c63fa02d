// SPDX-License-Identifier: Apache-2.0
#include "dpslave/refusal/words.hpp"

namespace dpslave::refusal {
namespace {

std::string hex(std::uint16_t value, int digits)
{
    std::string text = "0x";
    for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4)
        text += "0123456789ABCDEF"[value >> shift & 15];
    return text;
}

} // namespace

std::string_view code(Refusal why) noexcept
{
    using enum Refusal;
    switch (why) {
        case none: return "none";
        case prm_ident: return "prm_ident";
        case prm_watchdog: return "prm_watchdog";
        case prm_not_supported: return "prm_not_supported";
        case prm_length: return "prm_length";
        case prm_dpv1: return "prm_dpv1";
        case prm_tag_too_large: return "prm_tag_too_large";
        case prm_zero_tag: return "prm_zero_tag";
        case cfg_empty: return "cfg_empty";
        case cfg_too_long: return "cfg_too_long";
        case cfg_identifier: return "cfg_identifier";
        case cfg_too_few: return "cfg_too_few";
        case cfg_too_many: return "cfg_too_many";
        case cfg_changed: return "cfg_changed";
    }
    return "?";
}

std::string_view name_of(Service service) noexcept
{
    switch (service) {
        case Service::none: return "";
        case Service::set_prm: return "Set_Prm";
        case Service::chk_cfg: return "Chk_Cfg";
    }
    return "";
}

std::string_view advice_for(Refusal why) noexcept
{
    using enum Refusal;
    switch (why) {
        case none: return "";
        case prm_ident:
            return "use the GSD of this device in the master's project, or check that the master expects this device at this address";
        case prm_watchdog: return "set both watchdog factors to 1 to 255, or switch the watchdog off";
        case prm_not_supported: return "switch Sync and Freeze off for this slave in the master's project";
        case prm_length:
            return "check the User_Prm_Data (the hex parameters of the slave) in the master's project";
        case prm_dpv1: return "switch the DP-V1 functions off for this slave in the master's project";
        case prm_tag_too_large:
            return "check the tag numbers; three extra octets 00 at the front come from a master that treats this as a DP-V1 device";
        case prm_zero_tag: return "name a tag there, or take it out";
        case cfg_empty: return "add at least one module (identifier) to the slave in the master's project";
        case cfg_too_long: return "remove modules";
        case cfg_identifier: return "use the modules of the GSD; Demand Data can only be the first one";
        case cfg_too_few: return "add a module for each tag, or leave tags out";
        case cfg_too_many: return "name a tag in User_Prm_Data for each input and output module";
        case cfg_changed:
            return "a new configuration needs a new start-up: the master will parameterise again";
    }
    return "";
}

ExpectedAndGot expected_and_got(const RefusalDetail& refusal)
{
    using enum Refusal;
    const std::string expected = std::to_string(refusal.expected), got = std::to_string(refusal.got);
    switch (refusal.why) {
        case prm_ident: return {"Ident_Number " + hex(refusal.expected, 4), hex(refusal.got, 4)};
        case prm_length: return {expected + " octets of User_Prm_Data", got};
        case prm_tag_too_large: return {"a tag up to " + expected, got};
        case cfg_too_few:
        case cfg_too_many: return {expected + " identifiers for as many tags", got};
        case cfg_too_long: return {"at most " + expected + " identifiers", got};
        case cfg_identifier:
            return {refusal.expected != refusal.got ? hex(refusal.expected, 2) : "",
                    hex(refusal.got, 2) + (refusal.got == 0 ? ", an empty slot" : "")};
        case cfg_changed:
        case prm_watchdog:
        case prm_not_supported:
        case prm_dpv1:
            return {refusal.expected != refusal.got ? hex(refusal.expected, 2) : "", hex(refusal.got, 2)};
        case none:
        case prm_zero_tag:
        case cfg_empty: break;
    }
    return {};
}

std::string clause(const RefusalDetail& refusal)
{
    std::string all{dp::text(refusal.why)};
    if (refusal.octet != 0) all += ", octet " + std::to_string(refusal.octet);
    const auto [expected, got] = expected_and_got(refusal);
    if (!expected.empty()) all += ", expected " + expected;
    if (!got.empty()) all += ", got " + got;
    return all + "; " + std::string{advice_for(refusal.why)};
}

} // namespace dpslave::refusal
