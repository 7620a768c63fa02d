// SPDX-License-Identifier: Apache-2.0
#include "dpslave/modbus/modbus_client.hpp"

#include "exchange.hpp"
#include "ieee.hpp"
#include "pdu.hpp"

#include <algorithm>

namespace dpslave::modbus {

using drive::Tag;
using drive::TagType;
using drive::UnitAddress;

namespace {

/// A device that lacks this function and is silent to it, such as a 2400, gets at most this number of
/// loopbacks.
constexpr int kSilentLoopbacks = 3;

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

ModbusClient::ModbusClient(ModbusPort& line, ClientSettings settings)
    : settings_(std::move(settings)), exchange_(std::make_unique<Exchange>(line, settings_))
{}

ModbusClient::~ModbusClient() = default;

void ModbusClient::set_units(std::vector<ModbusDrive> units)
{
    settings_.units = std::move(units);
    silent_loopbacks_.clear();
}

void ModbusClient::listen()
{
    exchange_->listen();
}

drive::AnswerCounts ModbusClient::counts(UnitAddress unit) const
{
    return exchange_->counts(unit.unit);
}

/// One more transaction costs 20 characters and the latency of the drive, a word that is read over costs two
/// characters (EI-ASCII and Modbus reference, section 6).
drive::BlockRule ModbusClient::block_rule(std::uint32_t baud, int bits_of_a_character)
{
    constexpr std::uint32_t kTransaction = 20;
    constexpr std::uint32_t kLatencyMs = 5;
    const auto bits = static_cast<std::uint32_t>(bits_of_a_character);
    const std::uint32_t gap = (kTransaction * bits + baud * kLatencyMs / 1000) / (2 * bits);
    return {.max_tags = kMostRegisters,
            .max_gap = static_cast<std::uint16_t>(std::min<std::uint32_t>(gap, kMostRegisters)),
            .max_written = kMostRegisters};
}

drive::BlockRule ModbusClient::block_rule() const
{
    return block_rule(settings_.baud, settings_.bits_of_a_character);
}

ModbusDrive ModbusClient::functions_of(std::uint8_t unit) const
{
    const auto found = std::find_if(settings_.units.begin(), settings_.units.end(),
                                    [unit](const ModbusDrive& one) { return one.unit == unit; });
    return found == settings_.units.end() ? ModbusDrive{} : *found;
}

ModbusClient::Reply ModbusClient::ask(std::uint8_t unit, Bytes request)
{
    const bool is_answered = exchange_->ask(unit, request);
    trouble_ = exchange_->trouble();
    if (!is_answered) return {.error = AccessError::no_answer, .exception = {}, .answer = {}};
    const auto exception = exception_of(exchange_->answer());
    if (!exception) return {.error = {}, .exception = {}, .answer = exchange_->answer()};
    trouble_ = exception_text(*exception);
    return {.error = {}, .exception = exception, .answer = {}};
}

/// Returns function 3, or 4 if an answer of the same length to function 3 is owed.
std::optional<std::uint8_t> ModbusClient::function_for(const Block& block)
{
    const bool gave_data = gave_data_.count(block) != 0;
    if (exchange_->may_ask(block.unit, read_registers(block.first, block.count), gave_data))
        return kReadRegisters;
    const auto by_4 = read_registers(block.first, block.count, kReadInputRegisters);
    if (functions_of(block.unit).reads_by_4 && exchange_->may_ask(block.unit, by_4, gave_data))
        return kReadInputRegisters;
    return std::nullopt;
}

/// Broadcasts are never answered, and beyond 247 there is no unit.
bool ModbusClient::has_address(std::uint8_t unit)
{
    if (unit >= kLowestUnit && unit <= kHighestUnit) return true;
    trouble_ = "unit " + std::to_string(unit) + " is no Modbus address (1 to 247)";
    return false;
}

ModbusClient::Reply ModbusClient::ask_for(const Block& block)
{
    if (!has_address(block.unit)) return {.error = AccessError::no_answer, .exception = {}, .answer = {}};
    auto function = function_for(block);
    if (!function) {
        exchange_->listen(); // the owed answer may have come
        function = function_for(block);
    }
    if (!function) {
        const AccessError error = clear(block.unit);
        if (error != AccessError::none) return {.error = error, .exception = {}, .answer = {}};
        function = function_for(block);
    }
    if (!function) return {.error = AccessError::deferred, .exception = {}, .answer = {}};
    const Reply reply = ask(block.unit, read_registers(block.first, block.count, *function));
    if (reply.exception) gave_data_.erase(block);
    if (reply.exception && error_of_exception(*reply.exception, false, nullptr) == AccessError::invalid_tag)
        denial_ = "exception " + std::to_string(*reply.exception);
    if (!reply.answer.empty()) gave_data_.insert(block);
    return reply;
}

/// Ends what the unit owes by an answer that cannot be one to it: that to a block of another length which it
/// is known to give, or to function 8. none: it has. deferred: only time helps.
AccessError ModbusClient::clear(std::uint8_t unit)
{
    for (const Block block : gave_data_) {
        if (block.unit != unit) continue;
        const auto function = function_for(block);
        if (!function) continue;
        const Reply reply = ask(unit, read_registers(block.first, block.count, *function));
        if (!reply.exception) return reply.error;
        gave_data_.erase(block);
        return AccessError::none;
    }
    return loop_back(unit);
}

AccessError ModbusClient::loop_back(std::uint8_t unit)
{
    trouble_ = "an answer to an earlier request of this form is still owed";
    int& silent = silent_loopbacks_[unit];
    if (!functions_of(unit).has_loopback || silent >= kSilentLoopbacks) return AccessError::deferred;
    const auto request = loopback(++token_);
    if (!exchange_->may_ask(unit, request, true)) return AccessError::deferred;
    const Reply reply = ask(unit, request);
    silent = reply.error == AccessError::no_answer ? silent + 1 : 0;
    return reply.error;
}

AccessError ModbusClient::read(UnitAddress unit, const Tag& tag, std::span<std::uint16_t> words)
{
    trouble_.clear();
    denial_.clear();
    if (!fits_one_request(words.size()) || (words.size() == 1 && tag.type == TagType::string)) {
        trouble_ = words.size() == 1 ? "a STRING is not transported" : "1 to 123 tags can be read at a time";
        return AccessError::unsupported_type;
    }
    const bool is_block = words.size() > 1;
    if (!is_block && is_ieee(tag)) return read_ieee(unit.unit, tag, words[0]);
    const std::uint16_t first = is_block ? tag.number : register_of(tag);
    const Reply reply = ask_for({unit.unit, first, static_cast<std::uint16_t>(words.size())});
    if (reply.error != AccessError::none) return reply.error;
    if (reply.exception) return error_of_exception(*reply.exception, false, is_block ? nullptr : &tag);
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = word_read(reply.answer, i);
    return AccessError::none;
}

AccessError ModbusClient::read_ieee(std::uint8_t unit, const Tag& tag, std::uint16_t& word)
{
    const Reply reply = ask_for({unit, register_of(tag), 2});
    if (reply.error != AccessError::none) return reply.error;
    if (reply.exception) return error_of_exception(*reply.exception, false, &tag);
    const IeeePair pair{word_read(reply.answer, 0), word_read(reply.answer, 1)};
    const auto value = word_of(tag, pair);
    if (!value) {
        trouble_ = ieee_flaw(tag, pair);
        return AccessError::does_not_fit;
    }
    word = *value;
    return AccessError::none;
}

ModbusClient::Reply ModbusClient::ask_to_write(std::uint8_t unit, Bytes request)
{
    if (!has_address(unit)) return {.error = AccessError::no_answer, .exception = {}, .answer = {}};
    if (!exchange_->may_ask(unit, request, false)) exchange_->listen();
    if (!exchange_->may_ask(unit, request, false)) {
        const AccessError error = clear(unit);
        if (error != AccessError::none) return {.error = error, .exception = {}, .answer = {}};
        if (!exchange_->may_ask(unit, request, false))
            return {.error = AccessError::deferred, .exception = {}, .answer = {}};
    }
    Reply reply = ask(unit, request);
    has_sent_ = exchange_->has_sent();
    return reply;
}

AccessError ModbusClient::write(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t> words)
{
    trouble_.clear();
    has_sent_ = false;
    if (!fits_one_request(words.size()) || (words.size() == 1 && tag.type == TagType::string)) {
        trouble_ =
            words.size() == 1 ? "a STRING is not transported" : "1 to 123 tags can be written at a time";
        return AccessError::unsupported_type;
    }
    const bool is_block = words.size() > 1;
    if (!is_block && !is_ieee(tag)) return write_single(unit.unit, tag, words[0]);
    const IeeePair pair = is_block ? IeeePair{} : pair_of(tag, words[0]);
    const Reply reply = ask_to_write(unit.unit, is_block ? write_registers(tag.number, words)
                                                         : write_registers(register_of(tag), pair));
    if (reply.error != AccessError::none) return reply.error;
    if (reply.exception) return error_of_exception(*reply.exception, true, is_block ? nullptr : &tag);
    return AccessError::none;
}

/// A drive that limits a value and accepts it echoes what it took.
AccessError ModbusClient::write_single(std::uint8_t unit, const Tag& tag, std::uint16_t word)
{
    const Reply reply = ask_to_write(unit, write_register(register_of(tag), word));
    if (reply.error != AccessError::none) return reply.error;
    if (reply.exception) return error_of_exception(*reply.exception, true, &tag);
    if (echoed_word(reply.answer) == word) return AccessError::none;
    trouble_ = "the drive took " + drive::displayed(tag, echoed_word(reply.answer)) + " instead of " +
               drive::displayed(tag, word);
    return AccessError::out_of_range;
}

/// Reads register 1, alone or with as many after it as make an answer that the unit does not owe.
AccessError ModbusClient::probe(UnitAddress unit)
{
    constexpr std::uint16_t kAnyRegister = 1;
    constexpr std::uint16_t kMostTried = 16; // more than the questions for which a settle time has room
    trouble_.clear();
    if (!has_address(unit.unit)) return AccessError::no_answer;
    for (std::uint16_t count = 1; count <= kMostTried; ++count) {
        const auto request = read_registers(kAnyRegister, count);
        if (!exchange_->may_ask(unit.unit, request, true)) continue;
        ask(unit.unit, request);
        if (exchange_->heard_unit()) trouble_.clear();
        return exchange_->heard_unit() ? AccessError::none : AccessError::no_answer;
    }
    return AccessError::deferred;
}

drive::Sight ModbusClient::look(UnitAddress unit, const drive::Look& what)
{
    using Kind = drive::Sight::Kind;
    trouble_.clear();
    const Reply reply = ask_for({unit.unit, what.reg, 1});
    if (reply.exception && !exchange_->heard_unit()) return {}; // of a gateway, for a unit that is silent
    if (reply.exception) return {Kind::denied, "exception " + std::to_string(*reply.exception)};
    if (reply.error == AccessError::none)
        return {Kind::value, drive::displayed(drive::unlisted_tag(what.reg), word_read(reply.answer, 0))};
    return {exchange_->heard_unit() ? Kind::damaged : Kind::silence, {}};
}

} // namespace dpslave::modbus
