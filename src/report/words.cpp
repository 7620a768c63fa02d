// SPDX-License-Identifier: Apache-2.0
#include "dpslave/report/words.hpp"

#include <fmt/format.h>

namespace dpslave::report {

namespace {

std::string_view advice_for(dp::Refusal why)
{
    using enum dp::Refusal;
    switch (why) {
        case none: return "";
        case prm_ident:
            return "use the GSD of this device in the master's project, or check that the master expects "
                   "this device at this address";
        case prm_watchdog: return "set both watchdog factors to 1 to 255, or switch the watchdog off";
        case prm_not_supported: return "switch Sync and Freeze off for this slave in the master's project";
        case prm_length:
            return "check the User_Prm_Data (the hex parameters of the slave) in the master's project";
        case prm_dpv1: return "switch the DP-V1 functions off for this slave in the master's project";
        case prm_tag_too_large:
            return "check the tag numbers; three extra octets 00 at the front come from a master that treats "
                   "this as a DP-V1 device";
        case prm_zero_tag: return "close the gap: put unused tags at the end";
        case cfg_empty: return "add at least one module (identifier) to the slave in the master's project";
        case cfg_too_long: return "remove modules";
        case cfg_identifier: return "use the modules of the GSD; Demand Data can only be the first one";
        case cfg_too_few: return "add a module for each tag, or end the list of tags with 0";
        case cfg_too_many: return "name a tag in User_Prm_Data for each input and output module";
        case cfg_changed:
            return "a new configuration needs a new start-up: the master will parameterise again";
    }
    return "";
}

} // namespace

Refusal explain(const dp::RefusalDetail& refusal)
{
    using enum dp::Refusal;
    Refusal result;
    result.code = code(refusal.why);
    if (refusal.octet != 0) result.octet = refusal.octet;
    result.telegram = dp::service_of(refusal.why) == dp::Service::chk_cfg ? "Chk_Cfg" : "Set_Prm";
    result.what = dp::text(refusal.why);
    result.advice = advice_for(refusal.why);
    switch (refusal.why) {
        case prm_ident:
            result.expected = fmt::format("Ident_Number 0x{:04X}", refusal.expected);
            result.got = fmt::format("0x{:04X}", refusal.got);
            break;
        case prm_length:
            result.expected = fmt::format("{} octets of User_Prm_Data", refusal.expected);
            result.got = fmt::format("{}", refusal.got);
            break;
        case prm_tag_too_large:
            result.expected = fmt::format("a tag up to {}", refusal.expected);
            result.got = fmt::format("{}", refusal.got);
            break;
        case cfg_too_few:
        case cfg_too_many:
            result.expected = fmt::format("{} identifiers for as many tags", refusal.expected);
            result.got = fmt::format("{}", refusal.got);
            break;
        case cfg_too_long:
            result.expected = fmt::format("at most {} identifiers", refusal.expected);
            result.got = fmt::format("{}", refusal.got);
            break;
        case cfg_changed:
        case cfg_identifier:
        case prm_watchdog:
        case prm_not_supported:
        case prm_dpv1:
            if (refusal.expected != refusal.got) result.expected = fmt::format("0x{:02X}", refusal.expected);
            result.got = fmt::format("0x{:02X}", refusal.got);
            break;
        case none:
        case prm_zero_tag:
        case cfg_empty: break;
    }
    return result;
}

std::string_view code(dp::Refusal why) noexcept
{
    using enum dp::Refusal;
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

std::string_view code(dp::LeaveReason reason) noexcept
{
    using enum dp::LeaveReason;
    switch (reason) {
        case none: return "none";
        case prm_fault: return "prm_fault";
        case not_supported: return "not_supported";
        case cfg_fault: return "cfg_fault";
        case watchdog: return "watchdog";
        case unlock: return "unlock";
        case output_length: return "output_length";
        case new_parameters: return "new_parameters";
        case stop: return "stop";
    }
    return "?";
}

std::string_view code(AccessError error) noexcept
{
    using enum AccessError;
    switch (error) {
        case none: return "none";
        case no_answer: return "no_answer";
        case not_understood: return "not_understood";
        case deferred: return "deferred";
        case no_scale: return "no_scale";
        case contradicted: return "contradicted";
        case not_kept: return "not_kept";
        case invalid_tag: return "invalid_tag";
        case read_only: return "read_only";
        case out_of_range: return "out_of_range";
        case not_stopped: return "not_stopped";
        case not_config_mode: return "not_config_mode";
        case unsupported_type: return "unsupported_type";
        case value_not_encoded: return "value_not_encoded";
    }
    return "?";
}

std::string_view code(WordState state) noexcept
{
    using enum WordState;
    switch (state) {
        case untried: return "untried";
        case good: return "good";
        case stale: return "stale";
        case invalid_tag: return "invalid_tag";
        case read_only: return "read_only";
        case out_of_range: return "out_of_range";
        case refused: return "refused";
        case unscaled: return "unscaled";
    }
    return "?";
}

std::string_view text(AccessError error) noexcept
{
    switch (error) {
        case AccessError::none: return "done";
        case AccessError::no_answer: return "the drive does not answer";
        case AccessError::deferred: return "an earlier answer of the drive is still awaited";
        case AccessError::not_understood: return "the drive did not understand the request";
        case AccessError::invalid_tag: return "invalid tag";
        case AccessError::read_only: return "read only";
        case AccessError::out_of_range: return "value under or over range";
        case AccessError::not_stopped: return "only while the drive is stopped";
        case AccessError::not_config_mode: return "only in configuration mode";
        case AccessError::unsupported_type: return "this type of parameter is not transported";
        case AccessError::value_not_encoded: return "the drive cannot read this value";
        case AccessError::no_scale: return "the drive answers with a number, and its decimals are not known";
        case AccessError::contradicted:
            return "the drive has answered with more decimals than the tag table gives";
        case AccessError::not_kept:
            return "the drive accepts the value and then holds another one: read the tag";
    }
    return "?";
}

std::string sentence(const std::string& station, const dp::Event& event)
{
    using Kind = dp::Event::Kind;
    switch (event.kind) {
        case Kind::state: {
            std::string line = fmt::format("{}: {}", station, dp::text(event.state));
            if (event.master != 0xFF) line += fmt::format(", master {}", event.master);
            if (event.reason != dp::LeaveReason::none) line += fmt::format(" ({})", dp::text(event.reason));
            return line;
        }
        case Kind::refused: {
            const Refusal why = explain(event.refusal);
            std::string line =
                fmt::format("{}: {} of master {} refused: {}", station, why.telegram, event.master, why.what);
            if (why.octet) line += fmt::format(", octet {}", *why.octet);
            if (why.expected) line += fmt::format(", expected {}", *why.expected);
            if (why.got) line += fmt::format(", got {}", *why.got);
            return line + fmt::format("; {}", why.advice);
        }
        case Kind::foreign_set_prm:
            return fmt::format("{}: master {} tried to parameterise a slave that another master owns",
                               station, event.master);
        case Kind::sync: return fmt::format("{}: Sync", station);
        case Kind::unsync: return fmt::format("{}: Unsync", station);
        case Kind::freeze: return fmt::format("{}: Freeze", station);
        case Kind::unfreeze: return fmt::format("{}: Unfreeze", station);
        case Kind::clear_data: return fmt::format("{}: Clear_Data, outputs are zero", station);
        case Kind::watchdog_of_master:
            return fmt::format(
                "{}: master {} runs without watchdog: if it is lost, the outputs keep their values for ever",
                station, event.master);
        case Kind::overflow: return fmt::format("{}: events were lost, the log has a gap", station);
    }
    return station;
}

} // namespace dpslave::report
