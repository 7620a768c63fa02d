// SPDX-License-Identifier: Apache-2.0
#include "modbus_line.hpp"

#include "instrument_registers.hpp"

#include <algorithm>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;

/// A request that stops in its middle is forgotten after this time. On a wire 3.5 characters are enough; a
/// pty and a loaded machine hold octets back for longer, and no master asks again so soon.
constexpr auto kRequestGap = 50ms;

constexpr std::uint8_t kToAll = 0;

bool is_write(std::uint8_t function)
{
    return function == kWriteOne || function == kWriteBlock;
}

/// The tags of a request; of the IEEE area two registers are one.
Concerned concerned(Bytes frame)
{
    if (frame[1] != kReadHolding && frame[1] != kReadInput && !is_write(frame[1])) return {};
    const std::uint16_t first = be16(frame, 2);
    const unsigned count = frame[1] == kWriteOne ? 1U : be16(frame, 4);
    return {tag_at(first), static_cast<std::uint16_t>(first < kIeeeArea ? count : (count + 1) / 2)};
}

} // namespace

bool ModbusLine::add(Instrument instrument)
{
    if (instrument.unit() < 1 || instrument.unit() > 254) return false;
    if (std::any_of(instruments_.begin(), instruments_.end(),
                    [&](const Instrument& i) { return i.unit() == instrument.unit(); }))
        return false;
    instruments_.push_back(std::move(instrument));
    return true;
}

std::vector<Device*> ModbusLine::devices()
{
    std::vector<Device*> all;
    for (Instrument& instrument : instruments_) all.push_back(&instrument);
    return all;
}

void ModbusLine::on_bytes(Bytes octets, Instant now)
{
    if (now - heard_ > kRequestGap) {
        rx_.clear();
        ignores_ = false;
    }
    heard_ = now;
    drop_reply(); // the master has given up on it
    rx_.insert(rx_.end(), octets.begin(), octets.end());
    while (!ignores_ && !rx_.empty()) {
        const auto length = request_length(rx_);
        if (!length) {
            ++unsupported_;
            ignores_ = true;
        } else if (*length == 0 || rx_.size() < *length) {
            return;
        } else {
            const Octets frame(rx_.begin(), rx_.begin() + static_cast<std::ptrdiff_t>(*length));
            rx_.erase(rx_.begin(), rx_.begin() + static_cast<std::ptrdiff_t>(*length));
            request(frame, now);
        }
    }
    rx_.clear();
}

void ModbusLine::request(Bytes frame, Instant now)
{
    const std::uint16_t crc = crc16(frame.first(frame.size() - 2));
    if (frame[frame.size() - 2] != low(crc) || frame[frame.size() - 1] != high(crc)) {
        ++bad_crc_;
        ignores_ = true;
        return;
    }
    drop_reply();
    for (Instrument& instrument : instruments_)
        if ((frame[0] == instrument.unit() || (frame[0] == kToAll && is_write(frame[1]))) &&
            !instrument.faults.silence)
            carry_out(instrument, frame, now);
}

void ModbusLine::carry_out(Instrument& instrument, Bytes frame, Instant now)
{
    instrument.settle(now);
    const std::uint8_t function = frame[1];
    const bool writes = is_write(function);
    Octets reply{instrument.unit(), function};
    Exception exception = instrument.faults.refuse;
    if (exception == Exception::none && writes) exception = instrument.faults.no_writes;
    if (exception == Exception::none) {
        if (writes) {
            exception = write(instrument, frame, reply, now);
        } else if (function == kReadFastStatus) {
            reply.push_back(instrument.fast_status());
        } else if (function == kLoopback) {
            if (be16(frame, 2) != 0 || instrument.faults.no_loopback) {
                ++unsupported_;
                return;
            }
            reply.insert(reply.end(), frame.begin() + 2, frame.end() - 2);
        } else {
            exception = read(instrument, frame, reply, now);
        }
    }
    for (const std::string& line : instrument.take_log()) log(instrument, line);
    for (const std::string& line : instrument.take_warnings()) warn(instrument, line);
    if (exception != Exception::none) {
        ++instrument.counters.exceptions;
        reply = {instrument.unit(), static_cast<std::uint8_t>(function | 0x80),
                 static_cast<std::uint8_t>(exception)};
    }
    if (frame[0] == kToAll) return;
    Octets octets = with_crc(std::move(reply));
    if (instrument.faults.too_short) octets.pop_back();
    this->reply(instrument, instrument.faults, std::move(octets), concerned(frame), now);
}

Exception ModbusLine::read(Instrument& instrument, Bytes frame, Octets& answer, Instant now)
{
    std::vector<std::uint16_t> words;
    const Exception exception = instrument.read(be16(frame, 2), be16(frame, 4), words, now);
    answer.push_back(static_cast<std::uint8_t>(2 * words.size()));
    for (const std::uint16_t word : words) answer.insert(answer.end(), {high(word), low(word)});
    return exception;
}

Exception ModbusLine::write(Instrument& instrument, Bytes frame, Octets& answer, Instant now)
{
    answer.insert(answer.end(), frame.begin() + 2, frame.begin() + 6);
    const std::uint16_t address = be16(frame, 2);
    if (frame[1] == kWriteOne) return instrument.write_one(address, be16(frame, 4), now);
    std::vector<std::uint16_t> words;
    if (frame[6] != 2 * be16(frame, 4)) return Exception::illegal_value;
    for (std::size_t at = 7; at + 2 < frame.size(); at += 2) words.push_back(be16(frame, at));
    return instrument.write_block(address, words, now);
}

} // namespace dpslave::sim
