// SPDX-License-Identifier: Apache-2.0
#include "unjudged_clients.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdlib>

namespace dpslave::drive_line {
namespace {

std::string select_text(const drive::Tag& tag, std::uint16_t word)
{
    if (tag.type == drive::TagType::word) return fmt::format(">{:04X}", word);
    const int counts = static_cast<std::int16_t>(word);
    return fmt::format("{:.{}f}{}", counts / std::pow(10.0, tag.decimals), tag.decimals,
                       tag.decimals == 0 ? "." : "");
}

std::uint16_t word_of_text(const drive::Tag& tag, const std::string& text)
{
    if (tag.type == drive::TagType::word)
        return static_cast<std::uint16_t>(std::strtoul(text.c_str() + 1, nullptr, 16));
    return static_cast<std::uint16_t>(
        std::lround(std::strtod(text.c_str(), nullptr) * std::pow(10.0, tag.decimals)));
}

} // namespace

// ---- EI-ASCII

std::string UnjudgedEiClient::answer()
{
    const Instant until = line_.now() + line_.rules().timeout + line_.rules().character * 30;
    std::string text;
    while (line_.now() < until) {
        std::uint8_t octet = 0;
        if (line_.read({&octet, 1}, until - line_.now()) == 0) return {};
        const char c = static_cast<char>(octet);
        if (text.empty() && c != '\x02' && c != '\x04' && c != '\x06' && c != '\x15') continue;
        text += c;
        if (text[0] != '\x02') return text;
        if (text.size() < 5 || text[text.size() - 2] != '\x03') continue;
        char sum = 0;
        for (std::size_t i = 1; i + 1 < text.size(); ++i) sum = static_cast<char>(sum ^ text[i]);
        return sum == text.back() ? text : std::string{};
    }
    return {};
}

std::string UnjudgedEiClient::asked(drive::UnitAddress unit, const std::string& mnemonic)
{
    line_.discard();
    const std::string request = fmt::format("\x04{0}{0}{1}{1}{2}\x05", unit.group, unit.unit, mnemonic);
    line_.write(Octets(request.begin(), request.end()));
    const std::string text = answer();
    const bool is_other = text.size() > 1 && text.substr(1, 2) != mnemonic;
    return is_other ? std::string{} : text;
}

AccessError UnjudgedEiClient::reason(drive::UnitAddress unit)
{
    const std::string ee = asked(unit, "EE");
    if (ee.size() < 6) return AccessError::no_answer;
    switch (std::strtoul(ee.substr(4, 2).c_str(), nullptr, 16)) {
        case 1: return AccessError::invalid_tag;
        case 5: return AccessError::read_only;
        case 8: return AccessError::out_of_range;
        default: return AccessError::not_understood;
    }
}

AccessError UnjudgedEiClient::read(drive::UnitAddress unit, const drive::Tag& tag,
                                   std::span<std::uint16_t> words)
{
    const std::string text = asked(unit, tag.mnemonic);
    if (text == "\x04") return reason(unit);
    if (text.size() < 6) return AccessError::no_answer;
    words[0] = word_of_text(tag, text.substr(3, text.size() - 5));
    return AccessError::none;
}

AccessError UnjudgedEiClient::write(drive::UnitAddress unit, const drive::Tag& tag,
                                    std::span<const std::uint16_t> words)
{
    line_.discard();
    const std::string covered = tag.mnemonic + select_text(tag, words[0]) + '\x03';
    char sum = 0;
    for (const char c : covered) sum = static_cast<char>(sum ^ c);
    const std::string request =
        fmt::format("\x04{0}{0}{1}{1}\x02{2}{3}", unit.group, unit.unit, covered, sum);
    line_.write(Octets(request.begin(), request.end()));
    const std::string text = answer();
    if (text == "\x06") return AccessError::none;
    return text == "\x15" ? reason(unit) : AccessError::no_answer;
}

// ---- Modbus

Octets UnjudgedModbusClient::asked(drive::UnitAddress unit, const Octets& pdu, std::size_t length)
{
    // 3.5 characters of silence before each request: the standard wants them of every master
    while (line_.receive(line_.now() + line_.rules().character * 7 / 2) !=
           modbus::ModbusPort::Heard::silence) {
    }
    line_.send(unit.unit, pdu);
    const Instant until = line_.now() + line_.rules().timeout +
                          line_.rules().character * static_cast<std::int64_t>(pdu.size() + length + 6);
    while (line_.now() < until) {
        if (line_.receive(until) != modbus::ModbusPort::Heard::frame) continue;
        const Bytes frame = line_.frame();
        if (frame.size() < 3 || frame[0] != unit.unit || (frame[1] & 0x7FU) != pdu[0]) continue;
        if (frame.size() == (frame[1] == pdu[0] ? length + 1 : 3)) return {frame.begin() + 1, frame.end()};
    }
    return {};
}

AccessError UnjudgedModbusClient::read(drive::UnitAddress unit, const drive::Tag& tag,
                                       std::span<std::uint16_t> words)
{
    const bool is_ieee = tag.modbus_register.has_value();
    const unsigned first = tag.modbus_register.value_or(tag.number);
    const std::size_t count = is_ieee ? 2 : words.size();
    const Octets answer =
        asked(unit,
              {3, static_cast<std::uint8_t>(first >> 8U), static_cast<std::uint8_t>(first & 0xFFU), 0,
               static_cast<std::uint8_t>(count)},
              2 + 2 * count);
    if (answer.empty()) return AccessError::no_answer;
    if (answer[0] != 3) return AccessError::invalid_tag;
    if (is_ieee) {
        const std::uint32_t bits = std::uint32_t{answer[2]} << 24U | std::uint32_t{answer[3]} << 16U |
                                   std::uint32_t{answer[4]} << 8U | answer[5];
        words[0] = static_cast<std::uint16_t>(
            std::lround(double{std::bit_cast<float>(bits)} * std::pow(10.0, tag.decimals)));
        return AccessError::none;
    }
    for (std::size_t i = 0; i < count; ++i)
        words[i] = static_cast<std::uint16_t>(answer[2 + 2 * i] << 8U | answer[3 + 2 * i]);
    return AccessError::none;
}

AccessError UnjudgedModbusClient::write(drive::UnitAddress unit, const drive::Tag& tag,
                                        std::span<const std::uint16_t> words)
{
    const bool is_ieee = tag.modbus_register.has_value();
    const unsigned first = tag.modbus_register.value_or(tag.number);
    std::vector<std::uint16_t> registers(words.begin(), words.end());
    if (is_ieee) {
        const double value = static_cast<std::int16_t>(words[0]) / std::pow(10.0, tag.decimals);
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
        registers = {static_cast<std::uint16_t>(bits >> 16U), static_cast<std::uint16_t>(bits & 0xFFFFU)};
    }
    const bool is_one = registers.size() == 1;
    Octets pdu{static_cast<std::uint8_t>(is_one ? 6 : 16), static_cast<std::uint8_t>(first >> 8U),
               static_cast<std::uint8_t>(first & 0xFFU)};
    if (!is_one)
        pdu.insert(pdu.end(), {0, static_cast<std::uint8_t>(registers.size()),
                               static_cast<std::uint8_t>(2 * registers.size())});
    for (const std::uint16_t word : registers)
        pdu.insert(pdu.end(),
                   {static_cast<std::uint8_t>(word >> 8U), static_cast<std::uint8_t>(word & 0xFFU)});
    const Octets answer = asked(unit, pdu, 5);
    if (answer.empty()) return AccessError::no_answer;
    if (answer[0] == pdu[0]) return AccessError::none;
    return answer[1] == 2 ? AccessError::invalid_tag : AccessError::out_of_range;
}

AccessError UnjudgedModbusClient::probe(drive::UnitAddress unit)
{
    return asked(unit, {3, 0, 1, 0, 1}, 4).empty() ? AccessError::no_answer : AccessError::none;
}

std::unique_ptr<drive::Backend> unjudged_ei(EiLine& line, const Conditions&)
{
    return std::make_unique<UnjudgedEiClient>(line);
}

std::unique_ptr<drive::Backend> unjudged_modbus(ModbusFrames& line, const Conditions&)
{
    return std::make_unique<UnjudgedModbusClient>(line);
}

} // namespace dpslave::drive_line
