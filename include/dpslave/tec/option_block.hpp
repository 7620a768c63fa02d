// SPDX-License-Identifier: Apache-2.0
/// The TEC OPTION function block of a technology box: what is set, what it shows, and what INT DIAGNOSTIC
/// reports. It is pure: settings and snapshots go in, numbers and words come out.
/// Source: HA463561U002, "Initial Set-up for Profibus", "Internal Diagnostics"; rows B-040 to B-055,
/// B-080 to B-094.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/option_state.hpp"
#include "dpslave/dp/snapshot.hpp"
#include "dpslave/drive/poller.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::tec {

/// TYPE that stands for PROFIBUS DP.
inline constexpr std::int32_t kProfibusDp = 2;
/// VERSION shown: the option software that is emulated, "Version 3.x" (B-011).
inline constexpr std::uint16_t kVersion = 0x0300;

/// The inputs that can be set, as a PC tool may set them: any value of 16 bits, signed or not
/// (-32768..65535). A value that no operator station would take is not refused; it makes FAULT = PARAMETER
/// (B-049).
struct Settings {
    std::int32_t type = kProfibusDp;
    std::int32_t address = 3;         ///< 0..125
    std::int32_t ext_diagnostic = 0;  ///< 0..FFFF
    std::int32_t int_diag_select = 0; ///< 0..29999
    std::int32_t ride_through = 0;    ///< s; -1 = never to zero, 0 = at once, ..60
    std::int32_t unused_1 = 0;        ///< 0..FFFF
    friend bool operator==(const Settings&, const Settings&) = default;
};

/// The condition of the gateway itself.
struct Hardware {
    bool self_test_passed = true;
    bool bus_works = true;    ///< its port is open, and its driver enable works
    bool has_power = true;    ///< false: its drive is gone, which feeds the box (X-51)
    bool baud_search = false; ///< no valid telegram yet at any rate
};

/// The first of HARDWARE (the bus port is not open, or no power), SELF TEST, PARAMETER (an input out of
/// range, TYPE too) and TYPE MISMATCH that is the case (B-043, B-048, B-049). Never MISSING: the option is
/// there.
OptionFault fault(const Settings& settings, const Hardware& hardware);
/// The inputs that FAULT = PARAMETER is about, in the manual's order: "RIDE THROUGH" ...
std::vector<std::string_view> inputs_out_of_range(const Settings& settings);

/// RIDE THROUGH as the drive side needs it: outputs go to zero after this time, none = never. A value out of
/// range counts as 0.
std::optional<std::chrono::nanoseconds> zero_after(const Settings& settings);

/// DISABLED with any fault; else where the bus is (B-051, B-055). DATA EX ERROR: the drive is lost, or a
/// parameter of this layout is refused, invalid, unscaled, out of range, read only or stale (B-052). WAIT
/// CONFIG also while a parameter without a scale holds the start.
NetworkState network_state(OptionFault fault, const Hardware& hardware, const dp::Snapshot& bus,
                           const drive::DriveSnapshot& drive);

/// INT DIAGNOSTIC for this INT DIAG SELECT: 0 the last refusal, 100..129 tags, 200..229 access modes,
/// 300..329 access errors, 400..429 values read, 500..529 values that the master writes (0 until it may);
/// else, and where the master has configured no such parameter, 0 (B-085 to B-089, B-093, B-094).
std::uint16_t int_diagnostic(std::int32_t select, const dp::Snapshot& bus, const drive::DriveSnapshot& drive);

/// The meaning of the four octets of the extended diagnosis (B-080, B-083, B-084).
enum class TripForm : std::uint8_t {
    code,    ///< trip code of the drive in bits 0..4
    tripped, ///< the reason is not known: 0 = no trip, 31 = tripped
};
/// 04, trip, EXT DIAGNOSTIC high and low. `trip_word`: of the drive. TripForm::code: its low octet alone is
/// the code, whatever the high one is; 32 to 255 are reported as 31. TripForm::tripped: any bit of it is a
/// trip.
std::array<std::uint8_t, 4> ext_diag(TripForm form, std::uint16_t trip_word, std::uint16_t ext_diagnostic);
/// The trip octet in words: "0: NO TRIP", "1: LINK OVERVOLTS", "14: not named in the manual", "31: TRIPPED".
/// Its code is in bits 0 to 4; what else is set is left aside.
std::string trip_words(std::uint8_t octet);
/// Returns the meaning of octet `i` of such a block (0 = header): "trip code 1: LINK OVERVOLTS", "EXT
/// DIAGNOSTIC, low octet: >6AB5"; empty for the header and after the end.
std::string ext_diag_words(Bytes block, std::size_t i);

/// One line of the function block, as the operator station shows it.
struct Row {
    std::string_view name;         ///< in the PROFIBUS view: "RIDE THROUGH"
    std::string_view generic_name; ///< in the view of the PC tool, of another TYPE: "INPUT 4" (B-041)
    bool is_input = false;         ///< can be set
    std::int32_t value = 0;
    std::string shown; ///< "PROFIBUS DP", ">6AB5", "0 s"
    std::string_view range;
};
/// All rows in the manual's order: TYPE, ADDRESS, ... UNUSED 1, FAULT, VERSION, NETWORK STATE, INT
/// DIAGNOSTIC.
std::array<Row, 10> rows(const Settings& settings, OptionFault fault, NetworkState network,
                         std::uint16_t int_diagnostic);

/// `typed` is a name of this row, as it may be typed in a shell: "RIDE THROUGH", "ride_through", "input-4".
bool is_called(const Row& row, std::string_view typed);

enum class SetResult : std::uint8_t { done, no_such_input, is_output, no_such_value };
/// Sets the input that is called `name` to a number in decimal, hexadecimal (>1A, 0x1A) or, for TYPE, by its
/// name. It changes nothing unless the result is `done`.
SetResult set(Settings& settings, std::string_view name, std::string_view value);

} // namespace dpslave::tec
