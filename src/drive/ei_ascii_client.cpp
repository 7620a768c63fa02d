// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/ei_ascii_client.hpp"

#include "digits.hpp"
#include "ei_access.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

AccessError error_of(ei::ValueFlaw flaw)
{
    return flaw == ei::ValueFlaw::out_of_span ? AccessError::out_of_range : AccessError::unsupported_type;
}

std::pair<std::uint16_t, std::uint16_t> key(UnitAddress unit, std::uint16_t tag)
{
    return {static_cast<std::uint16_t>(unit.group << 8 | unit.unit), tag};
}

bool holds(const Tag& tag, const std::string& text, std::uint16_t word)
{
    const auto held = tag.listed ? ei::decode_value(tag, text) : ei::decode_word(text);
    return held && *held == word;
}

} // namespace

EiAsciiClient::EiAsciiClient(SerialLine& line, EiTiming timing, std::vector<EiUnit> units)
    : access_(std::make_unique<ei::Access>(line, timing)), units_(std::move(units))
{}

EiAsciiClient::~EiAsciiClient() = default;

AnswerCounts EiAsciiClient::counts(UnitAddress unit) const
{
    return access_->counts(unit);
}

MnemonicRule EiAsciiClient::rule_of(UnitAddress unit) const
{
    const auto at =
        std::find_if(units_.begin(), units_.end(), [unit](const EiUnit& u) { return u.address == unit; });
    return at == units_.end() ? MnemonicRule::none : at->mnemonics;
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
    const AccessError error = access_->read(unit, *mnemonic);
    if (error == AccessError::none) return take_value(unit, tag, access_->text(), words[0]);
    trouble_ = access_->trouble();
    if (error == AccessError::invalid_tag)
        trouble_ = "the drive knows no tag " + std::to_string(tag.number) + ": " + trouble_;
    return error;
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
    const AccessError error = access_->write(unit, *mnemonic, *text);
    if (error == AccessError::deferred && access_->read_back() && holds(tag, *access_->read_back(), word))
        return AccessError::none;
    trouble_ = access_->trouble();
    return error;
}

bool EiAsciiClient::probe(UnitAddress unit)
{
    const bool answers = access_->probe(unit);
    trouble_ = answers ? std::string{} : access_->trouble();
    return answers;
}

} // namespace dpslave::drive
