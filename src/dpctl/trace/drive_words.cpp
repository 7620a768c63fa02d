// SPDX-License-Identifier: Apache-2.0
#include "drive_words.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/drive/ei_ascii.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

namespace ei = drive::ei;

constexpr std::size_t kEiAddress = 5;     ///< EOT GID GID UID UID
constexpr std::size_t kShortestBlock = 5; ///< STX C1 C2 ETX BCC
constexpr std::size_t kMostValues = 8;    ///< that are shown; the octets stand behind them

std::string text_of(Bytes octets)
{
    return printable({reinterpret_cast<const char*>(octets.data()), octets.size()});
}

/// STX, mnemonic, value, ETX, BCC.
DriveWords block(std::string_view before, Bytes octets)
{
    const std::size_t length = octets.size();
    if (length < kShortestBlock || octets[length - 2] != ei::kEtx) return {};
    const std::string mnemonic = text_of(octets.subspan(1, 2));
    const std::string value = text_of(octets.subspan(3, length - kShortestBlock));
    std::string words = fmt::format("{}{} = {}", before, mnemonic, value);
    const auto ee = ei::decode_word(value);
    if (before.empty() && mnemonic == "EE" && ee) words += fmt::format(" ({})", ei::meaning_of_ee(*ee));
    return {.words = std::move(words), .check = "BCC"};
}

DriveWords ei_ascii_question(Bytes frame)
{
    const Bytes behind = frame.subspan(kEiAddress);
    if (behind[0] == ei::kStx) return block("write ", behind);
    const bool is_read = behind.size() >= 3 && behind.back() == ei::kEnq;
    if (!is_read) return {};
    return {.words = "read " + text_of(behind.subspan(behind.size() - 3, 2))};
}

std::string values(Bytes octets)
{
    std::string text;
    const std::size_t count = octets.size() / 2;
    for (std::size_t i = 0; i < std::min(count, kMostValues); ++i)
        text += fmt::format(" {}", be16(octets, 2 * i));
    return count > kMostValues ? text + " ..." : text;
}

std::string registers(std::uint16_t first, unsigned count)
{
    return count == 1 ? fmt::format("register {}", first)
                      : fmt::format("registers {} to {}", first, first + count - 1);
}

/// From the function code on, at least two octets.
std::string modbus_question(Bytes pdu)
{
    if (pdu.size() < 5) return {};
    const std::uint16_t first = be16(pdu, 1), second = be16(pdu, 3);
    switch (pdu[0]) {
        case 3: return "read " + registers(first, second);
        case 4: return fmt::format("read {} by function 4", registers(first, second));
        case 6: return fmt::format("write register {} = {}", first, second);
        case 8: return fmt::format("loop back {:04X}", second);
        case 16:
            if (pdu.size() < 6) return {};
            return fmt::format("write {} ={}", registers(first, second), values(pdu.subspan(6)));
        default: return {};
    }
}

std::string modbus_answer(Bytes pdu)
{
    if ((pdu[0] & 0x80U) != 0) return fmt::format("exception {} to function {}", pdu[1], pdu[0] & 0x7FU);
    const bool is_read = pdu[0] == 3 || pdu[0] == 4;
    if (is_read) return (pdu.size() == 4 ? "value" : "values") + values(pdu.subspan(2));
    if (pdu.size() != 5) return {};
    const std::uint16_t first = be16(pdu, 1), second = be16(pdu, 3);
    switch (pdu[0]) {
        case 6: return fmt::format("written register {} = {}", first, second);
        case 8: return fmt::format("loop back {:04X}", second);
        case 16: return "written " + registers(first, second);
        default: return {};
    }
}

} // namespace

DriveWords ei_ascii_words(Bytes frame)
{
    if (frame.empty()) return {};
    if (frame.size() > kEiAddress && frame[0] == ei::kEot) return ei_ascii_question(frame);
    if (frame[0] == ei::kStx) return block("", frame);
    if (frame.size() != 1) return {};
    switch (frame[0]) {
        case ei::kAck: return {.words = "ACK"};
        case ei::kNak: return {.words = "NAK"};
        case ei::kEot: return {.words = "EOT"};
        default: return {};
    }
}

DriveWords modbus_words(Bytes frame, bool is_question)
{
    constexpr std::size_t kShortest = 5; // unit, two octets, CRC
    if (frame.size() < kShortest) return {};
    const Bytes pdu = frame.subspan(1, frame.size() - 3);
    std::string words = is_question ? modbus_question(pdu) : modbus_answer(pdu);
    if (words.empty()) words = fmt::format("function {}", pdu[0]);
    return {.words = std::move(words), .check = "CRC"};
}

} // namespace dpslave::dpctl
