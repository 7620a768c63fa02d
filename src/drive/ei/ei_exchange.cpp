// SPDX-License-Identifier: Apache-2.0
#include "ei_exchange.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace dpslave::drive::ei {
namespace {

using Verdict = OwedAnswers::Verdict;

constexpr std::chrono::milliseconds kMinGap{
    20};                                   ///< between characters at 9600 (EI-ASCII reference, section 1)
constexpr std::size_t kGapCharacters = 20; ///< the same at lower rates
constexpr std::size_t kLongestAnswer = kMaxAnswerText + 5; ///< STX C1 C2 text ETX BCC
constexpr std::size_t kPortHolds = 4096;                   ///< octets that were not read yet
constexpr std::size_t kUsualAnswer = 13; ///< fixed width: the length that an owed answer may have

std::string quoted(Mnemonic mnemonic)
{
    return {'\'', mnemonic[0], mnemonic[1], '\''};
}

Form form_of(Mnemonic mnemonic)
{
    return static_cast<Form>(static_cast<std::uint8_t>(mnemonic[0]) << 8 |
                             static_cast<std::uint8_t>(mnemonic[1]));
}

/// The noise of a transceiver that turns round.
bool is_noise(char octet)
{
    return octet == '\0' || octet == '\x7F' || octet == '\xFF';
}

/// EI-ASCII has a parity bit: an octet with a fault in it comes as 00.
Judgement judgement_of(Flaw flaw)
{
    switch (flaw) {
        case Flaw::none: return Judgement::truncated;
        case Flaw::bad_bcc: return Judgement::bad_checksum;
        case Flaw::bad_text: return Judgement::bad_character;
        case Flaw::unexpected_start:
        case Flaw::too_long:
        case Flaw::octets_after: break;
    }
    return Judgement::no_frame;
}

Judgement judgement_of(Verdict verdict)
{
    switch (verdict) {
        case Verdict::answer: return Judgement::taken;
        case Verdict::answer_or_older: return Judgement::older;
        case Verdict::before_write: return Judgement::before_write;
        case Verdict::owed: return Judgement::late;
        case Verdict::duplicate: return Judgement::duplicate;
        case Verdict::foreign: break;
    }
    return Judgement::foreign;
}

std::chrono::nanoseconds characters(std::size_t count, std::uint32_t baud)
{
    return std::chrono::nanoseconds{
        static_cast<std::int64_t>(count * 10 * std::uint64_t{1'000'000'000} / baud)};
}

std::chrono::nanoseconds settle_of(const EiTiming& timing)
{
    const auto settle = timing.rules.settle;
    return (settle.count() != 0 ? settle : 10 * std::chrono::nanoseconds{timing.timeout}) +
           timing.rules.hold_back;
}

} // namespace

DriveNumber number_of(UnitAddress unit)
{
    return static_cast<DriveNumber>(unit.group << 8 | unit.unit);
}

void EchoFilter::sent(Bytes request)
{
    if (mode_ != EchoMode::off) expected_.assign(request.begin(), request.end());
    matched_ = 0;
}

bool EchoFilter::feed(std::uint8_t octet, std::string& out)
{
    const char c = static_cast<char>(octet);
    if (expected_.empty()) {
        out += c;
    } else if (c != expected_[matched_]) {
        silence(out);
        out += c;
    } else if (++matched_ == expected_.size()) {
        echo_ = std::exchange(expected_, {});
        matched_ = 0;
        return true;
    }
    return false;
}

void EchoFilter::silence(std::string& out)
{
    out.append(expected_, 0, matched_);
    expected_.clear();
    matched_ = 0;
}

void EchoWatch::sent(Bytes request)
{
    before_ = std::exchange(last_, std::string{request.begin(), request.end()});
}

bool EchoWatch::feed(std::uint8_t octet)
{
    heard_ += static_cast<char>(octet);
    const std::size_t longest = std::max(last_.size(), before_.size());
    heard_.erase(0, heard_.size() - std::min(heard_.size(), longest));
    const auto is_back = [this](const std::string& request) {
        return !request.empty() && heard_.ends_with(request);
    };
    return is_back(last_) || is_back(before_);
}

Exchange::Exchange(SerialLine& line, EiTiming timing)
    : line_(line),
      timing_(timing),
      owed_(OwedAnswers::Names::tag, settle_of(timing)),
      echo_(timing.rules.echo),
      notes_(timing.rules.frames, LineProtocol::ei_ascii, characters(1, timing.baud)),
      begin_(characters(1, timing.baud))
{}

std::chrono::nanoseconds Exchange::duration_of(std::size_t count) const
{
    return ei::characters(count, timing_.baud);
}

/// Returns the silence after which a drive does not continue its answer.
std::chrono::nanoseconds Exchange::gap() const
{
    return std::max<std::chrono::nanoseconds>(kMinGap, duration_of(kGapCharacters)) + timing_.rules.hold_back;
}

bool Exchange::may_poll(UnitAddress unit, Mnemonic mnemonic)
{
    return owed_.may_ask({.drive = number_of(unit), .answer = form_of(mnemonic)}, line_.now());
}

bool Exchange::owes(UnitAddress unit, Mnemonic mnemonic) const
{
    return owed_.owes(number_of(unit), form_of(mnemonic));
}

bool Exchange::is_owed(Mnemonic mnemonic) const
{
    return owed_.is_owed(form_of(mnemonic));
}

AnswerCounts Exchange::counts(UnitAddress unit) const
{
    return owed_.counts(number_of(unit));
}

Exchange::End Exchange::poll(UnitAddress unit, Mnemonic mnemonic)
{
    Question question;
    question.drive = number_of(unit);
    question.answer = form_of(mnemonic);
    question.wire_time = duration_of(kUsualAnswer);
    asked_for_ = mnemonic;
    if (!owed_.may_ask(question, line_.now())) fall_silent(); // the owed answer may have come
    if (owed_.may_ask(question, line_.now())) return ask(question, ei::poll(unit, mnemonic), WaitsFor::value);
    trouble_ = "another drive of the line still owes an answer with " + quoted(mnemonic);
    return End::not_asked;
}

Exchange::End Exchange::select(UnitAddress unit, Mnemonic mnemonic, std::string_view text)
{
    Question question;
    question.drive = number_of(unit);
    question.is_write = true;
    question.written = form_of(mnemonic);
    question.wire_time = duration_of(1);
    return ask(question, ei::select(unit, mnemonic, text), WaitsFor::ack);
}

Exchange::End Exchange::ask(const Question& question, Bytes request, WaitsFor what)
{
    trouble_.clear();
    has_sent_ = false;
    if (!fall_silent()) {
        trouble_ = "noise and no answer: the line is never silent";
        return End::damaged;
    }
    asked_ = question.drive; // what came until now was of the one before
    const Instant begun = line_.now();
    if (!line_.write(request)) {
        trouble_ = "the line does not accept the request";
        has_sent_ = line_.may_have_left();
        if (has_sent_) owed_.may_answer(question, line_.now());
        return End::silence;
    }
    has_sent_ = true;
    notes_.sent(static_cast<std::uint8_t>(question.drive >> 4 | (question.drive & 0xF)), request, begun);
    const Instant sent_at = end_of_question(begun, line_.now(), duration_of(request.size()));
    if (line_.takes_wire_time())
        owed_.asked(question, sent_at, answers_from(begun, request.size(), duration_of(1)));
    else
        owed_.asked(question, sent_at);
    echo_.sent(request);
    echo_watch_.sent(request);
    const End end = wait(sent_at + timing_.timeout, what);
    owed_.wait_is_over();
    return end;
}

/// The answer has to begin within the timeout and to end within the time of the longest one, whatever comes
/// on the line.
Exchange::End Exchange::wait(Instant begins_by, WaitsFor what)
{
    const Instant ends_by = begins_by + duration_of(kLongestAnswer) + gap();
    std::array<std::uint8_t, 64> buffer{};
    std::string octets;
    std::size_t late = 0; // octets
    for (bool noise = false;; noise = true) {
        const Instant now = line_.now();
        const Instant until = in_frame() ? std::min(now + gap(), ends_by) : begins_by;
        if (now >= until) { // this thread had no processor: what waits in the port is late
            owed_.wait_is_over();
            what = WaitsFor::nothing;
        }
        const std::size_t got =
            late < kPortHolds ? line_.read(buffer, std::max<std::chrono::nanoseconds>(until - now, {})) : 0;
        if (what == WaitsFor::nothing) late += got;
        octets.clear();
        if (got != 0)
            hear(Bytes{buffer}.first(got), octets);
        else if (echo_.withholds())
            echo_.silence(octets);
        if (const auto end = take(octets, what)) return *end;
        if (got != 0 || !octets.empty()) continue;
        if (parser_) return *broken(until < ends_by ? Flaw::none : Flaw::too_long, WaitsFor::value);
        notes_.no_answer(line_.now());
        if (trouble_.empty()) trouble_ = noise ? "noise and no answer" : "no answer";
        return End::silence;
    }
}

/// Lets pass what still comes, for the time of two answers at most, and until the port cannot hold back
/// anything. Returns false if octets keep coming.
bool Exchange::fall_silent()
{
    const Instant end = line_.now() + duration_of(2 * kLongestAnswer) + gap();
    std::array<std::uint8_t, 64> buffer{};
    std::string octets;
    for (Instant now = line_.now(); now <= end; now = line_.now()) {
        const auto pause = in_frame() ? gap() : timing_.rules.hold_back;
        const auto rest = std::max<std::chrono::nanoseconds>(heard_at_ + pause - now, {});
        const std::size_t got = line_.read(buffer, rest);
        octets.clear();
        if (got != 0)
            hear(Bytes{buffer}.first(got), octets);
        else
            echo_.silence(octets);
        take(octets, WaitsFor::nothing);
        if (got != 0) continue;
        parser_.reset();
        skips_ = false;
        heard_noise_ = false;
        notes_.silence();
        owed_.settle(line_.now()); // everything that has come is judged
        return true;
    }
    return false;
}

/// Appends what is no echo.
void Exchange::hear(Bytes octets, std::string& out)
{
    heard_at_ = line_.now();
    for (const std::uint8_t octet : octets) {
        if (echo_.feed(octet, out)) {
            notes_.received(echo_.echo(), heard_at_);
            notes_.judge(Judgement::echo);
        }
        if (timing_.rules.echo == EchoMode::off && echo_watch_.feed(octet)) owed_.count_return(asked_);
    }
}

std::optional<Exchange::End> Exchange::take(std::string_view octets, WaitsFor what)
{
    std::optional<End> end;
    std::size_t i = 0;
    for (; i < octets.size() && !skips_; ++i) {
        if (!parser_ && !is_noise(octets[i])) {
            if (heard_noise_)
                notes_.judge(Judgement::noise_before);
            else
                notes_.silence();
            parser_.emplace(octets[i] == kAck ? AnswerParser::To::select : AnswerParser::To::poll);
            begin_ = FrameBegin{duration_of(1)};
        }
        notes_.received(bytes_of(octets.substr(i, 1)), heard_at_);
        heard_noise_ = heard_noise_ || !parser_;
        if (!parser_) continue;
        begin_.octet(heard_at_, octets.size() - i - 1);
        const auto status = parser_->feed(static_cast<std::uint8_t>(octets[i]));
        if (status == AnswerParser::Status::more) continue;
        const std::string_view rest = octets.substr(i + 1);
        const bool is_alone = std::all_of(rest.begin(), rest.end(), is_noise);
        const AnswerParser done = *parser_;
        parser_.reset();
        const auto ended = status == AnswerParser::Status::broken ? broken(done.flaw(), what)
                                                                  : take_frame(done.answer(), is_alone, what);
        if (!ended) continue;
        end = ended;
        what = WaitsFor::nothing; // octets after it are judged as if they came later
    }
    notes_.received(bytes_of(octets.substr(i)), heard_at_);
    return end;
}

/// Rule of time. The wait goes on.
bool Exchange::refuse_early()
{
    if (!owed_.is_too_early(begin_.latest())) return false;
    notes_.judge(Judgement::early);
    owed_.early(asked_);
    return true;
}

std::optional<Exchange::End> Exchange::take_frame(const Answer& frame, bool is_alone, WaitsFor what)
{
    if (std::exchange(heard_noise_, false)) owed_.noise(asked_);
    if (refuse_early()) return std::nullopt;
    if (frame.kind == Answer::Kind::value) return take_value(frame, what);
    if (what == WaitsFor::nothing) {
        notes_.judge(Judgement::unclear);
        return std::nullopt;
    }
    const bool fits =
        frame.kind == Answer::Kind::nak || (frame.kind == Answer::Kind::ack) == (what == WaitsFor::ack);
    if (!fits) { // of an older question, or of none
        notes_.judge(Judgement::foreign);
        owed_.foreign(asked_);
        return std::nullopt;
    }
    if (!is_alone) return broken(Flaw::octets_after, what); // it may be a part of something else
    if (frame.kind != Answer::Kind::ack) {
        notes_.judge(Judgement::refused);
        return End::refused;
    }
    const bool is_taken = owed_.take_ack();
    notes_.judge(is_taken ? Judgement::taken : Judgement::doubtful);
    return is_taken ? End::ack : End::doubtful;
}

std::optional<Exchange::End> Exchange::take_value(const Answer& frame, WaitsFor what)
{
    const Verdict verdict = owed_.heard(form_of(frame.mnemonic), bytes_of(frame.text), line_.now());
    notes_.judge(judgement_of(verdict));
    const auto taken = [&](End end) {
        answer_ = frame.text;
        trouble_.clear();
        return end;
    };
    if (verdict == Verdict::answer) return taken(End::value);
    if (verdict == Verdict::answer_or_older) return taken(End::older);
    if (verdict == Verdict::before_write) return taken(End::before);
    if (verdict == Verdict::foreign) owed_.foreign(asked_);
    if (what == WaitsFor::value)
        trouble_ = "asked for " + quoted(asked_for_) + ", answered for " + quoted(frame.mnemonic);
    return std::nullopt;
}

std::optional<Exchange::End> Exchange::broken(Flaw flaw, WaitsFor what)
{
    skips_ = flaw != Flaw::none;
    parser_.reset();
    if (skips_)
        notes_.judge_until_silence(judgement_of(flaw));
    else
        notes_.judge(judgement_of(flaw));
    owed_.damaged(asked_);
    if (flaw == Flaw::bad_bcc) owed_.bad_checksum(asked_);
    if (what == WaitsFor::nothing) return std::nullopt;
    trouble_ = flaw == Flaw::none ? "the answer broke off" : std::string{text(flaw)};
    return End::damaged;
}

} // namespace dpslave::drive::ei
