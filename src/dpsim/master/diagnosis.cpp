// SPDX-License-Identifier: Apache-2.0
#include "diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dpslave::sim {
namespace {

struct Finding {
    std::string_view name;
    DiagnosisBit bit;
    std::string_view words;
};

constexpr std::array kFindings{
    Finding{"not-ready", kNotReady, "Station_Not_Ready: not yet ready for data exchange"},
    Finding{"cfg-fault", kCfgFault, "Cfg_Fault: the last Chk_Cfg does not fit"},
    Finding{"ext-diag", {1, 0x08}, "Ext_Diag: the extended part reports a fault"},
    Finding{"not-supported", kNotSupported, "Not_Supported: Sync or Freeze was asked for and is not there"},
    Finding{"prm-fault", kPrmFault, "Prm_Fault: the last Set_Prm was refused (ident or parameters)"},
    Finding{"prm-required", kPrmRequired, "Prm_Req: the slave waits for parameters"},
    Finding{"stat-diag", kStatDiag, "Stat_Diag: no valid data yet, diagnosis is to be read again"},
    Finding{"watchdog", {2, 0x08}, "WD_On: the watchdog is on"},
    Finding{"freeze", {2, 0x10}, "Freeze_Mode: the inputs are frozen"},
    Finding{"sync", {2, 0x20}, "Sync_Mode: the outputs are held"},
    Finding{"overflow", {3, 0x80}, "Ext_Diag_Overflow: there is more diagnosis than fits"},
};

/// Trip codes of the drives with a technology box (HA463561U002); 31 = a 590+ has tripped.
constexpr std::array kTrips =
    std::to_array<std::pair<unsigned, std::string_view>>({{0, "no trip"},
                                                          {1, "link overvolts"},
                                                          {2, "link undervolts"},
                                                          {3, "link overcurrent"},
                                                          {4, "heatsink temperature"},
                                                          {5, "external trip"},
                                                          {6, "input 1 break"},
                                                          {7, "input 2 break"},
                                                          {8, "motor stalled"},
                                                          {9, "I*t"},
                                                          {10, "brake resistor"},
                                                          {11, "brake switch"},
                                                          {12, "operator station"},
                                                          {13, "lost communications"},
                                                          {17, "motor temperature"},
                                                          {18, "current limit"},
                                                          {20, "24 V failure"},
                                                          {21, "low speed current"},
                                                          {31, "tripped"}});

/// Bits of the summary output status word of a 2408f/2404f, from bit 0 (handbook chapter 4).
constexpr std::array<std::string_view, 16> kStatusBits{"alarm 1",         "alarm 2",
                                                       "alarm 3",         "alarm 4",
                                                       "manual mode",     "sensor break",
                                                       "loop break",      "heater fail",
                                                       "tune active",     "program complete",
                                                       "PV out of range", "DC module fault",
                                                       "segment sync",    "remote input break",
                                                       "IP1 fault",       "bit 15"};

std::string trip_words(Bytes data)
{
    const auto* const known =
        std::find_if(kTrips.begin(), kTrips.end(), [&](const auto& trip) { return trip.first == data[0]; });
    return fmt::format("  of a technology box: trip code {} ({}), EXT DIAGNOSTIC {:04X}", data[0],
                       known == kTrips.end() ? "in no table" : known->second, be16(data, 1));
}

std::string status_words(Bytes data)
{
    const std::uint16_t word = be16(data, 0);
    std::string names;
    for (unsigned bit = 0; bit < kStatusBits.size(); ++bit)
        if ((word >> bit & 1) != 0) names += (names.empty() ? "" : ", ") + std::string{kStatusBits[bit]};
    return fmt::format("  of a 2408f/2404f: summary output status {:04X}, {}", word,
                       names.empty() ? "no bit" : names);
}

std::string identifier_block(Bytes block)
{
    std::string list;
    for (std::size_t i = 1; i < block.size(); ++i)
        for (unsigned bit = 0; bit < 8; ++bit)
            if ((block[i] >> bit & 1) != 0) list += fmt::format(" {}", (i - 1) * 8 + bit);
    return "identifiers with diagnosis:" + (list.empty() ? std::string{" none"} : list);
}

std::string channel_block(Bytes block)
{
    return fmt::format("identifier {}, channel {}: error {}", block[0] & 0x3F, block[1] & 0x3F,
                       block[2] & 0x1F);
}

/// Blocks of the extended part; stops with a sentence where the lengths do not add up.
void explain_extended(Bytes rest, std::vector<std::string>& lines)
{
    while (!rest.empty()) {
        const unsigned form = rest[0] >> 6;
        const std::size_t length = form == 2 ? 3 : form == 3 ? 1 : rest[0] & 0x3FU;
        if (length == 0 || length > rest.size()) {
            lines.push_back(fmt::format("extended diagnosis: a block of {} octets, but {} are left: {}",
                                        length, rest.size(), hex(rest)));
            return;
        }
        const Bytes block = rest.first(length);
        if (form == 0) lines.push_back("device-related diagnosis: " + hex(block.subspan(1)));
        if (form == 0 && length == 4) lines.push_back(trip_words(block.subspan(1)));
        if (form == 0 && length == 3) lines.push_back(status_words(block.subspan(1)));
        if (form == 1) lines.push_back(identifier_block(block));
        if (form == 2) lines.push_back(channel_block(block));
        if (form == 3) lines.push_back(fmt::format("revision {}", block[0] & 0x3F));
        rest = rest.subspan(length);
    }
}

} // namespace

Result<Diagnosis, std::string> parse_diagnosis(Bytes data)
{
    if (data.size() < 6)
        return Failure{fmt::format("Slave_Diag has {} octets, at least 6 are needed", data.size())};
    if ((data[1] & 0x04) == 0)
        return Failure{std::string{"octet 2 bit 2 of Slave_Diag is 0; it is always 1"}};
    if ((data[0] & 0xA1) != 0 || (data[1] & 0xC0) != 0 || (data[2] & 0x7F) != 0)
        return Failure{"Slave_Diag sets bits that belong to the master or are reserved: " + hex(data)};
    return Diagnosis{Octets(data.begin(), data.end()), data[3], be16(data, 4)};
}

std::vector<std::string> explain(const Diagnosis& diagnosis)
{
    std::vector<std::string> lines;
    lines.push_back("octets " + hex(diagnosis.octets));
    lines.push_back(fmt::format("ident 0x{:04X}, {}", diagnosis.ident,
                                diagnosis.master == 0xFF
                                    ? std::string{"owned by no master"}
                                    : fmt::format("owned by master {}", diagnosis.master)));
    for (const Finding& f : kFindings)
        if (diagnosis.has(f.bit)) lines.emplace_back(f.words);
    explain_extended(Bytes{diagnosis.octets}.subspan(6), lines);
    return lines;
}

std::optional<bool> finding(const Diagnosis& diagnosis, std::string_view name)
{
    const auto* const found =
        std::find_if(kFindings.begin(), kFindings.end(), [&](const Finding& f) { return f.name == name; });
    if (found == kFindings.end()) return std::nullopt;
    return diagnosis.has(found->bit);
}

} // namespace dpslave::sim
