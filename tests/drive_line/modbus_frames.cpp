// SPDX-License-Identifier: Apache-2.0
#include "modbus_frames.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace dpslave::drive_line {
namespace {

constexpr unsigned kIeeeArea = 0x8000;
constexpr std::size_t kCheckSum = 2; ///< octets that a frame has on the wire beside those given here

unsigned word_at(const Octets& octets, std::size_t at)
{
    return static_cast<unsigned>(octets[at] << 8U | octets[at + 1]);
}

void push_word(Octets& octets, unsigned word)
{
    octets.push_back(static_cast<std::uint8_t>(word >> 8U));
    octets.push_back(static_cast<std::uint8_t>(word & 0xFFU));
}

Octets refusal(std::uint8_t function, std::uint8_t code)
{
    return {static_cast<std::uint8_t>(function | 0x80U), code};
}

/// The scaled integer of a tag as the single of its value.
std::uint32_t single_of(const SimulatedTag& tag)
{
    double value = static_cast<std::int16_t>(tag.now().word);
    for (unsigned i = 0; i < tag.decimals; ++i) value /= 10.0;
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

std::uint16_t word_of_single(const SimulatedTag& tag, std::uint32_t bits)
{
    double value = std::bit_cast<float>(bits);
    for (unsigned i = 0; i < tag.decimals; ++i) value *= 10.0;
    return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(value)));
}

} // namespace

bool ModbusFrames::send(std::uint8_t unit, Bytes pdu)
{
    pass_until(time);
    Octets frame{unit};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    const Instant ends = time + rules().character * static_cast<std::int64_t>(frame.size() + kCheckSum);
    if (traces())
        trace(fmt::format("{:.1f} ms: -> {:02X}", static_cast<double>(time.time_since_epoch().count()) / 1e6,
                          fmt::join(frame, " ")));
    if (rules().echo) {
        arrived_.push_back({frame, ends + rules().port_holds, false});
        wire_is_busy_until(ends);
    }
    for (std::size_t i = 0; i < drives.size(); ++i)
        if (drives[i].unit == unit) ask(i, frame, ends);
    return true;
}

modbus::FrameLine::Heard ModbusFrames::receive(Instant until)
{
    for (;;) {
        const Instant event = next_event();
        const Instant frame = arrived_.empty() ? kNever : arrived_.front().at;
        if (std::min(event, frame) > until) break;
        if (event <= frame) {
            happen(event);
            continue;
        }
        time = std::max(time, frame);
        frame_ = std::move(arrived_.front().octets);
        const bool is_broken = arrived_.front().is_broken;
        arrived_.pop_front();
        return is_broken ? Heard::broken : Heard::frame;
    }
    time = std::max(time, until);
    return Heard::silence;
}

void ModbusFrames::heard(const Speech& speech, Instant begins)
{
    if (traces())
        trace(fmt::format("{:.1f} ms: <- {}{} {:02X}",
                          static_cast<double>(begins.time_since_epoch().count()) / 1e6,
                          speech.drive < 0 ? "noise" : fmt::format("drive {}", speech.drive),
                          speech.is_broken  ? ", broken"
                          : speech.is_twice ? ", twice"
                                            : "",
                          fmt::join(speech.octets, " ")));
    const std::int64_t copies = speech.is_twice ? 2 : 1;
    const Instant ends =
        begins + rules().character * copies * static_cast<std::int64_t>(speech.octets.size() + kCheckSum);
    wire_is_busy_until(ends);
    for (std::int64_t i = 0; i < copies; ++i)
        arrived_.push_back({speech.octets, ends + rules().port_holds, speech.is_broken});
}

std::optional<Octets> ModbusFrames::carry_out(std::size_t index, const SimulatedDrive::Question& question)
{
    if (question.is_spoilt) return std::nullopt; // a wrong check sum gets no answer
    const Octets pdu(question.octets.begin() + 1, question.octets.end());
    Octets answer;
    switch (pdu[0]) {
        case 3:
        case 4: answer = read(index, pdu[0], word_at(pdu, 1), word_at(pdu, 3)); break;
        case 6:
            answer = write_one(index, word_at(pdu, 1), static_cast<std::uint16_t>(word_at(pdu, 3)),
                               question.carried_out);
            break;
        case 8:
            if (!drives[index].has_loopback || word_at(pdu, 1) != 0) return std::nullopt;
            answer = pdu;
            break;
        case 16: answer = write_many(index, pdu, question.carried_out); break;
        default: return std::nullopt;
    }
    answer.insert(answer.begin(), question.octets[0]);
    return answer;
}

Octets ModbusFrames::read(std::size_t index, std::uint8_t function, unsigned first, unsigned count)
{
    SimulatedDrive& drive = drives[index];
    Octets answer{function, static_cast<std::uint8_t>(2 * count)};
    if (first >= kIeeeArea) {
        SimulatedTag* const tag = drive.find(static_cast<std::uint16_t>((first - kIeeeArea) / 2));
        if (tag == nullptr || tag->now().denied || first % 2 != 0 || count != 2) return refusal(function, 2);
        const std::uint32_t bits = single_of(*tag);
        push_word(answer, bits >> 16U);
        push_word(answer, bits & 0xFFFFU);
        return answer;
    }
    for (unsigned number = first; number < first + count; ++number) {
        const SimulatedTag* const tag = drive.find(static_cast<std::uint16_t>(number));
        if (tag == nullptr || tag->now().denied) return refusal(function, 2);
        push_word(answer, tag->now().word);
    }
    return answer;
}

Octets ModbusFrames::write_one(std::size_t index, unsigned reg, std::uint16_t word, Instant at)
{
    SimulatedTag* const tag = drives[index].find(static_cast<std::uint16_t>(reg));
    if (tag == nullptr || tag->now().denied || tag->is_ieee) return refusal(6, 2);
    if (tag->read_only || tag->refuses) return refusal(6, 3);
    written(index, *tag, word, at);
    Octets answer{6};
    push_word(answer, reg);
    push_word(answer, word);
    return answer;
}

/// A register that is not there is passed over in silence; the first that is refused ends it.
Octets ModbusFrames::write_many(std::size_t index, const Octets& pdu, Instant at)
{
    const unsigned first = word_at(pdu, 1), count = word_at(pdu, 3);
    SimulatedDrive& drive = drives[index];
    const bool is_ieee = first >= kIeeeArea;
    for (unsigned i = 0; i < count; i += is_ieee ? 2 : 1) {
        const unsigned number = is_ieee ? (first + i - kIeeeArea) / 2 : first + i;
        SimulatedTag* const tag = drive.find(static_cast<std::uint16_t>(number));
        if (tag == nullptr || tag->now().denied) continue;
        if (tag->read_only || tag->refuses) return refusal(16, 3);
        const unsigned word = word_at(pdu, 6 + 2 * i);
        written(index, *tag,
                is_ieee ? word_of_single(*tag, word << 16U | word_at(pdu, 8 + 2 * i))
                        : static_cast<std::uint16_t>(word),
                at);
    }
    Octets answer{16};
    push_word(answer, first);
    push_word(answer, count);
    return answer;
}

} // namespace dpslave::drive_line
