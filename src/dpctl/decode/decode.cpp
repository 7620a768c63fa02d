// SPDX-License-Identifier: Apache-2.0
#include "decode.hpp"

#include "dpctl/cli/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace dpslave::dpctl {
namespace {

/// A reserved bit is 1 and others are 0 in every diagnosis: enough to distinguish one from a telegram with a
/// flaw.
bool looks_like_diagnosis(Bytes octets)
{
    return octets.size() >= 6 && (octets[1] & 0x44) == 0x04 && (octets[2] & 0x7F) == 0;
}

bool begins_telegram(Bytes octets)
{
    const auto length = fdl::frame_length(octets);
    return length || length.error() != fdl::Flaw::start_delimiter;
}

bool is_sound_telegram(Bytes octets)
{
    const auto length = fdl::frame_length(octets);
    return length && *length > 0 && *length <= octets.size() && fdl::decode(octets.first(*length));
}

Decoded without_telegram(Bytes octets, const DecodeContext& context)
{
    Decoded decoded;
    decoded.hex = hex(octets);
    if (!looks_like_diagnosis(octets) && are_blocks(octets)) {
        decoded.kind = "extended diagnosis";
        decode_extended(octets, 0, context, decoded);
    } else {
        decoded.kind = "Slave_Diag";
        decode_diagnosis(octets, context, decoded);
    }
    return decoded;
}

int digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    const int letter = std::tolower(static_cast<unsigned char>(c));
    return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

} // namespace

std::string group_list(std::uint8_t octet)
{
    std::string result;
    for (int i = 0; i < 8; ++i)
        if (((octet >> i) & 1) != 0) result += fmt::format("{}{}", result.empty() ? "" : ", ", i + 1);
    return result;
}

Result<std::vector<std::uint8_t>, std::string> read_octets(const std::vector<std::string>& words)
{
    std::string all;
    for (const std::string& word : words) all += word + ' ';
    std::replace_if(
        all.begin(), all.end(),
        [](char c) { return std::string_view{",;:-\t\n\r"}.find(c) != std::string_view::npos; }, ' ');
    std::vector<std::uint8_t> octets;
    for (std::size_t at = 0; (at = all.find_first_not_of(' ', at)) != std::string::npos;) {
        const std::size_t end = all.find(' ', at);
        const std::string written = all.substr(at, end - at);
        std::string_view digits = written;
        if (digits.starts_with("0x") || digits.starts_with("0X") || digits.starts_with("16#"))
            digits.remove_prefix(digits.front() == '1' ? 3 : 2);
        const bool all_hexadecimal =
            std::all_of(digits.begin(), digits.end(), [](char c) { return digit(c) >= 0; });
        if (digits.empty() || !all_hexadecimal)
            return Failure{fmt::format("'{}' is not hexadecimal", written)};
        if (digits.size() > 1 && digits.size() % 2 != 0)
            return Failure{fmt::format("'{}' has an odd number of digits: two are an octet", written)};
        if (digits.size() == 1) octets.push_back(static_cast<std::uint8_t>(digit(digits[0])));
        for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
            octets.push_back(static_cast<std::uint8_t>(digit(digits[i]) * 16 + digit(digits[i + 1])));
        at = end;
    }
    if (octets.empty()) return Failure{std::string{"there is no octet"}};
    return octets;
}

std::vector<Decoded> decode_all(Bytes octets, DecodeContext context)
{
    const bool telegram =
        is_sound_telegram(octets) || (begins_telegram(octets) && !looks_like_diagnosis(octets));
    if (!telegram) return {without_telegram(octets, context)};
    std::vector<Decoded> parts;
    while (!octets.empty()) {
        const auto length = fdl::frame_length(octets);
        const std::size_t taken = length && *length > 0 ? std::min(*length, octets.size()) : octets.size();
        parts.push_back(decode_telegram(octets.first(taken), context));
        octets = octets.subspan(taken);
    }
    return parts;
}

std::optional<Form> form_called(std::string_view name)
{
    if (name == "prm") return Form::set_prm;
    if (name == "cfg") return Form::chk_cfg;
    if (name == "diag") return Form::slave_diag;
    return std::nullopt;
}

Decoded decode_as(Form form, Bytes octets, DecodeContext context)
{
    Decoded decoded;
    decoded.hex = hex(octets);
    switch (form) {
        case Form::set_prm:
            decoded.kind = "Set_Prm";
            decode_set_prm(octets, context, decoded);
            break;
        case Form::chk_cfg:
            decoded.kind = "Chk_Cfg";
            decode_cfg(octets, context, true, decoded);
            break;
        case Form::slave_diag:
            decoded.kind = "Slave_Diag";
            decode_diagnosis(octets, context, decoded);
            break;
    }
    return decoded;
}

Json decoded_json(const Decoded& part)
{
    Json lines = Json::array(), octets = Json::array();
    for (const Decoded::Line& line : part.lines)
        lines.push_back({{"name", line.name}, {"value", line.value}});
    for (const Decoded::Octet& o : part.octets)
        octets.push_back(
            {{"octet", o.octet}, {"offset", o.octet - 1}, {"value", o.value}, {"meaning", o.meaning}});
    return {{"kind", part.kind},
            {"hex", part.hex},
            {"lines", lines},
            {"octets", octets},
            {"faults", part.faults}};
}

Json decoded_json(const std::vector<Decoded>& parts)
{
    Json list = Json::array();
    for (const Decoded& part : parts) list.push_back(decoded_json(part));
    return {{"parts", list}};
}

std::string render_details(const Decoded& part, std::size_t indent, Look look)
{
    Block block;
    for (const Decoded::Line& line : part.lines) block.add(line.name, line.value);
    std::string out = block.str(indent, look);
    Table table({">OCTET", ">OFFSET", "VALUE", "MEANING"});
    for (const Decoded::Octet& o : part.octets)
        table.add({std::to_string(o.octet), std::to_string(o.octet - 1), fmt::format("0x{:02X}", o.value),
                   o.meaning});
    if (!table.empty()) out += table.str(look, indent);
    for (const std::string& fault : part.faults)
        out += paragraph(std::string(indent, ' ') + "wrong: ", fault, look.width);
    return out;
}

std::string render_decoded(const std::vector<Decoded>& parts, Look look)
{
    std::string out;
    for (const Decoded& part : parts) {
        out += (out.empty() ? "" : "\n") + painted(part.kind, Tone::strong, look) + '\n';
        Decoded with_octets = part;
        with_octets.lines.insert(with_octets.lines.begin(), {"octets", part.hex});
        out += render_details(with_octets, 2, look);
    }
    return out;
}

} // namespace dpslave::dpctl
