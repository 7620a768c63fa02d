// SPDX-License-Identifier: Apache-2.0
/// Answers of EI-ASCII drives: the frame, the text of a value, and the client on a line where anything comes
/// at any time. Judged: a value is only taken from a frame that was heard whole, with this mnemonic and a
/// right BCC, and is the number that its text says; a write counts only where an ACK or a frame that shows
/// the value was heard; a call ends in its time.
#include "dpslave/drive/ei_ascii.hpp"

#include "input.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace dpslave;
using namespace std::chrono_literals;
using drive::Tag;
using drive::TagType;
using drive::UnitAddress;
using fuzz::demand;
using std::chrono::nanoseconds;

/// What a text says, read by another hand: counts with so many decimals, or 16 bits in hexadecimal.
struct Said {
    bool hexadecimal = false;
    bool negative = false;
    std::string digits; ///< without the point
    std::size_t behind = 0;
};

std::optional<Said> said(std::string text)
{
    while (!text.empty() && text.front() == ' ') text.erase(0, 1);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    Said it;
    if (!text.empty() && text[0] == '>') {
        it.hexadecimal = true;
        it.digits = text.substr(1);
        if (it.digits.empty() || it.digits.size() > 4 ||
            it.digits.find_first_not_of("0123456789ABCDEFabcdef") != std::string::npos)
            return std::nullopt;
        return it;
    }
    if (!text.empty() && (text[0] == '-' || text[0] == '+')) {
        it.negative = text[0] == '-';
        text.erase(0, 1);
    }
    const auto point = text.find('.');
    if (point != std::string::npos) {
        it.behind = text.size() - point - 1;
        text.erase(point, 1);
    }
    it.digits = text;
    if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
    return it;
}

/// The counts that a text has with `decimals`; none: it is no such number, or beyond 10 digits.
std::optional<long long> counts_of(const Said& it, unsigned decimals)
{
    if (it.hexadecimal || it.behind > decimals) return std::nullopt;
    std::string digits = it.digits + std::string(decimals - it.behind, '0');
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
    if (digits.size() > 10) return std::nullopt;
    const long long counts = std::stoll(digits);
    return it.negative ? -counts : counts;
}

/// Is `word` what `text` says of `tag`?
bool says(const Tag& tag, const std::string& text, std::uint16_t word)
{
    const auto it = said(text);
    if (!it) return false;
    if (it->hexadecimal) return tag.type != TagType::number && std::stoul(it->digits, nullptr, 16) == word;
    if (tag.type == TagType::word) return false;
    const auto counts = counts_of(*it, tag.type == TagType::number ? tag.decimals : 0u);
    if (!counts) return false;
    const bool is_signed = tag.type == TagType::number && !tag.is_unsigned;
    return *counts == (is_signed ? static_cast<long long>(static_cast<std::int16_t>(word)) : word);
}

Tag row_of(fuzz::Input& input)
{
    constexpr std::array types{TagType::number, TagType::word, TagType::boolean, TagType::enumeration};
    const std::uint8_t kind = input.octet();
    Tag tag;
    tag.number = kind % 3 == 0 ? 1 : 7;
    tag.type = types[kind % types.size()];
    tag.decimals = tag.type == TagType::number ? input.octet() % 5 : std::uint8_t{0};
    tag.is_unsigned = tag.type == TagType::number && (kind & 0x80) != 0;
    return tag;
}

/// Characters of which answers are made; a few others among them.
std::string text_of(fuzz::Input& input)
{
    std::string text;
    for (const std::uint8_t octet : input.octets(input.octet() % 16))
        text += "0123456789.->+ ABCDEFabcdefz~\x01"[octet % 30];
    return text;
}

std::string covered(std::string between)
{
    between += '\x03';
    char sum = 0;
    for (const char c : between) sum = static_cast<char>(sum ^ c);
    return between + sum;
}

/// All whole frames that stand anywhere in `heard`: STX, two letters, text, ETX, and the octet that fits.
std::vector<std::pair<std::string, std::string>> frames_in(const std::string& heard)
{
    std::vector<std::pair<std::string, std::string>> frames;
    for (std::size_t at = 0; at + 5 <= heard.size(); ++at) {
        if (heard[at] != '\x02') continue;
        const std::size_t end = heard.find('\x03', at + 3);
        if (end == std::string::npos || end + 1 >= heard.size()) continue;
        const std::string between = heard.substr(at + 1, end - at - 1);
        if (covered(between).back() != heard[end + 1]) continue;
        frames.emplace_back(between.substr(0, 2), between.substr(2));
    }
    return frames;
}

void judge_text(fuzz::Input& input)
{
    const Tag tag = row_of(input);
    const std::uint16_t word = input.word();
    for (const auto form : {drive::ei::EnumForm::hexadecimal, drive::ei::EnumForm::decimal})
        if (const auto text = drive::ei::encode_value(tag, word, form)) {
            demand(says(tag, *text, word), "a value is sent as it is");
            demand(text->size() <= drive::ei::kMaxText, "a value has its length");
        }
    const std::string text = text_of(input);
    if (const auto read = drive::ei::decode_value(tag, text))
        demand(says(tag, text, *read), "a value is read as it stands");
    if (const auto read = drive::ei::decode_word(text)) {
        const auto it = said(text);
        demand(it && it->hexadecimal && std::stoul(it->digits, nullptr, 16) == *read,
               "a word is hexadecimal");
    }
}

void judge_frame(fuzz::Input& input)
{
    using drive::ei::AnswerParser;
    const bool polled = input.octet() % 2 == 0;
    AnswerParser parser{polled ? AnswerParser::To::poll : AnswerParser::To::select};
    const bool framed = input.octet() % 2 == 0;
    const auto octets = input.octets(120);
    std::string heard{octets.begin(), octets.end()};
    if (framed) heard = "\x02" + covered(heard);
    for (std::size_t at = 0; at < heard.size(); ++at) {
        const auto status = parser.feed(static_cast<std::uint8_t>(heard[at]));
        if (status == AnswerParser::Status::more) continue;
        if (status == AnswerParser::Status::broken) {
            demand(parser.flaw() != drive::ei::Flaw::none, "what is broken has its flaw");
            return;
        }
        const auto& answer = parser.answer();
        using Kind = drive::ei::Answer::Kind;
        if (answer.kind == Kind::value) {
            const auto frames = frames_in(heard.substr(0, at + 1));
            const std::string mnemonic{answer.mnemonic.begin(), answer.mnemonic.end()};
            demand(polled && !frames.empty() && frames.front().first == mnemonic &&
                       frames.front().second == answer.text,
                   "an answer is what was heard");
        } else {
            const char single = heard[at];
            demand(single == (answer.kind == Kind::ack   ? '\x06'
                              : answer.kind == Kind::nak ? '\x15'
                                                         : '\x04'),
                   "a single character is what was heard");
            demand(answer.kind != Kind::ack || !polled, "an ACK answers no poll");
        }
        return;
    }
}

/// The other end: what it says to each request comes from the input. Time passes only here.
class Line final : public drive::SerialLine {
public:
    explicit Line(fuzz::Input& input) : input_(input) {}

    std::string heard; ///< what the client was given since the begin of its call
    int requests = 0;

    Instant now() const override { return now_; }
    bool write(Bytes octets) override
    {
        ++requests;
        const std::string request{octets.begin(), octets.end()};
        now_ += kCharacter * static_cast<int>(octets.size());
        if (input_.at_end()) return true;
        const std::uint8_t form = input_.octet();
        says(answer_to(request, form & 15), std::chrono::milliseconds{10} * (form >> 4) * (form >> 4));
        return (form & 15) != 15;
    }
    std::size_t read(std::span<std::uint8_t> into, nanoseconds timeout) override
    {
        if (pending_.empty() || pending_.front().second > now_ + timeout) {
            now_ += timeout;
            return 0;
        }
        now_ = std::max(now_, pending_.front().second);
        std::size_t got = 0;
        for (; got < into.size() && !pending_.empty() && pending_.front().second <= now_; ++got) {
            into[got] = pending_.front().first;
            heard += static_cast<char>(into[got]);
            pending_.pop_front();
        }
        return got;
    }
    void discard() override
    {
        while (!pending_.empty() && pending_.front().second <= now_) pending_.pop_front();
    }
    void pass(nanoseconds time) { now_ += time; }

private:
    static constexpr nanoseconds kCharacter{10'000'000'000 / 9600};

    std::string answer_to(const std::string& request, int form)
    {
        const bool is_poll = request.back() == '\x05';
        const std::string asked = is_poll ? request.substr(5, 2) : request.substr(6, 2);
        switch (form) {
            case 0: return {};
            case 1: return "\x06";
            case 2: return "\x15";
            case 3: return "\x04";
            case 4: return "\x02" + covered("EE>0" + std::string(1, "123578"[input_.octet() % 6]) + "C8");
            case 5: return "\x02" + covered("XX" + text_of(input_));
            case 6: {
                std::string spoilt = "\x02" + covered(asked + text_of(input_));
                spoilt[input_.octet() % spoilt.size()] ^= static_cast<char>(1 << input_.octet() % 7);
                return spoilt;
            }
            case 7: {
                const auto raw = input_.octets(input_.octet() % 32);
                return {raw.begin(), raw.end()};
            }
            case 8: return request;
            case 9:
                return "\x02" + covered(asked + text_of(input_)) + "\x02" + covered(asked + text_of(input_));
            case 10: return "\x06\x02" + covered(asked + text_of(input_));
            default: return "\x02" + covered(asked + text_of(input_));
        }
    }
    void says(const std::string& octets, nanoseconds after)
    {
        Instant at = now_ + after;
        if (!pending_.empty()) at = std::max(at, pending_.back().second);
        for (const char c : octets) pending_.emplace_back(static_cast<std::uint8_t>(c), at += kCharacter);
    }

    fuzz::Input& input_;
    Instant now_{std::chrono::seconds{100}};
    std::deque<std::pair<std::uint8_t, Instant>> pending_;
};

/// A frame heard in this call shows `word` as the value of `mnemonic`.
bool was_shown(const std::string& heard, const std::string& mnemonic, const Tag& tag, std::uint16_t word)
{
    return std::ranges::any_of(frames_in(heard), [&](const auto& frame) {
        return frame.first == mnemonic && says(tag, frame.second, word);
    });
}

void judge_client(fuzz::Input& input)
{
    constexpr auto kLongest =
        10s; // some exchanges of 200 ms and the line that has to fall silent before them
    const std::uint8_t mode = input.octet();
    Line line{input};
    const drive::EiTiming timing{
        .baud = 9600,
        .timeout = 200ms,
        .rules = {.settle = 0ns, .hold_back = 0ns, .echo = static_cast<EchoMode>(mode % 3)}};
    drive::EiAsciiClient client{line, timing, {{{0, 0}}, {{0, 1}}}};
    for (int calls = 0; calls < 24 && !input.at_end(); ++calls) {
        const std::uint8_t what = input.octet();
        const UnitAddress unit{0, static_cast<std::uint8_t>(what >> 4 & 1)};
        Tag tag = row_of(input);
        tag.mnemonic = tag.number == 1 ? "aa" : "ab";
        const Instant began = line.now();
        line.heard.clear();
        line.requests = 0;
        std::uint16_t word = input.word();
        switch (what % 4) {
            case 0:
            case 1:
                if (client.read(unit, tag, {&word, 1}) == AccessError::none)
                    demand(was_shown(line.heard, tag.mnemonic, tag, word),
                           "a value that is read stands in a frame that was heard");
                break;
            case 2:
                if (client.write(unit, tag, std::array{word}) == AccessError::none) {
                    demand(line.requests > 0, "a write that counts was sent");
                    demand(line.heard.find('\x06') != std::string::npos ||
                               was_shown(line.heard, tag.mnemonic, tag, word),
                           "a write that counts has its ACK or is shown");
                }
                break;
            default:
                if (client.probe(unit) == AccessError::none)
                    demand(!frames_in(line.heard).empty(), "a drive that is there was heard");
                break;
        }
        demand(line.now() - began < kLongest, "a call ends");
        line.pass(std::chrono::milliseconds{(what & 0x0C) * 40});
        if ((what & 0x20) != 0) client.listen();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Input input{data, size};
    switch (input.octet() % 4) {
        case 0: judge_text(input); break;
        case 1: judge_frame(input); break;
        default: judge_client(input); break;
    }
    return 0;
}
