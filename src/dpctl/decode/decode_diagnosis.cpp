// SPDX-License-Identifier: Apache-2.0
// Slave_Diag: the six standard octets and the blocks behind them (wire reference 5).
#include "decode.hpp"

#include "dpslave/dp/diagnosis_bits.hpp"
#include "dpslave/dp/slave_diag.hpp"
#include "dpslave/tec/option_block.hpp"

#include <fmt/format.h>

#include <array>

namespace dpslave::dpctl {
namespace {

using profile::DiagForm;

constexpr std::size_t kMaxDiagnosis = 244;

std::string bits_of(Bytes data, std::size_t offset)
{
    std::string result;
    for (const dp::DiagnosisBit& bit : dp::kDiagnosisBits)
        if (bit.offset == offset && (data[offset] & bit.mask) != 0)
            result += fmt::format("{}{}", result.empty() ? "" : ", ", bit.name);
    return result.empty() ? "no bit set" : result;
}

void standard_part(Bytes data, Decoded& into)
{
    std::string meanings;
    for (const dp::DiagnosisBit& bit : dp::kDiagnosisBits)
        if ((data[bit.offset] & bit.mask) != 0)
            meanings += fmt::format("{}{}: {}", meanings.empty() ? "" : "\n", bit.name, bit.meaning);
    into.lines.push_back({"says", meanings.empty() ? "no bit set" : meanings});
    into.octets.push_back({1, data[0], "Station_status_1: " + bits_of(data, 0)});
    into.octets.push_back({2, data[1], "Station_status_2: " + bits_of(data, 1)});
    into.octets.push_back({3, data[2], "Station_status_3: " + bits_of(data, 2)});
    into.octets.push_back({4, data[3],
                           data[3] == dp::kNoMaster
                               ? std::string{"Master_Add: none, not parameterised"}
                               : fmt::format("Master_Add: owned by master {}", data[3])});
    into.octets.push_back({5, data[4], "Ident_Number, high octet"});
    into.octets.push_back({6, data[5], fmt::format("Ident_Number, low octet: 0x{:04X}", be16(data, 4))});
    const bool of_the_master = (data[0] & 0x01) != 0; // no octet came from a slave
    if ((data[1] & 0x04) == 0 && !of_the_master)
        into.faults.push_back("bit 2 of octet 2 is 0: a slave always sends 1");
    if ((data[1] & 0x40) != 0 || (data[2] & 0x7F) != 0)
        into.faults.push_back("a reserved bit of octet 2 or 3 is set");
    if (data[3] > 126 && data[3] != dp::kNoMaster)
        into.faults.push_back(fmt::format("Master_Add is {}: 0 to 126, or 255 for none", data[3]));
}

/// Octet `i` behind the header of the device's own block.
std::string device_octet(Bytes block, std::size_t i, const profile::Profile& device)
{
    const bool trips = device.diagnosis == DiagForm::trip_code || device.diagnosis == DiagForm::tripped;
    if (trips && block.size() == 4) return tec::ext_diag_words(block, i);
    if (device.diagnosis == DiagForm::status_word && block.size() == 3) {
        if (i == 1) return "status word, high octet";
        const drive::Tag* row = device.tags.find(device.status_tag);
        const std::uint16_t status = be16(block, 1);
        return "status word, low octet: " +
               (row != nullptr ? drive::displayed(*row, status) : fmt::format(">{:04X}", status));
    }
    return fmt::format("device-related, octet {}", i);
}

/// The same of a device that is known by its GSD, or not at all.
std::string foreign_octet(Bytes block, std::size_t i, const DiagnosisTexts* texts)
{
    const std::string said = texts != nullptr ? texts_of_octet(*texts, block, i) : std::string{};
    return fmt::format("device-related, octet {}{}", i, said.empty() ? "" : ": " + said);
}

/// Identifiers whose bit is set in a block of identifier-related diagnosis.
std::string identifiers_in(std::uint8_t octet, std::size_t first)
{
    std::string result;
    for (std::size_t k = 0; k < 8; ++k)
        if (((octet >> k) & 1) != 0) result += fmt::format("{}{}", result.empty() ? "" : ", ", first + k);
    return result.empty() ? "none" : result;
}

constexpr std::array<std::string_view, 4> kDirections = {"", " input", " output", " input and output"};
constexpr std::array<std::string_view, 8> kChannelTypes = {
    "reserved type", "bit", "2 bit", "4 bit", "octet", "word", "2 words", "reserved type"};
constexpr std::array<std::string_view, 10> kChannelErrors = {
    "reserved",        "short circuit", "undervoltage",         "overvoltage",          "overload",
    "overtemperature", "line break",    "upper limit exceeded", "lower limit exceeded", "error"};

std::string channel_error(std::uint8_t octet)
{
    const std::size_t error = octet & 0x1FU;
    if (error < 10) return std::string{kChannelErrors[error]};
    return error < 16 ? std::string{"reserved"} : fmt::format("error {} of the vendor", error);
}

void add_block(Bytes block, std::size_t at, const DecodeContext& context, Decoded& into)
{
    const auto add = [&](std::size_t i, std::string meaning) {
        into.octets.push_back({at + i + 1, block[i], std::move(meaning)});
    };
    const unsigned number = block[0] & 0x3FU;
    switch (block[0] >> 6) {
        case 0:
            add(0, fmt::format("device-related block of {} octets", number));
            for (std::size_t i = 1; i < block.size(); ++i)
                add(i, context.device != nullptr ? device_octet(block, i, *context.device)
                                                 : foreign_octet(block, i, context.texts));
            break;
        case 1:
            add(0, fmt::format("identifier-related block of {} octets", number));
            for (std::size_t i = 1; i < block.size(); ++i)
                add(i, "identifiers with diagnosis: " + identifiers_in(block[i], 8 * (i - 1)));
            break;
        case 2:
            add(0, fmt::format("channel-related block: identifier {}", number));
            add(1, fmt::format("channel {}{}", block[1] & 0x3FU, kDirections[block[1] >> 6]));
            add(2, fmt::format("{}, {}", kChannelTypes[block[2] >> 5], channel_error(block[2])));
            break;
        default: add(0, fmt::format("revision {} of the device", number)); break;
    }
}

void check_device(Bytes data, const profile::Profile& device, Decoded& into)
{
    if (device.ident && *device.ident != be16(data, 4))
        into.faults.push_back(fmt::format("the Ident_Number of profile {} is 0x{:04X}, here is 0x{:04X}",
                                          device.name, *device.ident, be16(data, 4)));
    if (data.size() > device.personality.max_diag_length)
        into.faults.push_back(fmt::format("it has {} octets, profile {} has {} at most", data.size(),
                                          device.name, device.personality.max_diag_length));
}

} // namespace

bool are_blocks(Bytes octets)
{
    while (!octets.empty()) {
        const std::size_t length = dp::block_length(octets);
        if (length == 0) return false;
        octets = octets.subspan(length);
    }
    return true;
}

void decode_extended(Bytes blocks, std::size_t at, const DecodeContext& context, Decoded& into)
{
    while (!blocks.empty()) {
        const std::size_t length = dp::block_length(blocks);
        if (length == 0) {
            const bool too_short = (blocks[0] >> 6) < 2 && (blocks[0] & 0x3FU) < 2;
            into.octets.push_back({at + 1, blocks[0], "header of a block"});
            into.faults.push_back(
                too_short ? fmt::format("octet {}: a block of {} octets cannot be", at + 1, blocks[0] & 0x3FU)
                          : fmt::format("octet {}: the header promises {} octets, {} are left", at + 1,
                                        (blocks[0] >> 6) == 2 ? 3 : blocks[0] & 0x3FU, blocks.size()));
            return;
        }
        add_block(blocks.first(length), at, context, into);
        at += length;
        blocks = blocks.subspan(length);
    }
}

void decode_diagnosis(Bytes data, const DecodeContext& context, Decoded& into)
{
    if (data.size() < dp::kStandardDiagnosis) {
        into.faults.push_back(fmt::format("a diagnosis has at least 6 octets, here are {}", data.size()));
        return;
    }
    if (data.size() > kMaxDiagnosis) into.faults.push_back("a diagnosis has at most 244 octets");
    standard_part(data, into);
    if (context.texts != nullptr && !context.texts->model.empty())
        into.lines.push_back({"device", context.texts->model + " (by its GSD)"});
    const Bytes extended = data.subspan(dp::kStandardDiagnosis);
    if (!extended.empty()) {
        into.lines.push_back({"extended part", (data[0] & 0x08) != 0 ? "reports a fault (Ext_Diag is 1)"
                                                                     : "a status message (Ext_Diag is 0)"});
        decode_extended(extended, dp::kStandardDiagnosis, context, into);
    } else if ((data[0] & 0x08) != 0) {
        into.faults.push_back("Ext_Diag is 1, but there is no extended part");
    }
    if (context.device != nullptr) check_device(data, *context.device, into);
}

} // namespace dpslave::dpctl
