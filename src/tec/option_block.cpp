// SPDX-License-Identifier: Apache-2.0
/// The inputs of the function block: one table says their names, ranges and how they look; what is set, shown
/// and judged goes by it.
#include "dpslave/tec/option_block.hpp"

#include "shown_word.hpp"

#include "dpslave/base/number.hpp"

#include <algorithm>
#include <limits>

namespace dpslave::tec {
namespace {

/// The types are in the order of their numbers. Source: HA463561U002, "MMI Parameter Descriptions" (B-042).
constexpr std::array<std::string_view, 10> kTypes{"NONE",        "RS485",   "PROFIBUS DP", "LINK",
                                                  "DEVICENET",   "CANOPEN", "LONWORKS",    "CONTROLNET",
                                                  "MODBUS PLUS", "ETHERNET"};

enum class Form : std::uint8_t { type, number, word, seconds };

struct Input {
    std::string_view name;
    std::string_view generic_name;
    std::int32_t Settings::*value;
    std::int32_t low; ///< what the operator station lets one set
    std::int32_t high;
    Form form;
    std::string_view range;
};

/// The manual's generic names were in its figures, which are missing in our copy. TYPE has its own name in
/// both views: it chooses between them. FAULT and VERSION mean the same for every TYPE as well [DEC, B-041].
constexpr std::array kInputs = std::to_array<Input>({
    {"TYPE", "TYPE", &Settings::type, 0, 9, Form::type,
     "0 NONE, 1 RS485, 2 PROFIBUS DP, 3 LINK, 4 DEVICENET, 5 CANOPEN, 6 LONWORKS, 7 CONTROLNET, 8 MODBUS PLUS, 9 ETHERNET"},
    {"ADDRESS", "INPUT 1", &Settings::address, 0, 125, Form::number, "0 to 125"},
    {"EXT DIAGNOSTIC", "INPUT 2", &Settings::ext_diagnostic, 0, 0xFFFF, Form::word, "0000 to FFFF"},
    {"INT DIAG SELECT", "INPUT 3", &Settings::int_diag_select, 0, 29999, Form::number, "0 to 29999"},
    {"RIDE THROUGH", "INPUT 4", &Settings::ride_through, -1, 60, Form::seconds, "-1 to 60 s"},
    {"UNUSED 1", "INPUT 5", &Settings::unused_1, 0, 0xFFFF, Form::word, "0000 to FFFF"},
});

struct Output {
    std::string_view name;
    std::string_view generic_name;
    std::string_view range;
};

constexpr Output kFault{"FAULT", "FAULT",
                        "0 NONE, 1 PARAMETER, 2 TYPE MISMATCH, 3 SELF TEST, 4 HARDWARE, 5 MISSING"};
constexpr Output kVersionRow{"VERSION", "VERSION", "0000 to FFFF"};
constexpr Output kNetworkState{
    "NETWORK STATE", "OUTPUT 1",
    "0 DATA EXCHANGE, 1 DATA EX ERROR, 2 WAIT CONFIG, 3 WAIT PARAM, 4 BAUD SEARCH, 5 DISABLED"};
constexpr Output kIntDiagnostic{"INT DIAGNOSTIC", "OUTPUT 2", "0000 to FFFF"};

constexpr bool in_range(const Input& input, std::int32_t value)
{
    return value >= input.low && value <= input.high;
}

/// A value out of range is shown as its number: >FFFF for -1 would hide the fault.
std::string shown(const Input& input, std::int32_t value)
{
    if (input.form == Form::seconds) return std::to_string(value) + " s";
    if (input.form == Form::number || !in_range(input, value)) return std::to_string(value);
    if (input.form == Form::word) return shown_word(static_cast<std::uint16_t>(value));
    return std::string{kTypes[static_cast<std::size_t>(value)]};
}

Row row_of(const Output& output, std::int32_t value, std::string text)
{
    return {.name = output.name,
            .generic_name = output.generic_name,
            .is_input = false,
            .value = value,
            .shown = std::move(text),
            .range = output.range};
}

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

/// Returns whether `typed` is this name as typed in a shell: "ride_through" is RIDE THROUGH.
bool is_name(std::string_view typed, std::string_view name)
{
    constexpr auto upper = [](char c) {
        if (c >= 'a' && c <= 'z') return static_cast<char>(c - 'a' + 'A');
        return c == '_' || c == '-' ? ' ' : c;
    };
    return std::ranges::equal(trimmed(typed), name, [&](char a, char b) { return upper(a) == b; });
}

/// Any number of 16 bits, signed or not.
std::optional<std::int32_t> number_of(std::string_view typed)
{
    typed = trimmed(typed);
    std::string text{typed};
    if (typed.starts_with('>')) text.replace(0, 1, "0x");
    const auto value = read_number(text, std::numeric_limits<std::int16_t>::min(),
                                   std::numeric_limits<std::uint16_t>::max());
    return value ? std::optional{static_cast<std::int32_t>(*value)} : std::nullopt;
}

std::optional<std::int32_t> type_of(std::string_view typed)
{
    for (std::size_t i = 0; i < kTypes.size(); ++i)
        if (is_name(typed, kTypes[i])) return static_cast<std::int32_t>(i);
    return std::nullopt;
}

} // namespace

std::string shown_word(std::uint16_t word)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string out(1, '>');
    for (int shift = 12; shift >= 0; shift -= 4) out += digits[(word >> shift) & 15];
    return out;
}

std::vector<std::string_view> inputs_out_of_range(const Settings& settings)
{
    std::vector<std::string_view> names;
    for (const Input& input : kInputs)
        if (!in_range(input, settings.*input.value)) names.push_back(input.name);
    return names;
}

/// A fault of the gateway goes before a fault of the settings: those can be corrected only by a user who can
/// see that they are not all. A setting that no operator station would take goes before a TYPE that is merely
/// another one.
OptionFault fault(const Settings& settings, const Hardware& hardware)
{
    if (!hardware.bus_works || !hardware.has_power) return OptionFault::hardware;
    if (!hardware.self_test_passed) return OptionFault::self_test;
    if (!inputs_out_of_range(settings).empty()) return OptionFault::parameter;
    return settings.type == kProfibusDp ? OptionFault::none : OptionFault::type_mismatch;
}

std::optional<std::chrono::nanoseconds> zero_after(const Settings& settings)
{
    if (settings.ride_through == -1) return std::nullopt;
    const bool legal = settings.ride_through >= 0 && settings.ride_through <= 60;
    return std::chrono::seconds{legal ? settings.ride_through : 0}; // in doubt the safe side: at once
}

std::array<Row, 10> rows(const Settings& settings, OptionFault fault, NetworkState network,
                         std::uint16_t int_diagnostic)
{
    std::array<Row, 10> all;
    std::size_t next = 0;
    for (const Input& input : kInputs) {
        const std::int32_t value = settings.*input.value;
        all[next++] = {.name = input.name,
                       .generic_name = input.generic_name,
                       .is_input = true,
                       .value = value,
                       .shown = shown(input, value),
                       .range = input.range};
    }
    const std::uint16_t version = fault == OptionFault::missing ? std::uint16_t{0} : kVersion; // B-050
    all[next++] = row_of(kFault, static_cast<std::int32_t>(fault), std::string{text(fault)});
    all[next++] = row_of(kVersionRow, version, shown_word(version));
    all[next++] = row_of(kNetworkState, static_cast<std::int32_t>(network), std::string{text(network)});
    all[next++] = row_of(kIntDiagnostic, int_diagnostic, shown_word(int_diagnostic));
    return all;
}

bool is_called(const Row& row, std::string_view typed)
{
    return is_name(typed, row.name) || is_name(typed, row.generic_name);
}

SetResult set(Settings& settings, std::string_view name, std::string_view value)
{
    for (const Input& input : kInputs) {
        if (!is_name(name, input.name) && !is_name(name, input.generic_name)) continue;
        auto wanted = number_of(value);
        if (!wanted && input.form == Form::type) wanted = type_of(value);
        if (!wanted) return SetResult::no_such_value;
        settings.*input.value = *wanted;
        return SetResult::done;
    }
    for (const Output& output : {kFault, kVersionRow, kNetworkState, kIntDiagnostic})
        if (is_name(name, output.name) || is_name(name, output.generic_name)) return SetResult::is_output;
    return SetResult::no_such_input;
}

} // namespace dpslave::tec
