// SPDX-License-Identifier: Apache-2.0
#include "unit_tags.hpp"

#include <algorithm>

namespace dpslave::drive {

std::span<const Parameter> parameters_of(const Layout& layout)
{
    return std::span{layout.parameters}.first(std::min<std::size_t>(layout.count, kMaxParameters));
}

UnitTags::UnitTags(const UnitSettings& unit)
    : table_(unit.tags),
      only_from_table_(unit.tags_only_from_table),
      compare_outputs_(unit.compare_outputs),
      scale_from_table_(unit.scale_from_table),
      unlisted_decimals_(unit.scale_from_table ? unit.unlisted_decimals : std::nullopt),
      never_written_(unit.never_written),
      watched_(unit.watched)
{
    if (watched_.size() > kMaxWatched) watched_.resize(kMaxWatched);
}

const Tag* UnitTags::row(std::uint16_t number)
{
    if (const Tag* row = table_ != nullptr ? table_->find(number) : nullptr) return row;
    const Tag made = unlisted_decimals_ ? unlisted_tag(number, *unlisted_decimals_) : unlisted_tag(number);
    return &unlisted_.try_emplace(number, made).first->second;
}

void UnitTags::keep_contradicted(UnitTags& before)
{
    for (const std::uint16_t number : before.contradicted_)
        if (is_same_value(*before.row(number), *row(number))) contradict(number);
}

AccessError UnitTags::verdict(const Tag& row, bool is_write) const
{
    const bool never =
        std::find(never_written_.begin(), never_written_.end(), row.number) != never_written_.end();
    if (is_write && never) return AccessError::read_only;
    if (!row.listed && only_from_table_) return AccessError::invalid_tag;
    if (row.type == TagType::string) return AccessError::unsupported_type;
    if (is_contradicted(row.number)) return AccessError::contradicted;
    if (is_write && row.access == Access::read_only) return AccessError::read_only;
    if (!is_write && row.access == Access::write_only) return AccessError::unsupported_type;
    return AccessError::none;
}

ReadPlan::Item UnitTags::read_item(std::uint16_t number)
{
    ReadPlan::Item item;
    item.row = row(number);
    item.error = verdict(*item.row, false);
    item.asked = item.error == AccessError::none;
    item.tried = !item.asked;
    item.unscaled = scale_from_table_ && !has_scale(*item.row);
    if (!item.asked) item.state = state_of(item.error);
    return item;
}

std::vector<ReadPlan::Item> UnitTags::reads_of(const Layout& layout)
{
    std::vector<ReadPlan::Item> items;
    for (const Parameter& parameter : parameters_of(layout)) {
        ReadPlan::Item item = read_item(parameter.tag);
        item.input = parameter.reads;
        item.compared = compare_outputs_ && parameter.writes && item.asked &&
                        verdict(*item.row, true) == AccessError::none;
        item.form =
            parameter.writes && item.unscaled && item.asked && verdict(*item.row, true) == AccessError::none;
        if (item.input || item.compared || item.form) items.push_back(item);
    }
    for (const std::uint16_t tag : watched_) {
        ReadPlan::Item item = read_item(tag);
        item.watched = true;
        items.push_back(item);
    }
    std::sort(items.begin(), items.end(),
              [](const auto& a, const auto& b) { return a.row->number < b.row->number; });
    std::vector<ReadPlan::Item> merged;
    for (const ReadPlan::Item& item : items) {
        if (merged.empty() || merged.back().row != item.row) {
            merged.push_back(item);
            continue;
        }
        merged.back().input = merged.back().input || item.input;
        merged.back().compared = merged.back().compared || item.compared;
        merged.back().form = merged.back().form || item.form;
        merged.back().watched = merged.back().watched || item.watched;
    }
    return merged;
}

/// Where outputs are compared, only the last of several with the same tag is written: two words for one
/// parameter would be written over each other for ever.
std::vector<OutputPlan::Item> UnitTags::outputs_of(const Layout& layout)
{
    std::vector<OutputPlan::Item> items;
    std::size_t place = 0;
    for (const Parameter& parameter : parameters_of(layout)) {
        OutputPlan::Item item;
        item.parameter = place++;
        if (!parameter.writes) continue;
        item.row = row(parameter.tag);
        item.error = verdict(*item.row, true);
        if (compare_outputs_ && item.error == AccessError::none) {
            item.readable = verdict(*item.row, false) == AccessError::none;
            for (OutputPlan::Item& other : items)
                if (other.row == item.row) other.error = AccessError::not_understood;
        }
        items.push_back(item);
    }
    for (OutputPlan::Item& item : items) {
        item.asked = item.error == AccessError::none;
        if (!item.asked) item.state = state_of(item.error);
    }
    return items;
}

} // namespace dpslave::drive
