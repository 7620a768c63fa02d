// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/ei_ascii_client.hpp"

#include "drive/digits.hpp"
#include "ei_access.hpp"
#include "ei_forms.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

/// The drive holds `word`: `text` is what it has answered when it was read back.
bool holds(EiForms& forms, UnitAddress unit, const Tag& tag, std::string_view text, std::uint16_t word)
{
    const EiForms::Taken held = forms.take(unit, tag, text);
    return held.error == AccessError::none && held.word == word;
}

} // namespace

EiAsciiClient::EiAsciiClient(SerialLine& line, EiTiming timing, std::vector<EiDrive> units)
    : access_(std::make_unique<ei::Access>(line, timing)),
      units_(std::move(units)),
      forms_(std::make_unique<EiForms>())
{}

EiAsciiClient::~EiAsciiClient() = default;

void EiAsciiClient::set_units(std::vector<EiDrive> units)
{
    units_ = std::move(units);
    forms_->forget_all();
}

AnswerCounts EiAsciiClient::counts(UnitAddress unit) const
{
    return access_->counts(unit);
}

void EiAsciiClient::listen()
{
    access_->listen();
}

MnemonicRule EiAsciiClient::rule_of(UnitAddress unit) const
{
    const auto at =
        std::find_if(units_.begin(), units_.end(), [unit](const EiDrive& u) { return u.address == unit; });
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
    answer_.clear();
    asked_before_ = access_->asked();
    if (words.size() != 1 || tag.type == TagType::string) {
        trouble_ = words.size() != 1 ? "EI-ASCII reads one tag at a time" : "a STRING is not transported";
        return AccessError::unsupported_type;
    }
    const auto mnemonic = mnemonic_for(unit, tag);
    if (!mnemonic) {
        answer_ = "no mnemonic";
        return AccessError::invalid_tag;
    }
    const AccessError error = access_->read(unit, *mnemonic);
    if (error == AccessError::none) return take_value(unit, tag, access_->value().text, words[0]);
    trouble_ = access_->trouble();
    if (error == AccessError::invalid_tag) {
        answer_ = "EE " + hex_text(access_->ee(), 4);
        trouble_ = "the drive knows no tag " + std::to_string(tag.number) + ": " + trouble_;
    }
    return error;
}

AccessError EiAsciiClient::take_value(UnitAddress unit, const Tag& tag, const std::string& text,
                                      std::uint16_t& word)
{
    answer_ = text;
    EiForms::Taken taken = forms_->take(unit, tag, text);
    if (taken.error == AccessError::none) {
        word = taken.word;
        return taken.error;
    }
    trouble_ = std::move(taken.trouble);
    return taken.error;
}

AccessError EiAsciiClient::write(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t> words)
{
    trouble_.clear();
    if (words.size() != 1) {
        trouble_ = "EI-ASCII writes one tag at a time";
        return AccessError::unsupported_type;
    }
    return write_word(unit, tag, words[0], false);
}

AccessError EiAsciiClient::write_once(UnitAddress unit, const Tag& tag,
                                      std::span<const std::uint16_t, 1> word)
{
    trouble_.clear();
    return write_word(unit, tag, word[0], true);
}

AccessError EiAsciiClient::write_word(UnitAddress unit, const Tag& tag, std::uint16_t word, bool once)
{
    has_sent_ = false;
    asked_before_ = access_->asked();
    if (forms_->must_be_read(unit, tag)) {
        std::uint16_t present = 0;
        const AccessError error = read(unit, tag, {&present, 1});
        if (error != AccessError::none) return error;
    }
    const auto mnemonic = mnemonic_for(unit, tag);
    if (!mnemonic) return AccessError::invalid_tag;
    const auto enums = rule_of(unit) == MnemonicRule::ac ? ei::EnumForm::decimal : ei::EnumForm::hexadecimal;
    const auto text =
        ei::encode_value(forms_->is_word(unit, tag) ? unlisted_tag(tag.number) : tag, word, enums);
    if (!text) {
        trouble_ = hex_text(word, 4) + " as " + std::string{drive::text(tag.type)} + ": " +
                   std::string{ei::text(text.error())};
        return text.error() == ei::ValueFlaw::out_of_span ? AccessError::out_of_range
                                                          : AccessError::unsupported_type;
    }
    const AccessError error = access_->write(unit, *mnemonic, *text, once);
    has_sent_ = access_->has_written();
    if (error == AccessError::deferred && access_->read_back() &&
        holds(*forms_, unit, tag, *access_->read_back(), word))
        return AccessError::none;
    trouble_ = access_->trouble();
    return error;
}

bool EiAsciiClient::may_be_older() const
{
    return access_->value().may_be_older;
}

unsigned EiAsciiClient::questions() const
{
    return access_->asked() - asked_before_;
}

AccessError EiAsciiClient::probe(UnitAddress unit)
{
    asked_before_ = access_->asked();
    forms_->forget(unit); // a lost drive is probed before anything else: it may be another one
    const AccessError error = access_->probe(unit);
    trouble_ = error == AccessError::none ? std::string{} : access_->trouble();
    return error;
}

Sight EiAsciiClient::look(UnitAddress unit, const Look& what)
{
    Sight sight = access_->look(unit, what.mnemonic);
    trouble_ = access_->trouble();
    return sight;
}

} // namespace dpslave::drive
