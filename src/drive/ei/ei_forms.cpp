// SPDX-License-Identifier: Apache-2.0
#include "ei_forms.hpp"

#include "drive/digits.hpp"
#include "ei_exchange.hpp"

#include "dpslave/drive/ei_ascii.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

/// True if the answer decides the type, whatever the row says.
bool is_open(const Tag& tag)
{
    return !tag.listed || !has_scale(tag);
}

AccessError error_of(ei::ValueFlaw flaw)
{
    if (flaw == ei::ValueFlaw::too_many_decimals) return AccessError::contradicted;
    return flaw == ei::ValueFlaw::out_of_span ? AccessError::does_not_fit : AccessError::unsupported_type;
}

/// Digits, a point at most, a sign at most.
bool is_number(std::string_view text)
{
    text = trimmed(text);
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    const auto points = std::count(text.begin(), text.end(), '.');
    const auto digits = std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    return points <= 1 && digits > 0 && static_cast<std::size_t>(points + digits) == text.size();
}

/// The caller names the tag.
std::string answers(std::string_view text)
{
    return "it answers '" + std::string{text} + "'";
}

std::string decimals_of(const Tag& tag)
{
    return std::to_string(tag.decimals) + (tag.decimals == 1 ? " decimal" : " decimals");
}

/// Returns why the row and the answer do not fit together.
std::string misfit(const Tag& tag, std::string_view text, ei::ValueFlaw flaw)
{
    const std::string row =
        tag.listed ? "its row says " + std::string{drive::text(tag.type)} + ", " + decimals_of(tag)
                   : "unlisted_decimals gives " + decimals_of(tag);
    std::string what = answers(text) + ", but " + row + ": " + std::string{ei::text(flaw)};
    if (flaw == ei::ValueFlaw::too_many_decimals)
        what += "; the tag is refused until the table is corrected and loaded again";
    return what;
}

/// A number without a scale, and what gives it one.
std::string no_scale(const Tag& tag, std::string_view text)
{
    if (!tag.listed)
        return answers(text) +
               " and is in no tag table: its decimals are not known; add a row with type and decimals, or set unlisted_decimals of the station";
    if (!tag.confirmed)
        return answers(text) +
               ", and its row is not confirmed: compare the row with the drive's manual, then set confirmed to yes";
    return answers(text) + ", and its row has no decimals: fill in column decimals";
}

} // namespace

EiForms::Key EiForms::key(UnitAddress unit, const Tag& tag)
{
    return {ei::number_of(unit), tag.number};
}

EiForms::Taken EiForms::take(UnitAddress unit, const Tag& tag, std::string_view text)
{
    if (is_open(tag)) return take_open(unit, tag, text);
    const auto value = ei::decode_value(tag, text);
    if (value) return {AccessError::none, *value, {}};
    return {error_of(value.error()), 0, misfit(tag, text, value.error())};
}

EiForms::Taken EiForms::take_open(UnitAddress unit, const Tag& tag, std::string_view text)
{
    if (const auto word = ei::decode_word(text)) {
        seen_.insert_or_assign(key(unit, tag), Form::word);
        return {AccessError::none, *word, {}};
    }
    seen_.erase(key(unit, tag));
    if (!has_scale(tag) && is_number(text)) return {AccessError::no_scale, 0, no_scale(tag, text)};
    if (!has_scale(tag))
        return {AccessError::unsupported_type, 0, answers(text) + ", which is neither number nor word"};
    const auto value = ei::decode_value(tag, text);
    if (!value) return {error_of(value.error()), 0, misfit(tag, text, value.error())};
    seen_.insert_or_assign(key(unit, tag), Form::number);
    return {AccessError::none, *value, {}};
}

bool EiForms::must_be_read(UnitAddress unit, const Tag& tag) const
{
    return is_open(tag) && seen_.count(key(unit, tag)) == 0;
}

bool EiForms::is_word(UnitAddress unit, const Tag& tag) const
{
    const auto at = seen_.find(key(unit, tag));
    return is_open(tag) && at != seen_.end() && at->second == Form::word;
}

void EiForms::forget(UnitAddress unit)
{
    const std::uint16_t gone = key(unit, {}).first;
    for (auto at = seen_.lower_bound({gone, 0}); at != seen_.end() && at->first.first == gone;)
        at = seen_.erase(at);
}

} // namespace dpslave::drive
