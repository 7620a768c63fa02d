// SPDX-License-Identifier: Apache-2.0
/// Makes what the function block reports of bus and drive: NETWORK STATE and INT DIAGNOSTIC.
#include "dpslave/tec/option_block.hpp"

#include <algorithm>

namespace dpslave::tec {
namespace {

using dp::Refusal;

constexpr std::size_t kParametersShown = 30;          // of each group of INT DIAG SELECT
constexpr std::uint16_t kLongestUserPrm = 3 + 2 * 30; // octets
constexpr std::uint16_t kLongestCfg = 1 + 30;         // Demand Data and 30 parameters

// Codes of INT DIAG SELECT 0, by the manual's words.
constexpr std::uint16_t kNoError = 0x0000;
constexpr std::uint16_t kPrmTooLong = 0x0012;
constexpr std::uint16_t kPrmBadLength = 0x0013;
constexpr std::uint16_t kPrmZeroTag = 0x0014;
constexpr std::uint16_t kCfgEmpty = 0x0021;
constexpr std::uint16_t kCfgTooLong = 0x0022;
constexpr std::uint16_t kCfgIdentifier = 0x0023;
constexpr std::uint16_t kCfgTooFew = 0x0024;
constexpr std::uint16_t kCfgTooMany = 0x0025;

/// The refusals that the manual has no code for (ident, watchdog, Sync and Freeze, DPV1_Status, a tag too
/// large) are no error of its list: 0000. `dpctl diag` says them in words.
constexpr std::uint16_t code_of(const dp::RefusalDetail& detail)
{
    switch (detail.why) {
        case Refusal::none:
        case Refusal::prm_ident:
        case Refusal::prm_watchdog:
        case Refusal::prm_not_supported:
        case Refusal::prm_dpv1:
        case Refusal::prm_tag_too_large: return kNoError;
        case Refusal::prm_length: return detail.got > kLongestUserPrm ? kPrmTooLong : kPrmBadLength;
        case Refusal::prm_zero_tag: return kPrmZeroTag;
        case Refusal::cfg_empty: return kCfgEmpty;
        // 31 parameters without Demand Data are no longer than the longest, only one too many.
        case Refusal::cfg_too_long: return detail.got > kLongestCfg ? kCfgTooLong : kCfgTooMany;
        case Refusal::cfg_identifier: return kCfgIdentifier;
        case Refusal::cfg_too_few: return kCfgTooFew;
        case Refusal::cfg_too_many: return kCfgTooMany;
        // It has as many valid identifiers as are accepted, in other directions.
        case Refusal::cfg_changed: return kCfgIdentifier;
    }
    return kNoError;
}

/// Returns the access error of 300..329. There is no code for a drive that is silent or does not understand:
/// those are no fault of the parameter.
constexpr std::uint16_t code_of(AccessError error)
{
    switch (error) {
        case AccessError::none:
        case AccessError::no_answer:
        case AccessError::deferred:
        case AccessError::not_understood:
        case AccessError::not_known:
        case AccessError::not_kept: return 0;
        case AccessError::out_of_range:
        case AccessError::does_not_fit: return 1;
        case AccessError::read_only: return 2;
        case AccessError::not_stopped: return 3;
        case AccessError::not_config_mode: return 4;
        case AccessError::unsupported_type:
        case AccessError::value_not_encoded:
        case AccessError::no_scale:
        case AccessError::contradicted: return 5;
        case AccessError::invalid_tag: return 6;
    }
    return 0;
}

/// An error that the next repetition corrects is no failure: the lamp would flicker with each lost answer.
bool fails(const drive::DriveSnapshot& drive, std::size_t parameter)
{
    const WordState state = drive.states[parameter];
    return state != WordState::untried && state != WordState::good && !drive.repeated[parameter];
}

bool parameter_fails(const dp::Snapshot& bus, const drive::DriveSnapshot& drive)
{
    if (drive.known && !drive.answers) return true;
    if (drive.generation != bus.layout.generation) return false; // the drive side still has the layout before
    for (std::size_t i = 0; i < bus.layout.count; ++i)
        if (fails(drive, i)) return true;
    return false;
}

} // namespace

NetworkState network_state(OptionFault fault, const Hardware& hardware, const dp::Snapshot& bus,
                           const drive::DriveSnapshot& drive)
{
    if (fault != OptionFault::none) return NetworkState::disabled;
    if (hardware.baud_search) return NetworkState::baud_search;
    switch (bus.state) {
        case dp::State::power_on: break; // about to start: nothing valid was heard yet
        case dp::State::wait_prm: return NetworkState::wait_param;
        case dp::State::wait_cfg: return NetworkState::wait_config;
        case dp::State::data_exch:
            if (bus.hold != StartHold::none)
                return NetworkState::wait_config; // the exchange has not begun
            return parameter_fails(bus, drive) ? NetworkState::data_ex_error : NetworkState::data_exchange;
    }
    return NetworkState::baud_search;
}

std::uint16_t int_diagnostic(std::int32_t select, const dp::Snapshot& bus, const drive::DriveSnapshot& drive)
{
    if (select == 0) return code_of(bus.refusal); // dp forgets it once both telegrams are accepted (B-094)
    const std::int32_t group = select / 100;
    const std::size_t i = static_cast<std::size_t>(select < 0 ? 0 : select % 100);
    if (select < 0 || i >= kParametersShown || i >= bus.layout.count) return 0;

    const LayoutEntry& parameter = bus.layout.parameters[i];
    const bool drive_has_layout = drive.generation == bus.layout.generation;
    switch (group) {
        case 1: return parameter.tag;
        case 2: return static_cast<std::uint16_t>((parameter.reads ? 1u : 0u) | (parameter.writes ? 2u : 0u));
        case 3: return drive_has_layout ? code_of(drive.errors[i]) : std::uint16_t{0};
        case 4: return drive_has_layout && parameter.reads ? drive.words[i] : std::uint16_t{0};
        case 5: return bus.may_write && parameter.writes ? bus.outputs[i] : std::uint16_t{0};
        default: return 0;
    }
}

} // namespace dpslave::tec
