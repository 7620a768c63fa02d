// SPDX-License-Identifier: Apache-2.0
#include "parameter_set.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::drive {
namespace {

void take_over_reading(DriveParameter& now, const DriveParameter& before)
{
    Reading& reading = now.reading;
    const Reading& known = before.reading;
    if (is_read_alike(before, now)) {
        const std::uint8_t uses = reading.uses;
        const bool unscaled = reading.unscaled;
        reading = known;
        reading.uses = uses;
        reading.unscaled = unscaled;
    } else if (reading.asked) {
        reading.word = known.word;
        reading.tried = known.tried && !reading.serves(kAsked);
        reading.updated_at = known.updated_at;
        if (known.error == AccessError::no_scale &&
            !known.asked) { // a register contradicts it no more
            reading.tried = false;
            return;
        }
        if (known.error != AccessError::no_scale && known.error != AccessError::invalid_tag) return;
        reading.of_other_row = true;
        reading.state = known.state; // data exchange does not start with a word that was never read
        reading.error = known.error;
        reading.answer = known.answer;
    } else if (reading.error == AccessError::no_scale) { // it was read before that was found: held
        reading.word = known.word;
        reading.updated_at = known.updated_at;
    }
}

} // namespace

ParameterSet::ParameterSet(std::vector<DriveParameter> uses)
{
    std::stable_sort(uses.begin(), uses.end(),
                     [](const auto& a, const auto& b) { return a.row->number < b.row->number; });
    std::size_t first = 0; // the record of the present tag
    for (const DriveParameter& use : uses) {
        if (records_.empty() || records_[first].row != use.row) {
            first = records_.size();
            records_.push_back(use);
            continue;
        }
        DriveParameter& record = records_[first];
        record.reading.uses |= use.reading.uses;
        if (!use.writing.is_output) continue;
        if (!record.writing.is_output) {
            record.writing = use.writing;
            continue;
        }
        records_.push_back(use);
        records_.back().reading = {};
    }
}

DriveParameter* ParameterSet::find_read(std::uint16_t tag)
{
    return const_cast<DriveParameter*>(std::as_const(*this).find_read(tag));
}

const DriveParameter* ParameterSet::find_read(std::uint16_t tag) const
{
    const auto at = std::lower_bound(
        records_.begin(), records_.end(), tag,
        [](const DriveParameter& one, std::uint16_t wanted) { return one.row->number < wanted; });
    if (at == records_.end() || at->row->number != tag || at->reading.uses == 0) return nullptr;
    return &*at;
}

const DriveParameter* ParameterSet::find_output(std::size_t parameter) const
{
    const auto at = std::find_if(records_.begin(), records_.end(), [parameter](const DriveParameter& one) {
        return one.writing.is_output && one.writing.parameter == parameter;
    });
    return at == records_.end() ? nullptr : &*at;
}

bool ParameterSet::every_input_tried() const
{
    return std::all_of(records_.begin(), records_.end(), [](const DriveParameter& one) {
        return !one.reading.serves(kOfLayout) || one.reading.tried;
    });
}

bool ParameterSet::scale_missing() const
{
    return std::any_of(records_.begin(), records_.end(), [](const DriveParameter& one) {
        return one.reading.serves(kInput | kForm) && one.reading.error == AccessError::no_scale;
    });
}

ParameterSet::Denied ParameterSet::denied() const
{
    bool one_denied = false, one_not = false;
    for (const DriveParameter& one : records_) {
        if (!one.reading.serves(kOfLayout)) continue;
        (one.reading.state == WordState::invalid_tag ? one_denied : one_not) = true;
    }
    if (!one_denied) return Denied::none;
    return one_not ? Denied::some : Denied::all;
}

void ParameterSet::readings_lost(bool is_result)
{
    for (DriveParameter& one : records_)
        if (one.reading.uses != 0) one.reading.drive_lost(is_result);
}

void ParameterSet::writings_lost()
{
    for (DriveParameter& one : records_)
        if (one.writing.is_output && one.writing.asked && !one.writing.is_dropped()) one.writing.lose();
}

void ParameterSet::take_over(const ParameterSet& before)
{
    for (DriveParameter& now : records_) {
        if (const DriveParameter* known = now.reading.uses != 0 ? before.find_read(now.row->number) : nullptr)
            take_over_reading(now, *known);
        const DriveParameter* known =
            now.writing.is_output ? before.find_output(now.writing.parameter) : nullptr;
        if (known == nullptr) continue;
        if (!is_written_alike(*known, now)) {
            now.writing.wanted = known->writing.wanted;
            continue;
        }
        const bool readable = now.writing.readable && (known->writing.readable || known->row->once);
        now.writing = known->writing;
        now.writing.readable = readable;
    }
}

bool is_read_alike(const DriveParameter& a, const DriveParameter& b)
{
    return a.reading.asked == b.reading.asked && is_same_value(*a.row, *b.row);
}

bool is_written_alike(const DriveParameter& a, const DriveParameter& b)
{
    return a.writing.asked == b.writing.asked && is_same_value(*a.row, *b.row);
}

} // namespace dpslave::drive
