// SPDX-License-Identifier: Apache-2.0
// Diagnosis, refusals, events and values that cannot be written in words.
#include "report.hpp"

#include "dpslave/dp/diagnosis_bits.hpp"

#include <fmt/format.h>

namespace dpslave::app {

namespace {

std::string octet_meaning(const config::StationConfig& station, std::size_t offset, Bytes diagnosis)
{
    switch (offset) {
        case 0: return "Station_status_1";
        case 1: return "Station_status_2";
        case 2: return "Station_status_3";
        case 3:
            return diagnosis[3] == 0xFF ? "Master_Add: none, not parameterised"
                                        : fmt::format("Master_Add: owned by master {}", diagnosis[3]);
        case 4: return "Ident_Number, high octet";
        case 5: return fmt::format("Ident_Number, low octet: 0x{:04X}", be16(diagnosis, 4));
        default: return extended_meaning(station, offset, diagnosis);
    }
}

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

/// " or one of Run, Hold": what stands for a value of this tag, as far as it can be listed.
std::string names_of_values(const drive::Tag& tag)
{
    constexpr std::size_t most = 12;
    std::string names;
    std::size_t count = 0;
    for (const drive::Label& label : tag.labels) {
        if (label.is_bit) continue;
        if (++count > most) return names + " ...";
        names += (names.empty() ? " or one of " : ", ") + label.text;
    }
    return names;
}

/// "an INT", "a WORD".
std::string with_article(std::string_view type)
{
    const bool is_vowel =
        !type.empty() && std::string_view{"AEIOU"}.find(type.front()) != std::string_view::npos;
    return fmt::format("{} {}", is_vowel ? "an" : "a", type);
}

} // namespace

report::Diagnosis diagnosis_octets(const config::StationConfig& station, Bytes diagnosis)
{
    report::Diagnosis result;
    for (std::size_t i = 0; i < diagnosis.size(); ++i)
        result.octets.push_back(
            {integer(i + 1), integer(i), diagnosis[i], octet_meaning(station, i, diagnosis)});
    for (const dp::DiagnosisBit& bit : dp::kDiagnosisBits)
        if (bit.offset < diagnosis.size() && (diagnosis[bit.offset] & bit.mask) != 0)
            result.bits.push_back(fmt::format("{}: {}", bit.name, bit.meaning));
    return result;
}

report::Diagnosis diagnosis_report(const Station& station)
{
    const dp::RefusalDetail& refused = station.bus.refusal;
    report::Diagnosis result = diagnosis_octets(*station.config, station.bus.diagnosis.bytes());
    result.name = station.config->name;
    result.hex = hex(station.bus.diagnosis.bytes());
    if (refused.why != dp::Refusal::none) result.refusal = explain(refused);
    result.last_prm = hex(station.bus.prm.bytes());
    result.last_cfg = hex(station.bus.cfg.bytes());
    result.held = station.bus.holds;
    result.unscaled = unscaled_report(station);
    if (station.drive.known && !station.drive.answers)
        result.trouble.emplace_back("the drive does not answer: its inputs are held and marked stale");
    if (const auto scales = scale_words(station)) result.trouble.push_back(*scales);
    if (station.config->tec && station.config->tec->trip.bit.tag == 0)
        result.trouble.emplace_back("trips are not known: no tag reports them, so \"no trip\" above means "
                                    "nothing; set trip_tag in [station.tec]");
    for (const Trouble& one : station.troubles) {
        result.trouble.emplace_back(one.text.data());
        result.refused.push_back({one.tag, one.is_write, std::string{code(one.error)}, one.text.data()});
    }
    return result;
}

report::Refusal explain(const dp::RefusalDetail& refusal)
{
    using enum dp::Refusal;
    report::Refusal result;
    result.code = code(refusal.why);
    if (refusal.octet != 0) result.octet = integer(refusal.octet);
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
            const report::Refusal why = explain(event.refusal);
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

std::string bad_value_words(const drive::Tag& tag, AccessError error)
{
    const auto limit = [&tag](std::int32_t counts) {
        return drive::displayed(tag, static_cast<std::uint16_t>(counts));
    };
    switch (error) {
        case AccessError::out_of_range:
            if (tag.min && tag.max) return fmt::format("takes {} to {}", limit(*tag.min), limit(*tag.max));
            return "does not fit into 16 bit with the decimals of the tag table";
        case AccessError::unsupported_type:
            return fmt::format("{} is {}, which is not transported", tag.name,
                               with_article(drive::text(tag.type)));
        default:
            return fmt::format("takes {}{}{}", with_article(drive::text(tag.type)),
                               tag.decimals > 0 ? fmt::format(" with up to {} decimal{}", tag.decimals,
                                                              tag.decimals == 1 ? "" : "s")
                                                : std::string{},
                               names_of_values(tag));
    }
}

} // namespace dpslave::app
