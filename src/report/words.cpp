// SPDX-License-Identifier: Apache-2.0
#include "dpslave/report/words.hpp"

#include "dpslave/refusal/words.hpp"

#include <fmt/format.h>

namespace dpslave::report {

Refusal explain(const dp::RefusalDetail& refusal)
{
    const auto filled = [](std::string text) {
        return text.empty() ? std::nullopt : std::optional{std::move(text)};
    };
    auto [expected, got] = refusal::expected_and_got(refusal);
    Refusal result;
    result.code = refusal::code(refusal.why);
    if (refusal.octet != 0) result.octet = refusal.octet;
    result.telegram = refusal::name_of(dp::service_of(refusal.why));
    result.what = dp::text(refusal.why);
    result.expected = filled(std::move(expected));
    result.got = filled(std::move(got));
    result.advice = refusal::advice_for(refusal.why);
    return result;
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
        case not_known: return "not_known";
        case invalid_tag: return "invalid_tag";
        case read_only: return "read_only";
        case out_of_range: return "out_of_range";
        case does_not_fit: return "does_not_fit";
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

std::string_view text(StartHold hold) noexcept
{
    switch (hold) {
        case StartHold::none: return "";
        case StartHold::unscaled: return "the scale of a tag is not known";
        case StartHold::denied: return "the drive denies a tag";
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
        case AccessError::does_not_fit:
            return "the drive's own value does not fit: it is beyond 16 bits, or no number";
        case AccessError::unsupported_type: return "this type of parameter is not transported";
        case AccessError::value_not_encoded: return "the drive cannot read this value";
        case AccessError::no_scale: return "the drive answers with a number, and its decimals are not known";
        case AccessError::contradicted:
            return "the drive has answered with more decimals than the tag table gives";
        case AccessError::not_kept:
            return "the drive accepts the value and then holds another one: read the tag";
        case AccessError::not_known:
            return "it is not known whether the drive has taken the value: it is not sent a second time";
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
        case Kind::refused:
            return fmt::format("{}: {} of master {} refused: {}", station,
                               refusal::name_of(dp::service_of(event.refusal.why)), event.master,
                               refusal::clause(event.refusal));
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
