// SPDX-License-Identifier: Apache-2.0
// The diagnosis of a station, octet by octet.
#include "report.hpp"

#include "dpslave/dp/diagnosis_bits.hpp"
#include "dpslave/report/words.hpp"

#include <fmt/format.h>

namespace dpslave::app {

namespace {

constexpr std::size_t kHeader = 6; ///< offset of the first block

/// What the octet at `offset` (from 0, 6 at least) of a Slave_Diag reply says.
std::string extended_meaning(const config::StationConfig& station, std::size_t offset, Bytes diagnosis)
{
    using profile::DiagForm;
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
    if (refused.why != dp::Refusal::none) result.refusal = report::explain(refused);
    result.last_prm = hex(station.bus.prm.bytes());
    result.last_cfg = hex(station.bus.cfg.bytes());
    result.held = station.bus.hold != StartHold::none;
    result.scale_register = scale_register_words(station);
    result.unscaled = unscaled_report(station);
    result.denied = denied_report(station);
    if (station.drive.known && !station.drive.answers)
        result.trouble.emplace_back("the drive does not answer: its inputs are held and marked stale");
    for (const auto& words : {denied_words(station), scale_words(station)})
        if (words) result.trouble.push_back(*words);
    if (station.config->tec && station.config->tec->trip.bit.tag == 0)
        result.trouble.emplace_back(
            "trips are not known: no tag reports them, so \"no trip\" above means nothing; set trip_tag in [station.tec]");
    for (const Trouble& one : station.troubles) {
        result.trouble.emplace_back(one.text.data());
        result.refused.push_back(
            {one.tag, one.is_write, std::string{report::code(one.error)}, one.text.data()});
    }
    return result;
}

} // namespace dpslave::app
