// SPDX-License-Identifier: Apache-2.0
#include "drive_tags.hpp"

#include "transactions.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace dpslave::drive {

namespace {

std::string words_of(const ScaleFault& fault)
{
    return std::to_string(fault.tag) + " is " + std::to_string(fault.word);
}

} // namespace

std::span<const LayoutEntry> parameters_of(const Layout& layout)
{
    return std::span{layout.parameters}.first(std::min<std::size_t>(layout.count, kMaxParameters));
}

/// Only the row of the table has the reason (EI-ASCII reference, section 4).
AccessError with_reason(const Transaction& transaction, AccessError error)
{
    if (!is_write(transaction) || transaction.words.size() != 1) return error;
    const Tag& tag = *transaction.tag;
    const bool may_be = error == AccessError::read_only ||
                        (error == AccessError::out_of_range && is_within_limits(tag, transaction.words[0]));
    if (!may_be) return error;
    switch (tag.when) {
        case WritableWhen::not_said: break;
        case WritableWhen::stopped: return AccessError::not_stopped;
        case WritableWhen::configuration: return AccessError::not_config_mode;
    }
    return error;
}

DriveTags::DriveTags(const DriveSettings& unit)
    : table_(unit.tags),
      only_from_table_(unit.tags_only_from_table),
      compare_outputs_(unit.compare_outputs),
      scale_from_table_(unit.scale_from_table),
      asks_outputs_(unit.denied_holds != DeniedHold::never),
      unlisted_decimals_(unit.scale_from_table ? unit.unlisted_decimals : std::nullopt),
      never_written_(unit.never_written),
      watched_(unit.watched),
      scale_registers_(unit.scale_registers),
      scales_(unit.scale_registers)
{
    if (watched_.size() > kMaxWatched) watched_.resize(kMaxWatched);
}

const Tag* DriveTags::row(std::uint16_t number)
{
    if (const Tag* row = table_ != nullptr ? table_->find(number) : nullptr) return row;
    const Tag made = unlisted_decimals_ ? unlisted_tag(number, *unlisted_decimals_) : unlisted_tag(number);
    return &unlisted_.try_emplace(number, made).first->second;
}

void DriveTags::keep_contradicted(DriveTags& before)
{
    for (const std::uint16_t number : before.contradicted_)
        if (is_same_value(*before.row(number), *row(number))) contradict(number);
}

AccessError DriveTags::verdict(const Tag& row, bool is_write) const
{
    const bool never =
        std::find(never_written_.begin(), never_written_.end(), row.number) != never_written_.end();
    if (is_write && never) return AccessError::read_only;
    if (!row.listed && only_from_table_) return AccessError::invalid_tag;
    if (row.type == TagType::string) return AccessError::unsupported_type;
    if (is_contradicted(row.number)) return AccessError::contradicted;
    if (scales_.contradicts(row)) return AccessError::no_scale;
    if (is_write && row.access == Access::read_only) return AccessError::read_only;
    if (!is_write && row.access == Access::write_only) return AccessError::unsupported_type;
    return AccessError::none;
}

DriveParameter DriveTags::record(std::uint16_t number, std::uint8_t uses)
{
    DriveParameter made;
    made.row = row(number);
    Reading& reading = made.reading;
    reading.uses = uses;
    reading.unscaled = scale_from_table_ && !has_scale(*made.row);
    if (const AccessError error = verdict(*made.row, false); error != AccessError::none) {
        reading.refuse(error);
        reading.tried = true;
        if (const auto fault = scales_.fault(); fault && error == AccessError::no_scale)
            reading.answer = answer_text(words_of(*fault));
    }
    return made;
}

bool DriveTags::depends_on_scales(const Layout& layout)
{
    return std::ranges::any_of(parameters_of(layout), [this](const LayoutEntry& parameter) {
        const Tag* const chosen = row(parameter.tag);
        return std::ranges::any_of(scale_registers_, [&](const auto& reg) { return concerns(reg, *chosen); });
    });
}

Writing DriveTags::output(const Tag& row, std::size_t place) const
{
    Writing writing;
    writing.is_output = true;
    writing.parameter = place;
    if (const AccessError error = verdict(row, true); error != AccessError::none)
        writing.refuse(error);
    else
        writing.readable = compare_outputs_ && !row.once && verdict(row, false) == AccessError::none;
    return writing;
}

/// If outputs are compared or count, only the last of several with the same tag is written: two words for one
/// parameter would be written over each other for ever.
ParameterSet DriveTags::parameters(const Layout& layout)
{
    std::vector<DriveParameter> uses;
    const std::span<const LayoutEntry> chosen = parameters_of(layout);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const LayoutEntry& parameter = chosen[i];
        DriveParameter made = record(parameter.tag, parameter.reads ? std::uint8_t{kInput} : std::uint8_t{0});
        if (parameter.writes) {
            made.writing = output(*made.row, i);
            if (asks_outputs_) made.reading.uses |= kAsked;
            if (made.reading.asked && made.writing.asked) {
                if (made.writing.readable) made.reading.uses |= kCompared;
                if (made.reading.unscaled) made.reading.uses |= kForm;
            }
            for (DriveParameter& other : uses)
                if ((compare_outputs_ || made.row->once) && made.writing.asked && other.row == made.row &&
                    other.writing.is_output)
                    other.writing.refuse(AccessError::not_understood);
        }
        if (parameter.reads || parameter.writes) uses.push_back(made);
    }
    for (const std::uint16_t tag : watched_) uses.push_back(record(tag, kWatched));
    return ParameterSet{std::move(uses)};
}

} // namespace dpslave::drive
