// SPDX-License-Identifier: Apache-2.0
#include "unit_tags.hpp"

#include <algorithm>

namespace dpslave::drive {

std::span<const Parameter> parameters_of(const Layout& layout)
{
    return std::span{layout.parameters}.first(std::min<std::size_t>(layout.count, kMaxParameters));
}

const Tag* UnitTags::row(std::uint16_t number)
{
    if (const Tag* row = table_ != nullptr ? table_->find(number) : nullptr) return row;
    return &unlisted_.try_emplace(number, unlisted_tag(number)).first->second;
}

AccessError UnitTags::verdict(const Tag& row, bool is_write) const
{
    if (!row.listed && only_from_table_) return AccessError::invalid_tag;
    if (row.type == TagType::string) return AccessError::unsupported_type;
    if (is_write && row.access == Access::read_only) return AccessError::read_only;
    if (!is_write && row.access == Access::write_only) return AccessError::unsupported_type;
    return AccessError::none;
}

std::vector<ReadPlan::Item> UnitTags::inputs_of(const Layout& layout)
{
    std::vector<ReadPlan::Item> items;
    for (const Parameter& parameter : parameters_of(layout)) {
        if (!parameter.reads) continue;
        ReadPlan::Item item;
        item.row = row(parameter.tag);
        const AccessError error = verdict(*item.row, false);
        item.asked = error == AccessError::none;
        item.tried = !item.asked;
        if (!item.asked) item.state = state_of(error);
        items.push_back(item);
    }
    std::sort(items.begin(), items.end(),
              [](const auto& a, const auto& b) { return a.row->number < b.row->number; });
    const auto same = [](const auto& a, const auto& b) { return a.row == b.row; };
    items.erase(std::unique(items.begin(), items.end(), same), items.end());
    return items;
}

std::vector<OutputPlan::Item> UnitTags::outputs_of(const Layout& layout)
{
    std::vector<OutputPlan::Item> items;
    std::size_t place = 0;
    for (const Parameter& parameter : parameters_of(layout)) {
        OutputPlan::Item item;
        item.parameter = place++;
        if (!parameter.writes) continue;
        item.row = row(parameter.tag);
        const AccessError error = verdict(*item.row, true);
        item.asked = error == AccessError::none;
        if (!item.asked) item.state = state_of(error);
        items.push_back(item);
    }
    return items;
}

} // namespace dpslave::drive
