// SPDX-License-Identifier: Apache-2.0
#include "pdu.hpp"

#include <algorithm>

namespace dpslave::modbus {
namespace {

Request head(std::uint8_t function, std::uint16_t first, std::uint16_t second)
{
    Request request;
    request.push(function);
    request.push16(first);
    request.push16(second);
    return request;
}

const char* meaning(std::uint8_t code)
{
    switch (code) {
        case 1: return "illegal function";
        case 2: return "illegal data address";
        case 3: return "illegal data value";
        case 4: return "device failure";
        case 5: return "acknowledge: the device takes longer";
        case 6: return "device busy";
        case 7: return "negative acknowledge";
        case 8: return "memory parity error";
        case 10: return "gateway: no path to the device";
        case 11: return "gateway: the device does not answer";
        default: return "unknown to the protocol";
    }
}

} // namespace

Request read_registers(std::uint16_t first, std::uint16_t count, std::uint8_t function)
{
    return head(function, first, count);
}

Request loopback(std::uint16_t token)
{
    return head(kLoopback, 0, token);
}

Request write_register(std::uint16_t reg, std::uint16_t word)
{
    return head(kWriteRegister, reg, word);
}

Request write_registers(std::uint16_t first, std::span<const std::uint16_t> words)
{
    Request request = head(kWriteRegisters, first, static_cast<std::uint16_t>(words.size()));
    request.push(static_cast<std::uint8_t>(2 * words.size()));
    for (const std::uint16_t word : words) request.push16(word);
    return request;
}

std::size_t longest_answer(Bytes request)
{
    return request[0] == kReadRegisters || request[0] == kReadInputRegisters ? 2u + 2u * be16(request, 3)
                                                                             : 5u;
}

bool answers(Bytes request, Bytes answer)
{
    if (answer.empty()) return false;
    if (answer[0] == (request[0] | kIsException)) return answer.size() == 2;
    if (answer[0] != request[0] || answer.size() != longest_answer(request)) return false;
    switch (request[0]) {
        case kReadRegisters:
        case kReadInputRegisters: return answer[1] == 2 * be16(request, 3);
        case kWriteRegister: return be16(answer, 1) == be16(request, 1);
        case kLoopback: return std::ranges::equal(answer, request);
        case kWriteRegisters: return std::ranges::equal(answer, request.first(5));
        default: return false;
    }
}

std::optional<std::uint8_t> exception_of(Bytes answer)
{
    if ((answer[0] & kIsException) == 0) return std::nullopt;
    return answer[1];
}

bool is_of_gateway(std::uint8_t code)
{
    return code == 10 || code == 11;
}

std::string exception_text(std::uint8_t code)
{
    return "exception " + std::to_string(code) + " (" + meaning(code) + ")";
}

/// EI-ASCII and Modbus reference, section 4. An instrument says 2 or 3 for a read-only register and for a
/// value beyond its limits alike; the table separates them. 3 on a read: this register cannot be read as
/// one word.
AccessError error_of_exception(std::uint8_t code, bool is_write, const drive::Tag* row)
{
    const bool read_only = is_write && row != nullptr && row->access == drive::Access::read_only;
    switch (code) {
        case 2: return read_only ? AccessError::read_only : AccessError::invalid_tag;
        case 3:
            if (read_only) return AccessError::read_only;
            return is_write ? AccessError::out_of_range : AccessError::invalid_tag;
        case 10:
        case 11: return AccessError::no_answer; // it is the gateway that speaks
        default: return AccessError::not_understood;
    }
}

std::uint16_t word_read(Bytes answer, std::size_t index)
{
    return be16(answer, 2 + 2 * index);
}

std::uint16_t echoed_word(Bytes answer)
{
    return be16(answer, 3);
}

} // namespace dpslave::modbus
