// SPDX-License-Identifier: Apache-2.0
#include "noisy_lines.hpp"

#include <algorithm>
#include <array>

namespace dpslave::drive_line {
namespace {

/// The receiver's rule for the end of what is no frame: 20 characters, at least 20 ms.
constexpr Time kGap = 24ms;

bool are_good(const std::vector<::test::Character>& characters)
{
    return std::all_of(characters.begin(), characters.end(), [](const auto& one) { return one.good; });
}

Octets octets_of(const std::vector<::test::Character>& characters)
{
    Octets octets;
    for (const auto& one : characters) octets.push_back(one.octet);
    return octets;
}

} // namespace

EiLineWithBitErrors::EiLineWithBitErrors(EiLine& line, double errors)
    : line_(line), there_(errors, 7, 1), back_(errors, 7, 2)
{}

bool EiLineWithBitErrors::write(Bytes octets)
{
    const auto arrived = there_.received({octets.begin(), octets.end()});
    return !are_good(arrived) || line_.write(octets_of(arrived));
}

std::size_t EiLineWithBitErrors::read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout)
{
    const Instant until = line_.now() + timeout;
    while (waiting_.empty()) {
        std::array<std::uint8_t, 64> part{};
        const std::size_t got = line_.read(part, until - line_.now());
        if (got == 0) return 0;
        for (const auto& one :
             back_.received({part.begin(), part.begin() + static_cast<std::ptrdiff_t>(got)}))
            waiting_.push_back(one.good ? one.octet : std::uint8_t{0});
    }
    std::size_t given = 0;
    for (; given < into.size() && !waiting_.empty(); ++given) {
        into[given] = waiting_.front();
        waiting_.pop_front();
    }
    return given;
}

void EiLineWithBitErrors::discard()
{
    waiting_.clear();
    line_.discard();
}

void EiLineWithBitErrors::heal()
{
    there_.heal();
    back_.heal();
}

ModbusLineWithBitErrors::ModbusLineWithBitErrors(ModbusFrames& line, double errors, ::test::Parity parity)
    : line_(line), there_(errors, 8, 1, parity), back_(errors, 8, 2, parity)
{}

bool ModbusLineWithBitErrors::send(std::uint8_t unit, Bytes pdu)
{
    receiver_.sent(unit, pdu);
    Octets question(1 + pdu.size(), unit);
    std::copy(pdu.begin(), pdu.end(), question.begin() + 1);
    question = with_checksum(std::move(question));
    const auto characters = there_.received(question);
    Octets arrived = octets_of(characters);
    if (!are_good(characters) || arrived.size() < 4 || checksum(arrived) != 0) return true; // not heard
    if (arrived != question) ++taken_for_good_;
    arrived.resize(arrived.size() - 2);
    return line_.send(arrived[0], Bytes{arrived}.subspan(1));
}

/// As the program's own line does it (src/modbus/rtu_line.cpp), on the simulated clock.
modbus::ModbusPort::Heard ModbusLineWithBitErrors::receive(Instant until)
{
    using Found = modbus::FrameReceiver::Found;
    for (;;) {
        if (const Heard heard = of_what_has_come(); heard != Heard::silence) return heard;
        const bool in_frame = receiver_.in_frame();
        if (line_.receive(in_frame ? now() + kGap : until) == Heard::frame) {
            answered_.assign(line_.frame().begin(), line_.frame().end());
            for (const auto& one : back_.received(with_checksum(answered_))) waiting_.push_back(one);
            continue;
        }
        if (!in_frame) return Heard::silence;
        const Found found = receiver_.silence();
        if (found == Found::broken) ++refused_;
        if (found == Found::broken) return Heard::broken;
        if (found == Found::rest) return Heard::rest;
    }
}

/// silence: it is used up.
modbus::ModbusPort::Heard ModbusLineWithBitErrors::of_what_has_come()
{
    using Found = modbus::FrameReceiver::Found;
    while (!waiting_.empty()) {
        const ::test::Character one = waiting_.front();
        waiting_.pop_front();
        const Found found = one.good ? receiver_.feed(one.octet) : receiver_.fault();
        if (found == Found::broken) {
            ++refused_;
            return Heard::broken;
        }
        if (found != Found::frame) continue;
        const Bytes given = receiver_.frame();
        if (!std::equal(given.begin(), given.end(), answered_.begin(), answered_.end())) ++taken_for_good_;
        return Heard::frame;
    }
    return Heard::silence;
}

void ModbusLineWithBitErrors::heal()
{
    there_.heal();
    back_.heal();
}

} // namespace dpslave::drive_line
