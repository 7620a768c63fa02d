// SPDX-License-Identifier: Apache-2.0
// The TEC OPTION function block, and what an extended diagnosis says.
#include "device_state.hpp"
#include "report.hpp"

#include <fmt/format.h>

namespace dpslave::app {

using profile::DiagForm;

report::Tec tec_report(const std::string& station, const DeviceState& device)
{
    report::Tec result;
    result.name = station;
    result.view = device.settings().type == tec::kProfibusDp ? "profibus" : "generic";
    for (const tec::Row& row : device.rows())
        result.rows.push_back({std::string{row.name}, std::string{row.generic_name}, row.is_input,
                               integer(row.value), row.shown, std::string{row.range}});
    result.trip = device.trip();
    result.trip_tag = device.trip_tag();
    result.tripped = device.tripped();
    result.notes = device.notes();
    return result;
}

namespace {

constexpr std::size_t kHeader = 6; ///< offset of the first block

} // namespace

std::string extended_meaning(const config::StationConfig& station, std::size_t offset, Bytes diagnosis)
{
    const DiagForm form = station.profile->diagnosis;
    if (form == DiagForm::none || offset < kHeader) return "extended diagnosis";
    if (offset == kHeader)
        return fmt::format("header: device-related diagnosis, {} octets with this one", diagnosis[offset]);
    if (form == DiagForm::status_word) {
        if (offset == kHeader + 1) return "status word, high octet";
        if (offset == kHeader + 2)
            return "status word, low octet: " +
                   shown_value(*station.tags, station.status_tag, be16(diagnosis, kHeader + 1));
        return "extended diagnosis";
    }
    std::string words = tec::ext_diag_words(diagnosis.subspan(kHeader), offset - kHeader);
    return words.empty() ? "extended diagnosis" : words;
}

} // namespace dpslave::app
