// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/ei_ascii_client.hpp"

#include "digits.hpp"

#include <algorithm>
#include <array>

namespace dpslave::drive {
namespace {

using ei::Answer;
using ei::AnswerParser;

constexpr std::chrono::milliseconds kMinGap{
    20};                                   ///< between characters at 9600 (EI-ASCII reference, section 1)
constexpr std::size_t kGapCharacters = 20; ///< the same at lower rates
constexpr std::size_t kLongestAnswer = ei::kMaxAnswerText + 5; ///< STX C1 C2 text ETX BCC

std::string quoted(ei::Mnemonic mnemonic)
{
    return {'\'', mnemonic[0], mnemonic[1], '\''};
}

AccessError error_of(ei::ValueFlaw flaw)
{
    return flaw == ei::ValueFlaw::out_of_span ? AccessError::out_of_range : AccessError::unsupported_type;
}

std::optional<std::uint16_t> word_of(const Answer& answer)
{
    if (answer.kind != Answer::Kind::value) return std::nullopt;
    const auto word = ei::decode_word(answer.text);
    if (!word) return std::nullopt;
    return *word;
}

std::pair<std::uint16_t, std::uint16_t> key(UnitAddress unit, std::uint16_t tag)
{
    return {static_cast<std::uint16_t>(unit.group << 8 | unit.unit), tag};
}

} // namespace

EiAsciiClient::EiAsciiClient(SerialLine& line, EiTiming timing, std::vector<EiUnit> units)
    : line_(line), timing_(timing), units_(std::move(units))
{
    timing_.baud = std::max<std::uint32_t>(timing_.baud, 1);
}

std::chrono::nanoseconds EiAsciiClient::duration_of(std::size_t characters) const
{
    return std::chrono::nanoseconds{
        static_cast<std::int64_t>(characters * 10 * std::uint64_t{1'000'000'000} / timing_.baud)};
}

MnemonicRule EiAsciiClient::rule_of(UnitAddress unit) const
{
    const auto at =
        std::find_if(units_.begin(), units_.end(), [unit](const EiUnit& u) { return u.address == unit; });
    return at == units_.end() ? MnemonicRule::none : at->mnemonics;
}

/// After this silence a drive has no more to say.
std::chrono::nanoseconds EiAsciiClient::gap() const
{
    return std::max<std::chrono::nanoseconds>(kMinGap, duration_of(kGapCharacters));
}

/// Lets pass what still comes, for the time of two answers at most: a line that babbles on is left to the
/// next request.
void EiAsciiClient::drain()
{
    const Instant end = line_.now() + duration_of(2 * kLongestAnswer) + gap();
    std::array<std::uint8_t, 64> waste{};
    for (Instant now = line_.now(); now < end; now = line_.now())
        if (line_.read(waste, std::min(gap(), end - now)) == 0) return;
}

/// One request and its answer; nothing when none came that can be believed (trouble_ says why). The answer
/// has to begin within the time-out and to end within the time of the longest one, whatever comes on the
/// line.
std::optional<Answer> EiAsciiClient::exchange(const ei::Frame& request, AnswerParser::To kind)
{
    line_.discard();
    if (!line_.write(request)) {
        trouble_ = "the line does not take the request";
        return std::nullopt;
    }
    // write() need not have waited for the wire
    const Instant begins = line_.now() + duration_of(request.size()) + timing_.timeout;
    const Instant ends = begins + duration_of(kLongestAnswer) + gap();
    AnswerParser parser{kind};
    auto status = AnswerParser::Status::more;
    std::array<std::uint8_t, 64> buffer{};
    for (bool noise = false; status == AnswerParser::Status::more; noise = !parser.started()) {
        const Instant now = line_.now();
        const Instant until = parser.started() ? std::min(now + gap(), ends) : begins;
        const std::size_t got = now < until ? line_.read(buffer, until - now) : 0;
        if (got == 0) {
            trouble_ = noise               ? "noise and no answer"
                       : !parser.started() ? "no answer"
                       : until < ends      ? "the answer broke off"
                                           : std::string{ei::text(ei::Flaw::too_long)};
            return std::nullopt;
        }
        for (std::size_t i = 0; i < got && status != AnswerParser::Status::broken; ++i)
            status = parser.feed(buffer[i]);
    }
    if (status == AnswerParser::Status::complete) return parser.answer();
    trouble_ = ei::text(parser.flaw());
    drain();
    return std::nullopt;
}

/// A poll whose answer, where it is a value, names the mnemonic that was asked for.
std::optional<Answer> EiAsciiClient::poll(UnitAddress unit, ei::Mnemonic mnemonic)
{
    auto answer = exchange(ei::poll(unit, mnemonic), AnswerParser::To::poll);
    if (answer && answer->kind == Answer::Kind::value && answer->mnemonic != mnemonic) {
        trouble_ = "asked for " + quoted(mnemonic) + ", answered for " + quoted(answer->mnemonic);
        drain();
        return std::nullopt;
    }
    return answer;
}

/// After a NAK. EE is read before anything else changes it.
AccessError EiAsciiClient::refused(UnitAddress unit, bool is_write)
{
    const auto answer = poll(unit, ei::kLastError);
    if (!answer) {
        trouble_ = "NAK, and EE could not be read";
        return AccessError::no_answer;
    }
    const auto ee = word_of(*answer);
    if (!ee) {
        trouble_ = "NAK, and the drive has no EE that says why";
        return AccessError::not_understood;
    }
    trouble_ = "NAK, EE " + hex_text(*ee, 4) + " (" + std::string{ei::meaning_of_ee(*ee)} + ")";
    return ei::error_of_ee(*ee, is_write);
}

/// After an EOT on a poll: the drive has no such parameter, unless EE says that it can only be written. An
/// EOT without a drive that answers for EE was noise: one bad octet must not turn an input into 0.
AccessError EiAsciiClient::unknown_parameter(UnitAddress unit, const Tag& tag)
{
    const auto answer = poll(unit, ei::kLastError);
    const auto ee = answer ? word_of(*answer) : std::nullopt;
    if (!answer) {
        trouble_ = "an EOT, but no answer for EE behind it: noise";
        return AccessError::no_answer;
    }
    const bool write_only = ee && high(*ee) == 0x04;
    trouble_ = "the drive knows no tag " + std::to_string(tag.number) + " (EOT)";
    if (write_only)
        trouble_ = "EOT, EE " + hex_text(*ee, 4) + " (" + std::string{ei::meaning_of_ee(*ee)} + ")";
    return write_only ? AccessError::unsupported_type : AccessError::invalid_tag;
}

/// The mnemonic of the tag; nothing and a word for the log if there is none.
std::optional<ei::Mnemonic> EiAsciiClient::mnemonic_for(UnitAddress unit, const Tag& tag)
{
    const auto mnemonic = mnemonic_of(tag, rule_of(unit));
    if (!mnemonic)
        trouble_ = "no mnemonic for tag " + std::to_string(tag.number) +
                   ": neither in the tag table nor by the rule";
    return mnemonic;
}

AccessError EiAsciiClient::read(UnitAddress unit, const Tag& tag, std::span<std::uint16_t> words)
{
    trouble_.clear();
    if (words.size() != 1 || tag.type == TagType::string) {
        trouble_ = words.size() != 1 ? "EI-ASCII reads one tag at a time" : "a STRING is not transported";
        return AccessError::unsupported_type;
    }
    const auto mnemonic = mnemonic_for(unit, tag);
    if (!mnemonic) return AccessError::invalid_tag;
    const auto answer = poll(unit, *mnemonic);
    if (!answer) return AccessError::no_answer;
    switch (answer->kind) {
        case Answer::Kind::eot: return unknown_parameter(unit, tag);
        case Answer::Kind::value: return take_value(unit, tag, answer->text, words[0]);
        case Answer::Kind::nak:
        case Answer::Kind::ack: break;
    }
    return refused(unit, false);
}

AccessError EiAsciiClient::take_value(UnitAddress unit, const Tag& tag, const std::string& text,
                                      std::uint16_t& word)
{
    if (!tag.listed) return take_unlisted(unit, tag, text, word);
    const auto value = ei::decode_value(tag, text);
    if (value) {
        word = *value;
        return AccessError::none;
    }
    trouble_ = "tag " + std::to_string(tag.number) + " (" + std::string{drive::text(tag.type)} + ", " +
               std::to_string(tag.decimals) + " decimals) answers '" + text +
               "': " + std::string{ei::text(value.error())};
    return error_of(value.error());
}

/// A tag that is in no table: '>' makes it a WORD; one number does not show how many decimals it has.
AccessError EiAsciiClient::take_unlisted(UnitAddress unit, const Tag& tag, const std::string& text,
                                         std::uint16_t& word)
{
    if (const auto value = ei::decode_word(text)) {
        words_.insert(key(unit, tag.number));
        word = *value;
        return AccessError::none;
    }
    words_.erase(key(unit, tag.number));
    const std::string number = std::to_string(tag.number);
    trouble_ = "tag " + number + " is in no tag table and answers '" + text +
               "', which does not show its decimals; the table needs a line with tag=" + number +
               " and its name, type and decimals";
    return AccessError::invalid_tag;
}

AccessError EiAsciiClient::write(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t> words)
{
    trouble_.clear();
    if (words.size() != 1) {
        trouble_ = "EI-ASCII writes one tag at a time";
        return AccessError::unsupported_type;
    }
    const std::uint16_t word = words[0];
    if (!tag.listed && words_.count(key(unit, tag.number)) == 0) {
        std::uint16_t present = 0;
        const AccessError error = read(unit, tag, {&present, 1});
        if (error != AccessError::none) return error;
    }
    const auto mnemonic = mnemonic_for(unit, tag);
    if (!mnemonic) return AccessError::invalid_tag;
    const auto enums = rule_of(unit) == MnemonicRule::ac ? ei::EnumForm::decimal : ei::EnumForm::hexadecimal;
    const auto text = ei::encode_value(tag, word, enums);
    if (!text) {
        trouble_ = hex_text(word, 4) + " as " + std::string{drive::text(tag.type)} + ": " +
                   std::string{ei::text(text.error())};
        return error_of(text.error());
    }
    const auto answer = exchange(ei::select(unit, *mnemonic, *text), AnswerParser::To::select);
    if (!answer) return AccessError::no_answer;
    return answer->kind == Answer::Kind::ack ? AccessError::none : refused(unit, true);
}

bool EiAsciiClient::probe(UnitAddress unit)
{
    trouble_.clear();
    return poll(unit, ei::kIdentity).has_value();
}

} // namespace dpslave::drive
