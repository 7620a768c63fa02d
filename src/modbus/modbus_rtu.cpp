// SPDX-License-Identifier: Apache-2.0
#include "dpslave/modbus/modbus_rtu.hpp"

#include "ieee.hpp"
#include "pdu.hpp"
#include "rtu_line.hpp"

#include <algorithm>

namespace dpslave::modbus {

using drive::Tag;
using drive::TagType;
using drive::UnitAddress;

/// `answer` is empty unless there is one without exception; valid until the next exchange.
struct ModbusRtu::Reply {
    bool came = false;
    std::uint8_t exception = 0;
    Bytes answer;
};

namespace {

/// The register that one tag is found at.
std::uint16_t register_of(const Tag& tag)
{
    return tag.modbus_register.value_or(tag.number);
}

bool fits_one_request(std::size_t words)
{
    return words >= 1 && words <= kMostRegisters;
}

} // namespace

Result<std::unique_ptr<ModbusRtu>, std::string> ModbusRtu::open(const RtuSettings& settings,
                                                                std::atomic<bool>& is_open)
{
    auto line = RtuLine::open(settings, is_open);
    if (!line) return Failure{line.error()};
    return std::unique_ptr<ModbusRtu>{new ModbusRtu{settings, *std::move(line)}};
}

ModbusRtu::ModbusRtu(const RtuSettings& settings, std::unique_ptr<RtuLine> line)
    : settings_(settings), line_(std::move(line))
{}

ModbusRtu::~ModbusRtu() = default;

/// One more transaction costs 20 characters and the latency of the drive, a word that is read over costs two
/// characters (reference, section 6).
drive::BlockRule ModbusRtu::block_rule(const RtuSettings& settings)
{
    constexpr std::uint32_t kTransaction = 20;
    constexpr std::uint32_t kLatencyMs = 5;
    const auto bits = static_cast<std::uint32_t>(bits_of_a_character(settings));
    const std::uint32_t gap = (kTransaction * bits + settings.baud * kLatencyMs / 1000) / (2 * bits);
    return {.max_tags = kMostRegisters,
            .max_gap = static_cast<std::uint16_t>(std::min<std::uint32_t>(gap, kMostRegisters)),
            .max_written = kMostRegisters};
}

ModbusRtu::Reply ModbusRtu::ask(UnitAddress unit, Bytes request)
{
    trouble_.clear();
    const auto answer = line_->exchange(unit.unit, request);
    if (!answer) {
        trouble_ = line_->trouble();
        return {};
    }
    const std::uint8_t exception = exception_of(*answer);
    if (exception == 0) return {.came = true, .exception = 0, .answer = *answer};
    trouble_ = exception_text(exception);
    return {.came = true, .exception = exception, .answer = {}};
}

AccessError ModbusRtu::read(UnitAddress unit, const Tag& tag, std::span<std::uint16_t> words)
{
    if (!fits_one_request(words.size()) || (words.size() == 1 && tag.type == TagType::string)) {
        trouble_ = words.size() == 1 ? "a STRING is not transported" : "1 to 123 tags can be read at a time";
        return AccessError::unsupported_type;
    }
    const bool is_block = words.size() > 1;
    if (!is_block && is_ieee(tag)) return read_ieee(unit, tag, words[0]);
    const std::uint16_t first = is_block ? tag.number : register_of(tag);
    const Reply reply = ask(unit, read_registers(first, static_cast<std::uint16_t>(words.size())));
    if (!reply.came) return AccessError::no_answer;
    if (reply.exception != 0) return error_of_exception(reply.exception, false, is_block ? nullptr : &tag);
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = word_read(reply.answer, i);
    return AccessError::none;
}

AccessError ModbusRtu::read_ieee(UnitAddress unit, const Tag& tag, std::uint16_t& word)
{
    const Reply reply = ask(unit, read_registers(register_of(tag), 2));
    if (!reply.came) return AccessError::no_answer;
    if (reply.exception != 0) return error_of_exception(reply.exception, false, &tag);
    const IeeePair pair{word_read(reply.answer, 0), word_read(reply.answer, 1)};
    const auto value = word_of(tag, pair);
    if (!value) {
        trouble_ = "tag " + std::to_string(tag.number) + " is " + ieee_text(pair) + ", which with " +
                   std::to_string(tag.decimals) + " decimals does not fit 16 bits";
        return AccessError::out_of_range;
    }
    word = *value;
    return AccessError::none;
}

AccessError ModbusRtu::write(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t> words)
{
    if (!fits_one_request(words.size()) || (words.size() == 1 && tag.type == TagType::string)) {
        trouble_ =
            words.size() == 1 ? "a STRING is not transported" : "1 to 123 tags can be written at a time";
        return AccessError::unsupported_type;
    }
    const bool is_block = words.size() > 1;
    if (!is_block && !is_ieee(tag)) return write_single(unit, tag, words[0]);
    const IeeePair pair = is_block ? IeeePair{} : pair_of(tag, words[0]);
    const Reply reply =
        ask(unit, is_block ? write_registers(tag.number, words) : write_registers(register_of(tag), pair));
    if (!reply.came) return AccessError::no_answer;
    if (reply.exception != 0) return error_of_exception(reply.exception, true, is_block ? nullptr : &tag);
    return AccessError::none;
}

/// A drive that limits a value and accepts it echoes what it took.
AccessError ModbusRtu::write_single(UnitAddress unit, const Tag& tag, std::uint16_t word)
{
    const Reply reply = ask(unit, write_register(register_of(tag), word));
    if (!reply.came) return AccessError::no_answer;
    if (reply.exception != 0) return error_of_exception(reply.exception, true, &tag);
    if (echoed_word(reply.answer) == word) return AccessError::none;
    trouble_ = "the drive took " + drive::displayed(tag, echoed_word(reply.answer)) + " instead of " +
               drive::displayed(tag, word);
    return AccessError::out_of_range;
}

bool ModbusRtu::probe(UnitAddress unit)
{
    constexpr std::uint16_t kAnyRegister = 1;
    const Reply reply = ask(unit, read_registers(kAnyRegister, 1));
    if (reply.exception == 0) return reply.came;
    const bool answers = error_of_exception(reply.exception, false, nullptr) != AccessError::no_answer;
    if (answers) trouble_.clear();
    return answers;
}

} // namespace dpslave::modbus
