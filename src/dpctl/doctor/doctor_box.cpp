// SPDX-License-Identifier: Apache-2.0
// The technology box: HA463561U002, "Troubleshooting" (rows B-090). Its pictures of the lamps are lost:
// the pairs are those of B-030 and B-031.
#include "doctor_rules.hpp"
#include "dpctl/cli/words.hpp"

#include "dpslave/base/option_state.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

constexpr std::string_view kBox = "HA463561U002, Troubleshooting";

/// The row of the function block; an empty object without the block.
const Json& row(const Facts& f, std::string_view name)
{
    static const Json nothing = Json::object();
    for (const Json& one : list(f.tec, "rows"))
        if (text(one, "name") == name) return one;
    return nothing;
}

bool fault_is(const Facts& f, OptionFault fault)
{
    return integer(row(f, "FAULT"), "value") == static_cast<std::int64_t>(fault);
}

/// FAULT is NONE, and NETWORK STATE this.
bool network_is(const Facts& f, NetworkState state)
{
    return fault_is(f, OptionFault::none) &&
           integer(row(f, "NETWORK STATE"), "value") == static_cast<std::int64_t>(state);
}

std::string fault_words(const Facts& f)
{
    return "FAULT is " + text(row(f, "FAULT"), "shown");
}

std::string with_refusal(const Facts& f, std::string_view network_state)
{
    const std::string why = refusal(f);
    return fmt::format("NETWORK STATE is {}{}", network_state, why.empty() ? "" : "; " + why);
}

constexpr std::array kNoPowerSteps = std::to_array<std::string_view>({
    "No power at the drive: check and apply power to the drive.",
    "Not installed correctly: check the connections between gateway and drive (605A & B: the ribbon cable).",
    "Hardware fault: journalctl -u dpslaved names the port that cannot be opened. With the box itself: if "
    "HEALTH and RUN are off, replace the drive, else the box. BEWARE OF ELECTRIC SHOCK under the terminal "
    "cover.",
});
constexpr std::array kSelfTestSteps = std::to_array<std::string_view>({
    "The self-test has failed: replace the box; of the gateway: journalctl -u dpslaved says what failed.",
});
constexpr std::array kTypeSteps = std::to_array<std::string_view>({
    "Select the matching value for TYPE in the TEC OPTION function block: dpctl tec set TYPE \"PROFIBUS DP\"",
    "With the box itself: fit the right one.",
});
constexpr std::array kParameterSteps = std::to_array<std::string_view>({
    "Select a legal value for the parameter in the TEC OPTION function block: dpctl tec shows values and "
    "ranges.",
});
constexpr std::array kBoxLineSteps = std::to_array<std::string_view>({
    "Check wiring: continuity of A and B to the master, the correct terminals, the integrity of the "
    "screening.",
    "Ensure that the maximum line length for the baud rate is not exceeded (below).",
    "Ensure that the last unit on the line is terminated correctly. Some equipment has built-in resistors "
    "that may be switched in and out of circuit.",
});
constexpr std::array kWaitPrmSteps = std::to_array<std::string_view>({
    "Check the slave ADDRESS. Check that it is unique.",
    "Ensure that the network has been correctly configured and that the configuration has been downloaded to "
    "the master.",
    "Verify that the GSD file is correct: dpctl gsd check FILE",
    "INT DIAGNOSTIC with INT DIAG SELECT 0 has the code of the last refused telegram; dpctl diag has it in "
    "words.",
});
constexpr std::array kWaitCfgSteps = std::to_array<std::string_view>({
    "Refer to the internal diagnostics: INT DIAGNOSTIC with INT DIAG SELECT 0; dpctl diag has it in words.",
    "Compare the modules in the master's project with the tags of User_Prm_Data: as many, in the same order.",
});
constexpr std::array kReadWriteSteps = std::to_array<std::string_view>({
    "Refer to the internal diagnostics: INT DIAG SELECT 300 to 329 shows the access error of parameter 0 to "
    "29.",
    "dpctl io and dpctl diag name the tag.",
});
constexpr std::array kTripSteps = std::to_array<std::string_view>({
    "Remove the cause at the drive and reset the trip there; the master reads it in the diagnosis of the "
    "slave.",
});
constexpr std::array kTecNoteSteps = std::to_array<std::string_view>({
    "dpctl tec shows the function block.",
});
constexpr std::array kWorksSteps = std::to_array<std::string_view>({
    "The unit should now be working. If there is still a problem, check your tag numbers: dpctl io, dpctl "
    "tag.",
});

std::string seen_no_power(const Facts& f)
{
    const bool off = fault_is(f, OptionFault::hardware) || fault_is(f, OptionFault::missing);
    return off ? fault_words(f) : std::string{};
}
std::string seen_self_test(const Facts& f)
{
    return fault_is(f, OptionFault::self_test) ? fault_words(f) : std::string{};
}
std::string seen_type(const Facts& f)
{
    return fault_is(f, OptionFault::type_mismatch) ? fault_words(f) : std::string{};
}
std::string seen_parameter(const Facts& f)
{
    return fault_is(f, OptionFault::parameter) ? fault_words(f) : std::string{};
}
std::string seen_box_silent(const Facts& f)
{
    if (has_just_started(f)) return {};
    if (network_is(f, NetworkState::wait_param)) return silence(f);
    if (!network_is(f, NetworkState::baud_search) && !network_is(f, NetworkState::disabled)) return {};
    const std::string silent = silence(f);
    return silent.empty() ? "NETWORK STATE is BAUD SEARCH or DISABLED" : silent;
}
std::string seen_wait_prm(const Facts& f)
{
    const bool waits = network_is(f, NetworkState::wait_param) && silence(f).empty();
    return waits && !has_just_started(f) ? with_refusal(f, "WAIT PARAM") : std::string{};
}
std::string seen_wait_cfg(const Facts& f)
{
    return network_is(f, NetworkState::wait_config) ? with_refusal(f, "WAIT CONFIG") : std::string{};
}
std::string seen_read_write(const Facts& f)
{
    if (!network_is(f, NetworkState::data_ex_error)) return {};
    const std::string trouble = tag_trouble(f);
    return trouble.empty() ? "NETWORK STATE is DATA EX ERROR" : trouble;
}
std::string seen_works(const Facts& f)
{
    return network_is(f, NetworkState::data_exchange) ? "NETWORK STATE is DATA EXCHANGE" : "";
}
std::string seen_trip(const Facts& f)
{
    return flag(f.tec, "tripped") ? "trip " + text(f.tec, "trip") : std::string{};
}
std::string seen_tec_notes(const Facts& f)
{
    return joined(list(f.tec, "notes"), " ");
}

constexpr std::array kRules = std::to_array<Rule>({
    {"box.no_power", Scope::station, Rank::checklist,
     "NETWORK off, MODULE off (FAULT is HARDWARE or MISSING)",
     "No power, not installed correctly, or hardware fault", kNoPowerSteps, kBox, seen_no_power},
    {"box.self_test", Scope::station, Rank::stands, "NETWORK off, MODULE short flash (FAULT is SELF TEST)",
     "The self-test has failed", kSelfTestSteps, kBox, seen_self_test},
    {"box.type", Scope::station, Rank::stands, "NETWORK off, MODULE flash (FAULT is TYPE MISMATCH)",
     "Incorrect option fitted or selected", kTypeSteps, kBox, seen_type},
    {"box.parameter", Scope::station, Rank::stands, "NETWORK off, MODULE long flash (FAULT is PARAMETER)",
     "Set-up fault: a TEC OPTION parameter is out of range", kParameterSteps, kBox, seen_parameter},
    {"box.no_communications", Scope::station, Rank::checklist,
     "NETWORK off, MODULE on (NETWORK STATE is BAUD SEARCH or DISABLED)",
     "No communications or intermittent failure", kBoxLineSteps, kBox, seen_box_silent},
    {"box.wait_param", Scope::station, Rank::checklist,
     "NETWORK short flash, MODULE on (NETWORK STATE is WAIT PARAM)",
     "Waiting for valid parameterisation data", kWaitPrmSteps, kBox, seen_wait_prm},
    {"box.wait_config", Scope::station, Rank::checklist,
     "NETWORK flash, MODULE on (NETWORK STATE is WAIT CONFIG)", "Waiting for valid configuration data",
     kWaitCfgSteps, kBox, seen_wait_cfg},
    {"box.read_write", Scope::station, Rank::checklist,
     "NETWORK long flash, MODULE on (NETWORK STATE is DATA EX ERROR)", "Read or write failure",
     kReadWriteSteps, kBox, seen_read_write},
    {"box.trip", Scope::station, Rank::stands, "HEALTH off: the drive reports a trip",
     "The drive has tripped", kTripSteps, "HA463561U002, PROFIBUS Diagnostics", seen_trip},
    {"box.works", Scope::station, Rank::note, "NETWORK on, MODULE on (NETWORK STATE is DATA EXCHANGE)",
     "It works", kWorksSteps, kBox, seen_works},
    {"station.tec_notes", Scope::station, Rank::note, "the TEC OPTION function block has something to say",
     "TEC OPTION", kTecNoteSteps, "HA463561U002, MMI parameter descriptions", seen_tec_notes},
});

} // namespace

std::span<const Rule> box_rules()
{
    return kRules;
}

} // namespace dpslave::dpctl
