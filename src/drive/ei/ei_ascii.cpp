// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/ei_ascii.hpp"

namespace dpslave::drive::ei {
namespace {

constexpr std::string_view kHexDigits = "0123456789ABCDEF";

std::uint8_t octet(char c)
{
    return static_cast<std::uint8_t>(c);
}

void begin(Frame& frame, UnitAddress unit)
{
    const std::uint8_t group = octet(kHexDigits[unit.group & 15]);
    const std::uint8_t id = octet(kHexDigits[unit.unit & 15]);
    frame.push(kEot); // every slave takes EOT as a reset, whatever it was doing
    frame.push(group);
    frame.push(group);
    frame.push(id);
    frame.push(id);
}

} // namespace

std::uint8_t bcc(Bytes after_stx)
{
    std::uint8_t sum = 0;
    for (const std::uint8_t o : after_stx) sum = static_cast<std::uint8_t>(sum ^ o);
    return sum;
}

Frame poll(UnitAddress unit, Mnemonic mnemonic)
{
    Frame frame;
    begin(frame, unit);
    frame.push(octet(mnemonic[0]));
    frame.push(octet(mnemonic[1]));
    frame.push(kEnq);
    return frame;
}

Frame select(UnitAddress unit, Mnemonic mnemonic, std::string_view text)
{
    Frame frame;
    begin(frame, unit);
    frame.push(kStx);
    const std::size_t covered = frame.size();
    frame.push(octet(mnemonic[0]));
    frame.push(octet(mnemonic[1]));
    for (const char c : text.substr(0, kMaxText)) frame.push(octet(c));
    frame.push(kEtx);
    frame.push(bcc(frame.bytes().subspan(covered)));
    return frame;
}

std::string_view text(Flaw flaw) noexcept
{
    switch (flaw) {
        case Flaw::none: return "no flaw";
        case Flaw::unexpected_start:
            return "an answer that begins with no STX, EOT, ACK or NAK, or with the wrong one";
        case Flaw::bad_text: return "a character inside the answer that is not allowed there";
        case Flaw::too_long: return "an answer that does not end";
        case Flaw::bad_bcc: return "a wrong BCC";
        case Flaw::octets_after: return "characters directly after an EOT, ACK or NAK";
    }
    return "?";
}

AnswerParser::Status AnswerParser::broken(Flaw flaw)
{
    flaw_ = flaw;
    state_ = State::end;
    return Status::broken;
}

AnswerParser::Status AnswerParser::single(Answer::Kind kind)
{
    answer_.kind = kind;
    state_ = State::end;
    return Status::complete;
}

AnswerParser::Status AnswerParser::on_start(std::uint8_t octet)
{
    switch (octet) {
        case 0x00:
        case 0x7F:
        case 0xFF: return Status::more;
        case kNak: return single(Answer::Kind::nak);
        case kAck: return request_ == To::select ? single(Answer::Kind::ack) : broken(Flaw::unexpected_start);
        case kEot: return request_ == To::poll ? single(Answer::Kind::eot) : broken(Flaw::unexpected_start);
        case kStx:
            if (request_ != To::poll) return broken(Flaw::unexpected_start);
            answer_.kind = Answer::Kind::value;
            state_ = State::first_letter;
            return Status::more;
        default: return broken(Flaw::unexpected_start);
    }
}

/// Judges the octets after a finished answer. A frame with its BCC is complete; one lone octet could be a
/// part of something else.
AnswerParser::Status AnswerParser::on_end(std::uint8_t octet)
{
    if (flaw_ != Flaw::none) return Status::broken;
    const bool noise = octet == 0x00 || octet == 0x7F || octet == 0xFF;
    return answer_.kind == Answer::Kind::value || noise ? Status::complete : broken(Flaw::octets_after);
}

AnswerParser::Status AnswerParser::feed(std::uint8_t octet)
{
    if (state_ == State::start) return on_start(octet);
    if (state_ == State::end) return on_end(octet);
    if (state_ == State::bcc) {
        state_ = State::end;
        if (octet != sum_) return broken(Flaw::bad_bcc);
        return Status::complete;
    }
    sum_ = static_cast<std::uint8_t>(sum_ ^ octet);
    if (octet == kEtx && state_ == State::text) {
        state_ = State::bcc;
        return Status::more;
    }
    if (octet < 0x20 || octet > 0x7E) return broken(Flaw::bad_text);
    const char c = static_cast<char>(octet);
    if (state_ == State::first_letter) {
        answer_.mnemonic[0] = c;
        state_ = State::second_letter;
    } else if (state_ == State::second_letter) {
        answer_.mnemonic[1] = c;
        state_ = State::text;
    } else if (answer_.text.size() == kMaxAnswerText) {
        return broken(Flaw::too_long);
    } else {
        answer_.text += c;
    }
    return Status::more;
}

AccessError error_of_ee(std::uint16_t ee, bool is_write)
{
    switch (high(ee)) {
        case 0x01: return AccessError::invalid_tag;
        case 0x02:
        case 0x03: return AccessError::not_understood;
        case 0x04: return AccessError::unsupported_type;
        case 0x05: return AccessError::read_only;
        case 0x07: return low(ee) == 0xC8 ? AccessError::value_not_encoded : AccessError::not_understood;
        case 0x08: return AccessError::out_of_range;
        default: return is_write ? AccessError::read_only : AccessError::not_understood;
    }
}

std::string_view meaning_of_ee(std::uint16_t ee) noexcept
{
    switch (high(ee)) {
        case 0x00: return "no error";
        case 0x01: return "invalid mnemonic";
        case 0x02: return "checksum (BCC) error";
        case 0x03: return "framing or overrun error";
        case 0x04: return "read of a write-only parameter";
        case 0x05: return "write to a read-only parameter";
        case 0x07: return low(ee) == 0xC8 ? "invalid data" : "invalid message format";
        case 0x08: return "data out of range";
        default: return "no meaning known";
    }
}

} // namespace dpslave::drive::ei
