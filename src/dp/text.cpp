// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/bus_members.hpp"
#include "dpslave/dp/refusal.hpp"
#include "dpslave/dp/state.hpp"

namespace dpslave::dp {

std::string_view text(State state) noexcept
{
    switch (state) {
        case State::power_on: return "Power_On";
        case State::wait_prm: return "Wait_Prm";
        case State::wait_cfg: return "Wait_Cfg";
        case State::data_exch: return "Data_Exch";
    }
    return "?";
}

std::string_view text(Member::State state) noexcept
{
    switch (state) {
        case Member::State::unknown: return "unknown";
        case Member::State::prm_required: return "Prm_Req";
        case Member::State::prm_fault: return "Prm_Fault";
        case Member::State::cfg_fault: return "Cfg_Fault";
        case Member::State::not_ready: return "Station_Not_Ready";
        case Member::State::ready: return "ready";
        case Member::State::exchange: return "Data_Exch";
    }
    return "?";
}

std::string_view text(LeaveReason reason) noexcept
{
    switch (reason) {
        case LeaveReason::none: return "";
        case LeaveReason::prm_fault: return "Set_Prm was refused";
        case LeaveReason::not_supported: return "Set_Prm asked for a function that the device does not have";
        case LeaveReason::cfg_fault: return "Chk_Cfg was refused";
        case LeaveReason::watchdog: return "the watchdog expired: the master is silent";
        case LeaveReason::unlock: return "the master released the slave";
        case LeaveReason::output_length: return "Data_Exchange of a wrong length";
        case LeaveReason::new_parameters: return "the master chose other parameters";
        case LeaveReason::stop: return "the slave was stopped";
    }
    return "?";
}

std::string_view text(Refusal why) noexcept
{
    switch (why) {
        case Refusal::none: return "";
        case Refusal::prm_ident: return "the Ident_Number is that of another device";
        case Refusal::prm_watchdog: return "the watchdog is on with a factor 0";
        case Refusal::prm_not_supported: return "Sync or Freeze is requested, which the device does not have";
        case Refusal::prm_length: return "User_Prm_Data has a wrong length";
        case Refusal::prm_dpv1: return "DPV1_Status asks for functions that the device does not have";
        case Refusal::prm_tag_too_large: return "a tag in User_Prm_Data is too large";
        case Refusal::prm_zero_tag: return "a zero replaces a tag in User_Prm_Data";
        case Refusal::cfg_empty: return "Cfg_Data is empty";
        case Refusal::cfg_too_long: return "Cfg_Data has too many identifiers";
        case Refusal::cfg_identifier: return "an identifier is not legal here";
        case Refusal::cfg_too_few: return "Cfg_Data has fewer identifiers than User_Prm_Data has tags";
        case Refusal::cfg_too_many: return "Cfg_Data has more identifiers than User_Prm_Data has tags";
        case Refusal::cfg_changed: return "Cfg_Data is another than the accepted one while data is exchanged";
    }
    return "?";
}

Service service_of(Refusal why) noexcept
{
    switch (why) {
        case Refusal::none: break;
        case Refusal::prm_ident:
        case Refusal::prm_watchdog:
        case Refusal::prm_not_supported:
        case Refusal::prm_length:
        case Refusal::prm_dpv1:
        case Refusal::prm_tag_too_large:
        case Refusal::prm_zero_tag: return Service::set_prm;
        case Refusal::cfg_empty:
        case Refusal::cfg_too_long:
        case Refusal::cfg_identifier:
        case Refusal::cfg_too_few:
        case Refusal::cfg_too_many:
        case Refusal::cfg_changed: return Service::chk_cfg;
    }
    return Service::none;
}

} // namespace dpslave::dp
