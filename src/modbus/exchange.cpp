// SPDX-License-Identifier: Apache-2.0
#include "exchange.hpp"

#include "frame_receiver.hpp"
#include "pdu.hpp"

#include "dpslave/drive/wire_time.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::modbus {
namespace {

using namespace std::chrono_literals;
using drive::Form;
using Verdict = drive::OwedAnswers::Verdict;

constexpr std::string_view kNoAnswer = "no answer";

/// The octets around the part from the function code on: unit address before it, checksum after it.
constexpr std::size_t kFrame = 3;

/// Unit, function, and what else an answer shows: its length, of function 8 the two octets of our choice.
Form form_of(std::uint8_t unit, std::uint8_t function, std::size_t rest)
{
    return static_cast<Form>(unit) << 24 | static_cast<Form>(function) << 16 | static_cast<Form>(rest);
}

Form form_of_answer(std::uint8_t unit, Bytes pdu)
{
    if (pdu[0] == kLoopback && pdu.size() == 5) return form_of(unit, kLoopback, be16(pdu, 3));
    return form_of(unit, pdu[0], pdu.size());
}

std::chrono::nanoseconds characters(std::size_t count, const ClientSettings& settings)
{
    return std::chrono::nanoseconds{static_cast<std::int64_t>(count) * settings.bits_of_a_character *
                                    std::nano::den / settings.baud};
}

/// Returns the frame as it is on the wire.
ByteBuffer<kLongestFrame> framed(std::uint8_t unit, Bytes pdu)
{
    ByteBuffer<kLongestFrame> frame;
    frame.push(unit);
    frame.append(pdu);
    const std::uint16_t crc = crc16(frame);
    frame.push(low(crc));
    frame.push(high(crc));
    return frame;
}

/// If answers name the drive, none is accepted that may be older.
drive::Judgement judgement_of(Verdict verdict, Bytes pdu)
{
    if (verdict == Verdict::answer)
        return exception_of(pdu) ? drive::Judgement::refused : drive::Judgement::taken;
    if (verdict == Verdict::owed) return drive::Judgement::late;
    return verdict == Verdict::duplicate ? drive::Judgement::duplicate : drive::Judgement::foreign;
}

std::chrono::nanoseconds settle_of(const ClientSettings& settings)
{
    const auto settle = settings.rules.settle;
    return (settle.count() != 0 ? settle : 10 * std::chrono::nanoseconds{settings.timeout}) +
           settings.rules.hold_back;
}

} // namespace

ModbusClient::Exchange::Exchange(ModbusPort& line, ClientSettings settings)
    : line_(line),
      settings_(std::move(settings)),
      owed_(drive::OwedAnswers::Names::drive, settle_of(settings_)),
      echo_(settings_.rules.echo == EchoMode::off  ? Echo::none
            : settings_.rules.echo == EchoMode::on ? Echo::heard
                                                   : Echo::unknown),
      notes_(settings_.rules.frames, drive::LineProtocol::modbus_rtu, characters(1, settings_))
{}

std::chrono::nanoseconds ModbusClient::Exchange::duration_of(std::size_t count) const
{
    return characters(count, settings_);
}

/// 3.5 characters, beyond 19200 bit/s a fixed time (MODBUS over Serial Line V1.02, 2.5.1.1); and what the
/// port may still hold back.
std::chrono::nanoseconds ModbusClient::Exchange::pause() const
{
    const auto between = settings_.baud > 19'200 ? std::chrono::nanoseconds{1'750us} : duration_of(7) / 2;
    return std::max(between, settings_.rules.hold_back);
}

drive::Question ModbusClient::Exchange::question_of(std::uint8_t unit, Bytes request) const
{
    drive::Question question;
    question.drive = unit;
    question.answer = request[0] == kLoopback ? form_of_answer(unit, request)
                                              : form_of(unit, request[0], longest_answer(request));
    question.refusal = form_of(unit, request[0] | kIsException, 2);
    question.wire_time = duration_of(longest_answer(request) + kFrame);
    return question;
}

/// A question whose answer looks like its request is not asked until it is known whether there is an echo.
bool ModbusClient::Exchange::differs_from_echo(Bytes request) const
{
    return echo_ != Echo::unknown || (request[0] != kWriteRegister && request[0] != kLoopback);
}

bool ModbusClient::Exchange::may_ask(std::uint8_t unit, Bytes request, bool gave_data)
{
    const drive::Question question = question_of(unit, request);
    return differs_from_echo(request) && owed_.may_ask(question, line_.now()) &&
           (gave_data || !owed_.owes(unit, question.refusal));
}

bool ModbusClient::Exchange::ask(std::uint8_t unit, Bytes request)
{
    unit_ = unit;
    heard_unit_ = has_sent_ = false;
    if (!fall_silent()) return false;
    const drive::Question question = question_of(unit, request);
    const Instant begun = line_.now();
    if (!line_.send(unit, request)) {
        trouble_ = "the line does not accept the request";
        has_sent_ = line_.may_have_left();
        if (has_sent_) owed_.may_answer(question, line_.now());
        return false;
    }
    has_sent_ = true;
    notes_.sent(unit, framed(unit, request), begun);
    const Instant sent_at = drive::end_of_question(begun, line_.now(), duration_of(request.size() + kFrame));
    if (line_.takes_wire_time())
        owed_.asked(question, sent_at, drive::answers_from(begun, request.size() + kFrame, duration_of(1)));
    else
        owed_.asked(question, sent_at);
    echo_due_ = echo_ != Echo::none;
    const bool is_answered = wait(request, sent_at + settings_.timeout + question.wire_time);
    owed_.wait_is_over();
    return is_answered;
}

/// Without a pause a slave does not recognise the beginning of a request. Octets that are heard meanwhile are
/// judged. Returns false if octets keep coming for longer than two of the longest frames.
bool ModbusClient::Exchange::fall_silent()
{
    const Instant end = line_.now() + duration_of(2 * kLongestFrame) + 2 * pause();
    for (Instant now = line_.now(); now <= end; now = line_.now()) {
        switch (line_.receive(std::max(now, heard_at_ + pause()))) {
            case ModbusPort::Heard::frame:
                heard_at_ = line_.now();
                if (!refuse_early()) judge({}, line_.frame());
                break;
            case ModbusPort::Heard::broken: broken(); break;
            case ModbusPort::Heard::rest: note(drive::Judgement::no_frame); break;
            case ModbusPort::Heard::silence:
            case ModbusPort::Heard::gone: owed_.settle(line_.now()); return true;
        }
    }
    trouble_ = "noise and no answer: the line is never silent";
    return false;
}

bool ModbusClient::Exchange::wait(Bytes request, Instant until)
{
    trouble_ = kNoAnswer;
    for (Instant now = line_.now(); now < until; now = line_.now()) {
        switch (line_.receive(until)) {
            case ModbusPort::Heard::frame:
                heard_at_ = line_.now();
                if (!take_frame(request)) break;
                trouble_.clear();
                return true;
            case ModbusPort::Heard::broken:
                if (!broken()) break;
                trouble_ = "an answer with a wrong checksum or parity, or one that broke off";
                // Noise before the echo or the echo itself: the drive may have heard better. The next copy
                // counts as the echo; it cannot be proven to be the answer.
                if (echo_due_) break;
                return false;
            case ModbusPort::Heard::rest: note(drive::Judgement::no_frame); break;
            case ModbusPort::Heard::silence: notes_.no_answer(line_.now()); return false;
            case ModbusPort::Heard::gone: trouble_ = "the port has gone"; return false;
        }
    }
    notes_.no_answer(line_.now());
    owed_.wait_is_over();
    fall_silent(); // a frame took long, or this thread had no processor: what is in the port is late
    return false;
}

void ModbusClient::Exchange::note(drive::Judgement judgement)
{
    const ModbusPort::Piece piece = line_.piece();
    if (!piece.noise.empty()) {
        owed_.noise(unit_);
        notes_.received(piece.noise, piece.read_at - duration_of(piece.octets.size()));
        notes_.judge(drive::Judgement::noise_before);
    }
    notes_.received(piece.octets, piece.read_at);
    notes_.judge(judgement);
}

/// Returns false if it is noise, and the answer may still come.
bool ModbusClient::Exchange::broken()
{
    heard_at_ = line_.now();
    const drive::Judgement flaw = line_.piece().flaw;
    note(flaw);
    if (flaw == drive::Judgement::no_frame) {
        owed_.noise(unit_);
        if (trouble_ == kNoAnswer) trouble_ = "noise and no answer";
        return false;
    }
    owed_.damaged(unit_);
    return true;
}

/// Rule of time, of the frame heard last.
bool ModbusClient::Exchange::refuse_early()
{
    if (!owed_.is_too_early(line_.piece().begun)) return false;
    note(drive::Judgement::early);
    owed_.early(unit_);
    note_valid(line_.frame());
    return true;
}

/// Sign of life of a unit: whatever it answers, but nothing that a gateway says for it, nor what may be an
/// echo and answers nothing.
void ModbusClient::Exchange::note_valid(Bytes frame, bool answers_something)
{
    const Bytes pdu = frame.subspan(1);
    const bool gateway = pdu.size() == 2 && is_of_gateway(pdu[1]); // only an exception is that short
    const bool is_like_request = pdu[0] == kWriteRegister || pdu[0] == kLoopback;
    if (!gateway && (answers_something || !is_like_request)) owed_.valid(frame[0], line_.now());
}

/// The first copy of a request is its echo, a second one the answer (function 6, 8).
bool ModbusClient::Exchange::take_echo(Bytes request, Bytes frame)
{
    const bool is_copy = frame[0] == unit_ && std::ranges::equal(frame.subspan(1), request);
    if (is_copy && echo_ == Echo::unknown) echo_ = Echo::heard;
    const bool is_no_answer =
        longest_answer(request) != request.size() || owed_.is_too_early(line_.piece().begun);
    if (!is_copy || (!echo_due_ && !is_no_answer)) return false;
    if (echo_ == Echo::none) {
        trouble_ = "the line hears its own request: set echo = \"on\" for it";
        owed_.count_return(unit_);
    }
    echo_due_ = false;
    note(drive::Judgement::echo);
    return true;
}

bool ModbusClient::Exchange::take_frame(Bytes request)
{
    const Bytes frame = line_.frame();
    if (take_echo(request, frame) || refuse_early()) return false;
    const Bytes pdu = frame.subspan(1);
    const Verdict verdict = judge(request, frame);
    if (verdict == Verdict::answer) {
        if (echo_ == Echo::unknown) echo_ = Echo::none;
        answer_.assign(pdu.begin(), pdu.end());
        return true;
    }
    if (verdict == Verdict::foreign && trouble_ == kNoAnswer)
        trouble_ = frame[0] == unit_ ? "an answer that does not fit the request: " +
                                           hex(pdu.first(std::min<std::size_t>(pdu.size(), 5)))
                                     : "an answer of unit " + std::to_string(frame[0]);
    return false;
}

/// If a frame has the form of an answer to `request` the rest has to fit, too.
Verdict ModbusClient::Exchange::judge(Bytes request, Bytes frame)
{
    const Bytes pdu = frame.subspan(1);
    const Form form = form_of_answer(frame[0], pdu);
    const bool has_form = !request.empty() && form == question_of(unit_, request).answer;
    const Verdict verdict =
        has_form && !answers(request, pdu) ? Verdict::foreign : owed_.heard(form, frame, line_.now());
    note(judgement_of(verdict, pdu));
    if (verdict == Verdict::foreign) owed_.foreign(unit_);
    note_valid(frame, verdict == Verdict::answer || verdict == Verdict::owed);
    const bool gateway = pdu.size() == 2 && is_of_gateway(pdu[1]);
    if (frame[0] == unit_ && !gateway && verdict != Verdict::foreign) heard_unit_ = true;
    return verdict;
}

} // namespace dpslave::modbus
