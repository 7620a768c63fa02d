// SPDX-License-Identifier: Apache-2.0
// The controller: 2408f/2404f handbook ch. 6 (rows C-021).
#include "doctor_rules.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

bool is_controller(const Facts& f)
{
    return f.family == Family::controller;
}
std::string seen_controller_silent(const Facts& f)
{
    if (!is_controller(f) || exchanges(f) || has_just_started(f)) return {};
    const std::string why = refusal(f);
    return why.empty() ? no_exchange(f) : why;
}
std::string seen_intermittent(const Facts& f)
{
    return is_controller(f) && !master_left(f) ? restlessness(f) : std::string{};
}
std::string seen_jammed(const Facts& f)
{
    if (!is_controller(f) || !exchanges(f)) return {};
    std::string written;
    for (const report::Word& word : f.io.words) {
        if (word.direction != "out") continue;
        const std::string name = word.name.value_or("");
        written +=
            fmt::format("{}{}{}", written.empty() ? "" : ", ", word.tag, name.empty() ? "" : " " + name);
    }
    return written.empty() ? std::string{} : "outputs of the master: " + written;
}
std::string seen_format(const Facts& f)
{
    const std::string resolution = f.info.resolution.value_or("");
    return is_controller(f) && exchanges(f) && !resolution.empty() ? "resolution is " + resolution
                                                                   : std::string{};
}

std::string seen_scale_register(const Facts& f)
{
    return f.diagnosis.scale_register.value_or("");
}

constexpr std::array kControllerRules = std::to_array<Rule>({
    {"controller.scale_register", Rank::stands,
     "the drive says that it gives its values in another way than the station",
     "The resolution, or the decimals of the display, are others in the drive than in the station",
     "Set resolution or display_decimals of the station as the drive has them. Then: dpctl reload\n"
     "Or set the drive as the master's project needs it. Then the master can start: it is read again every "
     "10 s.",
     kGateway, seen_scale_register},
    {"controller.no_communications", Rank::checklist, "status rdY, REM dark: no data exchange",
     "No communications",
     "Check the wiring: continuity of A (HE) and B (HD) to the master, the correct terminals.\n"
     "Check that the controller side is set up: function of the slot (PROFIBUS in the controller itself, "
     "Modbus behind this gateway), the right module in slot H.\n"
     "Check that the node address is right for the network, and unique.\n"
     "Ensure that the network is correctly configured and the configuration has been transmitted to the master.\n"
     "Verify that the GSD file is correct: dpctl gsd check FILE --station NAME\n"
     "Verify that the line is not longer than the rate allows (below). Never use more than 1.5 Mbaud.\n"
     "Ensure that the last device of the segment is terminated, and that no device but those at the ends is.\n"
     "If possible, replace the suspect device with a duplicate and test again.",
     kHandbook, seen_controller_silent},
    {"controller.intermittent", Rank::recent,
     "the status flickers between rdY and run, or the diagnosis changes though the controller has no alarm",
     "Intermittent failure to communicate",
     "Verify the wiring, paying particular attention to the screening.\n"
     "The I/O data may be too long: some masters take no more than 32 input and 32 output words per slave.\n"
     "Verify that the line is not longer than the rate allows (below). Never use more than 1.5 Mbaud.\n"
     "Ensure that the last device of the segment is terminated, and that no device but those at the ends "
     "is.\n"
     "Verify the operation with a duplicate device if possible.",
     kHandbook, seen_intermittent},
    {"controller.jammed", Rank::note,
     "setpoint, output power or auto/manual cannot be altered at the front panel",
     "The master writes its outputs continuously",
     "The master's outputs are written continuously and override the front panel: setpoint, output power or auto/manual seem jammed.\n"
     "Write such values with Demand Data, only when they change.\n"
     "Setpoints: use SP2 as the local one, selected with a digital input or key, and SP1 as the one of PROFIBUS.\n"
     "When the network fails the front panel regains control: a local island.",
     kHandbook, seen_jammed},
    {"controller.format", Rank::note, "data format or parameter data seem incorrect",
     "Resolution, or the GSD",
     "If data seem wrong, verify the resolution: full sends 12.34 as 1234, integer as 12.\n"
     "Verify that the GSD file is the one for this application: dpctl gsd show FILE",
     kHandbook, seen_format},
});

} // namespace

std::span<const Rule> controller_rules()
{
    return kControllerRules;
}

} // namespace dpslave::dpctl
