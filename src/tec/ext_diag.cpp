// SPDX-License-Identifier: Apache-2.0
/// The block of the extended diagnosis: its octets, and what they say.
#include "shown_word.hpp"

#include "dpslave/tec/option_block.hpp"

#include <algorithm>

namespace dpslave::tec {
namespace {

constexpr std::uint8_t kTripped = 31; // also the highest code of five bits
constexpr std::uint8_t kCode = 0x1F;  // bits of the trip octet that are the code
constexpr std::size_t kBlock = 4;

/// Empty where the manual names none. Source: HA463561U002, "PROFIBUS Diagnostics" (B-083, B-084).
constexpr std::string_view trip_name(std::uint8_t code)
{
    switch (code) {
        case 0: return "NO TRIP";
        case 1: return "LINK OVERVOLTS";
        case 2: return "LINK UNDERVOLTS";
        case 3: return "LINK OVERCURRENT";
        case 4: return "HEATSINK TEMPERATURE";
        case 5: return "EXTERNAL TRIP";
        case 6: return "INPUT 1 BREAK";
        case 7: return "INPUT 2 BREAK";
        case 8: return "MOTOR STALLED";
        case 9: return "I*T";
        case 10: return "BRAKE RESISTOR";
        case 11: return "BRAKE SWITCH";
        case 12: return "OPERATOR STATION";
        case 13: return "LOST COMMUNICATIONS";
        case 17: return "MOTOR TEMPERATURE";
        case 18: return "CURRENT LIMIT";
        case 20: return "24V FAILURE";
        case 21: return "LOW SPEED CURRENT";
        case kTripped: return "TRIPPED";
        default: return "";
    }
}

} // namespace

std::array<std::uint8_t, 4> ext_diag(TripForm form, std::uint16_t trip_word, std::uint16_t ext_diagnostic)
{
    // The low octet alone counts. A code in it that five bits do not hold is a trip of unknown reason
    // on every box: cut off to five bits it could say "no trip".
    std::uint8_t trip = std::min(low(trip_word), kTripped);
    if (form == TripForm::tripped) trip = trip_word == 0 ? std::uint8_t{0} : kTripped;
    return {0x04, trip, high(ext_diagnostic), low(ext_diagnostic)};
}

std::string trip_words(std::uint8_t octet)
{
    const auto code = static_cast<std::uint8_t>(octet & kCode);
    const std::string_view name = trip_name(code);
    return std::to_string(code) + ": " + std::string{name.empty() ? "not named in the manual" : name};
}

std::string ext_diag_words(Bytes block, std::size_t i)
{
    if (i >= std::min(block.size(), kBlock)) return "";
    switch (i) {
        case 1: return "trip code " + trip_words(block[1]);
        case 2: return "EXT DIAGNOSTIC, high octet";
        case 3: return "EXT DIAGNOSTIC, low octet: " + shown_word(be16(block, 2));
        default: return "";
    }
}

} // namespace dpslave::tec
