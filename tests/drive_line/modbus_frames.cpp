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
/// The receiver's rule for the end of what is no frame: 20 characters, at least 20 ms.
constexpr Time kLeastGap = 20ms;
constexpr int kGap = 20;
constexpr int kLongestFrame = 256;

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

std::uint16_t checksum(std::span<const std::uint8_t> octets)
{
    unsigned sum = 0xFFFF;
    for (const std::uint8_t octet : octets)
        for (unsigned bit = 0; bit < 8; ++bit) {
            const bool carries = ((sum ^ octet >> bit) & 1U) != 0;
            sum >>= 1U;
            if (carries) sum ^= 0xA001U;
        }
    return static_cast<std::uint16_t>(sum);
}

Octets with_checksum(Octets frame)
{
    const std::uint16_t sum = checksum(frame);
    frame.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
    frame.push_back(static_cast<std::uint8_t>(sum >> 8U));
    return frame;
}

bool ModbusFrames::send(std::uint8_t unit, Bytes pdu)
{
    pass_until(time);
    receiver_.sent(unit, pdu);
    Octets frame{unit};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    question_ = frame;
    if (traces())
        trace(fmt::format("{:.1f} ms: -> {:02X}", static_cast<double>(time.time_since_epoch().count()) / 1e6,
                          fmt::join(frame, " ")));
    const Octets whole = with_checksum(frame);
    const Instant ends = time + rules().character * static_cast<std::int64_t>(whole.size());
    question_on_the_wire(ends);
    if (rules().echo) {
        for (const std::uint8_t octet : whole) arrived_.push_back({octet, ends + rules().port_holds});
        wire_is_busy_until(ends);
    }
    for (std::size_t i = 0; i < drives.size(); ++i)
        if (drives[i].unit == unit) ask(i, frame, ends);
    return true;
}

/// As the program's own line does it (src/modbus/rtu_line.cpp), on the simulated clock.
modbus::ModbusPort::Heard ModbusFrames::receive(Instant until)
{
    const Time gap = std::max(kLeastGap, rules().character * kGap) + rules().port_holds;
    const Instant latest = until + rules().character * kLongestFrame + gap;
    for (;;) {
        if (const auto heard = take_arrived()) return *heard;
        const bool in_frame = receiver_.in_frame();
        const Instant end = in_frame ? std::min(time + gap, latest) : until;
        const Instant event = next_event();
        const Instant octet = arrived_.empty() ? kNever : arrived_.front().at;
        if (std::min(event, octet) <= end) {
            if (event <= octet)
                happen(event);
            else
                time = std::max(time, octet);
            continue;
        }
        time = std::max(time, end);
        if (!in_frame) return Heard::silence;
        const auto found = receiver_.silence();
        if (found == modbus::FrameReceiver::Found::broken) return Heard::broken;
        if (found == modbus::FrameReceiver::Found::rest) return Heard::rest;
    }
}

/// Of what can be read now; nothing: it is used up.
std::optional<modbus::ModbusPort::Heard> ModbusFrames::take_arrived()
{
    using Found = modbus::FrameReceiver::Found;
    while (!arrived_.empty() && arrived_.front().at <= time) {
        const std::uint8_t octet = arrived_.front().octet;
        arrived_.pop_front();
        std::int64_t behind = 0;
        for (const Arrived& one : arrived_)
            if (one.at <= time) ++behind;
        const Found found = receiver_.feed(octet, time - rules().character * behind);
        if (found == Found::frame) return Heard::frame;
        if (found == Found::broken) return Heard::broken;
    }
    return std::nullopt;
}

void ModbusFrames::heard(const Speech& speech, Instant begins)
{
    if (traces())
        trace(fmt::format("{:.1f} ms: <- {}{} {:02X}",
                          static_cast<double>(begins.time_since_epoch().count()) / 1e6,
                          speech.drive < 0 ? "noise" : fmt::format("drive {}", speech.drive),
                          speech.is_broken   ? ", broken"
                          : speech.is_twice  ? ", twice"
                          : speech.is_repeat ? ", again"
                                             : "",
                          fmt::join(speech.octets, " ")));
    const Octets whole = speech.is_broken ? speech.octets : with_checksum(speech.octets);
    const std::int64_t copies = speech.is_twice ? 2 : 1;
    const auto length = static_cast<std::int64_t>(whole.size());
    const Instant ends = begins + rules().character * copies * length;
    wire_is_busy_until(ends);
    for (std::int64_t i = 0; i < copies * length; ++i) {
        const Instant at = speech.is_twice ? ends : begins + rules().character * (i + 1); // of both together
        arrived_.push_back({whole[static_cast<std::size_t>(i % length)], at + rules().port_holds});
    }
}

// ---- what is no frame

/// No frame of a drive of this line with a right checksum lies in it, but in a longer one of a drive.
bool ModbusFrames::is_harmless(const Octets& noise) const
{
    const std::span<const std::uint8_t> all{noise};
    for (std::size_t from = 0; from < noise.size(); ++from)
        for (std::size_t length = 4; from + length <= noise.size(); ++length)
            if (checksum(all.subspan(from, length)) == 0) return false;
    return true;
}

/// Octets are flipped or lost, or it breaks off.
Octets ModbusFrames::spoilt(Octets answer)
{
    const Octets whole = with_checksum(std::move(answer));
    Octets broken = whole;
    const std::size_t place = kinds().below(whole.size());
    switch (kinds().below(3)) {
        case 0: broken[place] ^= static_cast<std::uint8_t>(1 + kinds().below(255)); break;
        case 1: broken.erase(broken.begin() + static_cast<std::ptrdiff_t>(place)); break;
        default: broken.resize(std::max<std::size_t>(place, 1)); break;
    }
    return is_harmless(broken) ? broken : Octets{0x00};
}

/// What looks like the answer to the last question and has a right checksum, inside a longer answer of its
/// drive that has a wrong one or breaks off. Its words were never held.
Octets ModbusFrames::false_frame()
{
    const std::uint8_t unit = question_[0], function = question_[1];
    Octets inner{unit, function};
    if (kinds().one_in(3)) {
        inner = {unit, static_cast<std::uint8_t>(function | 0x80U), 2};
    } else if (function == 3 || function == 4) {
        const unsigned count = word_at(question_, 4);
        inner.push_back(static_cast<std::uint8_t>(2 * count));
        for (unsigned i = 0; i < count; ++i) push_word(inner, words().take());
    } else {
        inner.insert(inner.end(), question_.begin() + 2, question_.begin() + 6);
    }
    inner = with_checksum(inner);
    if (inner.size() % 2 != 0) inner.push_back(0);
    Octets outer{unit, 3, static_cast<std::uint8_t>(inner.size() + 2)};
    push_word(outer, words().take());
    outer.insert(outer.end(), inner.begin(), inner.end());
    const std::uint16_t wrong = static_cast<std::uint16_t>(checksum(outer) ^ 0x0101U);
    outer.push_back(static_cast<std::uint8_t>(wrong & 0xFFU));
    outer.push_back(static_cast<std::uint8_t>(wrong >> 8U));
    if (kinds().one_in(3)) outer.resize(outer.size() - 1 - kinds().below(2));
    return outer;
}

Octets ModbusFrames::noise()
{
    Octets noise(1 + chance().below(8), 0xFF);
    switch (kinds().below(8)) {
        case 0: return noise;
        case 1: std::fill(noise.begin(), noise.end(), std::uint8_t{0}); return noise;
        case 2: return Octets{0xFE, 0xF0, 0x80, 0x00};
        case 3: return Octets(question_.begin(), question_.begin() + 2); // of an answer that breaks off
        case 4:
        case 5: return false_frame();
        default:
            for (std::uint8_t& octet : noise) octet = static_cast<std::uint8_t>(kinds().below(256));
            return is_harmless(noise) ? noise : Octets{0x00};
    }
}

std::optional<Octets> ModbusFrames::carry_out(std::size_t index, const SimulatedDrive::Question& question)
{
    if (question.is_spoilt) return std::nullopt; // a wrong checksum gets no answer
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
