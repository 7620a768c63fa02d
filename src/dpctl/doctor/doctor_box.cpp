// SPDX-License-Identifier: Apache-2.0
// The technology box: HA463561U002, "Troubleshooting" (rows B-090). Its pictures of the lamps are lost:
// the pairs are those of B-030 and B-031.
#include "doctor_rules.hpp"
#include "dpctl/cli/words.hpp"

#include "dpslave/base/option_state.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

/// The row of the function block; null without the block.
const report::TecRow* row(const Facts& f, std::string_view name)
{
    for (const report::TecRow& one : f.tec.rows)
        if (one.name == name) return &one;
    return nullptr;
}

bool is_row(const Facts& f, std::string_view name, auto value)
{
    const report::TecRow* one = row(f, name);
    return one != nullptr && one->value == static_cast<std::int64_t>(value);
}

bool fault_is(const Facts& f, OptionFault fault)
{
    return is_row(f, "FAULT", fault);
}

/// FAULT is NONE, and NETWORK STATE this.
bool network_is(const Facts& f, NetworkState state)
{
    return fault_is(f, OptionFault::none) && is_row(f, "NETWORK STATE", state);
}

std::string fault_words(const Facts& f)
{
    return "FAULT is " + row(f, "FAULT")->shown;
}

std::string with_refusal(const Facts& f, std::string_view network_state)
{
    const std::string why = refusal(f);
    return fmt::format("NETWORK STATE is {}{}", network_state, why.empty() ? "" : "; " + why);
}

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
    return f.tec.tripped.value_or(false) ? "trip " + f.tec.trip.value_or("?") : std::string{};
}
std::string seen_tec_notes(const Facts& f)
{
    return joined(f.tec.notes, " ");
}

constexpr std::array kBoxRules = std::to_array<Rule>({
    {"box.no_power", Rank::checklist, "NETWORK off, MODULE off (FAULT is HARDWARE or MISSING)",
     "No power, not installed correctly, or hardware fault",
     "No power at the drive: check and apply power to the drive.\n"
     "Not installed correctly: check the connections between gateway and drive (605A & B: the ribbon "
     "cable).\n"
     "Hardware fault: look which port cannot be opened: journalctl -u dpslaved\n"
     "With the box itself: if HEALTH and RUN are off, replace the drive, else the box. BEWARE OF ELECTRIC SHOCK under the terminal cover.",
     kBox, seen_no_power},
    {"box.self_test", Rank::stands, "NETWORK off, MODULE short flash (FAULT is SELF TEST)",
     "The self-test has failed",
     "Of the gateway: look what failed: journalctl -u dpslaved\n"
     "With the box itself: replace the box.",
     kBox, seen_self_test},
    {"box.type", Rank::stands, "NETWORK off, MODULE flash (FAULT is TYPE MISMATCH)",
     "Incorrect option fitted or selected",
     "Select the matching value for TYPE in the TEC OPTION function block: dpctl tec set TYPE \"PROFIBUS DP\"\n"
     "With the box itself: fit the right one.",
     kBox, seen_type},
    {"box.parameter", Rank::stands, "NETWORK off, MODULE long flash (FAULT is PARAMETER)",
     "Set-up fault: a TEC OPTION parameter is out of range",
     "Select a legal value for the parameter in the TEC OPTION function block: dpctl show has values and ranges.",
     kBox, seen_parameter},
    {"box.no_communications", Rank::checklist,
     "NETWORK off, MODULE on (NETWORK STATE is BAUD SEARCH or DISABLED)",
     "No communications or intermittent failure",
     "Check wiring: continuity of A and B to the master, the correct terminals, the integrity of the screening.\n"
     "Ensure that the maximum line length for the baud rate is not exceeded (below).\n"
     "Ensure that the last unit on the line is terminated correctly. Some equipment has built-in resistors that may be switched in and out of circuit.",
     kBox, seen_box_silent},
    {"box.wait_param", Rank::checklist, "NETWORK short flash, MODULE on (NETWORK STATE is WAIT PARAM)",
     "Waiting for valid parameterisation data",
     "Check the slave ADDRESS. Check that it is unique.\n"
     "Ensure that the network has been correctly configured and that the configuration has been downloaded "
     "to the master.\n"
     "Verify that the GSD file is correct: dpctl gsd check FILE --station NAME\n"
     "Read INT DIAGNOSTIC with INT DIAG SELECT 0. It is the code of the last refused telegram. In words: dpctl diag",
     kBox, seen_wait_prm},
    {"box.wait_config", Rank::checklist, "NETWORK flash, MODULE on (NETWORK STATE is WAIT CONFIG)",
     "Waiting for valid configuration data",
     "Refer to the internal diagnostics: INT DIAGNOSTIC with INT DIAG SELECT 0. In words: dpctl diag\n"
     "Compare the modules in the master's project with the tags of User_Prm_Data: as many, in the same "
     "order.",
     kBox, seen_wait_cfg},
    {"box.read_write", Rank::checklist, "NETWORK long flash, MODULE on (NETWORK STATE is DATA EX ERROR)",
     "Read or write failure",
     "Refer to the internal diagnostics. INT DIAG SELECT 300 to 329 shows the access error of parameter 0 to 29.\n"
     "See which tag it is: dpctl io, dpctl diag",
     kBox, seen_read_write},
    {"box.trip", Rank::stands, "HEALTH off: the drive reports a trip", "The drive has tripped",
     "Remove the cause at the drive and reset the trip there. The master reads it in the diagnosis of the slave.",
     "HA463561U002, PROFIBUS Diagnostics", seen_trip},
    {"box.works", Rank::note, "NETWORK on, MODULE on (NETWORK STATE is DATA EXCHANGE)", "It works",
     "The unit should now be working. If there is still a problem, check your tag numbers: dpctl io, dpctl tag.",
     kBox, seen_works},
    {"station.tec_notes", Rank::note, "the TEC OPTION function block has notes", "TEC OPTION",
     "Look at the function block: dpctl show", "HA463561U002, MMI parameter descriptions", seen_tec_notes},
});

} // namespace

std::span<const Rule> box_rules()
{
    return kBoxRules;
}

} // namespace dpslave::dpctl
