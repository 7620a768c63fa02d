// SPDX-License-Identifier: Apache-2.0
#include "read_plan.hpp"

#include <algorithm>

namespace dpslave::drive {

void ReadPlan::reset(ParameterSet& parameters)
{
    turns_.clear();
    for (DriveParameter& one : parameters.all())
        if (one.reading.uses != 0) turns_.push_back({.parameter = &one});
    position_ = 0;
    began_at_.reset();
    cyclic_ = kReadAlways;
    halves_.reset();
    rebuild();
}

void ReadPlan::exchange(ParameterSet& parameters)
{
    const std::vector<Turn> before = std::move(turns_);
    const std::uint8_t cyclic = cyclic_;
    reset(parameters);
    auto known = before.begin();
    for (Turn& turn : turns_) {
        while (known != before.end() && known->row().number < turn.row().number) ++known;
        if (known == before.end()) break;
        if (known->row().number != turn.row().number || !is_read_alike(*known->parameter, *turn.parameter))
            continue;
        turn.busy = known->busy;
        if (known->cut == Cut::after_hole) turn.cut = Cut::after_hole; // a search begins anew
    }
    cyclic_ = cyclic;
    rebuild();
}

void ReadPlan::compare(bool outputs)
{
    const std::uint8_t cyclic = outputs ? kReadAlways | kCompared : kReadAlways;
    if (cyclic == cyclic_) return;
    cyclic_ = cyclic;
    halves_.reset();
    rebuild();
}

/// Returns the reasons to read it at present.
std::uint8_t ReadPlan::uses_now(const Turn& turn) const
{
    const Reading& reading = turn.reading();
    std::uint8_t now = cyclic_;
    if (reading.state != WordState::good) now |= kForm;
    if (!reading.tried || reading.state == WordState::invalid_tag) now |= kAsked;
    return reading.uses & now;
}

/// It is not asked in the rounds, but from time to time.
bool ReadPlan::waits_for_retry(const Turn& turn) const
{
    return in_use(turn) && turn.reading().asked && turn.reading().is_excluded();
}

/// Goes into the open block as far as rule and cuts allow.
bool ReadPlan::joins(const Turn& turn) const
{
    if (turn.cut != Cut::none) return false;
    const Block block = blocks_.back();
    const int gap = turn.row().number - turns_[block.last].row().number - 1;
    const int span = turn.row().number - turns_[block.first].row().number + 1;
    return gap <= rule_.max_gap && span <= rule_.max_tags;
}

/// Joins neighbours over what is not in use at present, but not over holes (excluded parameters).
void ReadPlan::rebuild()
{
    blocks_.clear();
    calm_ = true;
    bool open = false;
    for (std::size_t i = 0; i < turns_.size(); ++i) {
        const Turn& turn = turns_[i];
        const bool excluded = turn.reading().is_excluded();
        const bool apart = turn.row().modbus_register.has_value();
        open = open && !excluded && !apart;
        if (excluded || !in_use(turn)) continue;
        calm_ = calm_ && (uses_now(turn) & ~kWatched) == 0;
        if (open && joins(turn))
            blocks_.back().last = i;
        else
            blocks_.push_back({i, i});
        open = !apart;
    }
}

/// Its scale must be known before the exchange begins, however many others there are to read.
bool ReadPlan::is_urgent(const Turn& turn) const
{
    const Reading& reading = turn.reading();
    return reading.unscaled && reading.asked && !reading.tried && in_use(turn);
}

std::optional<ReadPlan::Block> ReadPlan::next(Instant now)
{
    for (std::size_t i = 0; i < turns_.size(); ++i)
        if (is_urgent(turns_[i]) && now >= turns_[i].retry_at) return Block{i, i};
    for (const Block block : blocks_) {
        if (block.last < position_) continue;
        if (!began_at_) began_at_ = now;
        return block;
    }
    for (std::size_t i = 0; i < turns_.size(); ++i)
        if (waits_for_retry(turns_[i]) && now >= turns_[i].retry_at) return Block{i, i};
    return std::nullopt;
}

void ReadPlan::begin_round(Instant now)
{
    if (calm_ && began_at_ && now < *began_at_ + kCalmRound) return;
    position_ = 0;
    began_at_.reset();
}

Instant ReadPlan::next_due() const
{
    Instant at = kNever;
    if (!blocks_.empty()) {
        const bool waits = calm_ && began_at_ && blocks_.back().last < position_;
        at = waits ? *began_at_ + kCalmRound : kAtOnce;
    }
    for (const Turn& turn : turns_)
        if (waits_for_retry(turn)) at = std::min(at, turn.retry_at);
    return at;
}

std::uint16_t ReadPlan::count_of(Block block) const
{
    return static_cast<std::uint16_t>(turns_[block.last].row().number - turns_[block.first].row().number + 1);
}

Purpose ReadPlan::purpose_of(Block block) const
{
    std::uint8_t uses = 0;
    for (std::size_t i = block.first; i <= block.last; ++i) uses |= uses_now(turns_[i]);
    if ((uses & kInput) != 0) return Purpose::input;
    return (uses & ~kWatched) != 0 ? Purpose::output : Purpose::watch;
}

bool ReadPlan::done(Block block, const Outcome& outcome, Instant now)
{
    const AccessError error = outcome.error;
    if (error == AccessError::none && outcome.words.size() >= count_of(block))
        return good(block, outcome.words, now);
    if (block.first == block.last) return bad(block.first, outcome, now);
    if (error == AccessError::not_understood && ++turns_[block.first].busy <= kBusyRounds) return busy(block);
    split(block);
    return false;
}

bool ReadPlan::good(Block block, std::span<const std::uint16_t> words, Instant now)
{
    bool changed = false;
    bool joins_again = false;
    for (std::size_t i = block.first; i <= block.last; ++i) {
        Turn& turn = turns_[i];
        Reading& reading = turn.reading();
        const auto word =
            words[static_cast<std::size_t>(turn.row().number - turns_[block.first].row().number)];
        changed = changed || (reading.serves(kOfLayout) &&
                              (!reading.tried || reading.word != word || reading.state != WordState::good));
        joins_again = joins_again || reading.is_excluded() || (uses_now(turn) & (kForm | kAsked)) != 0;
        reading.of_other_row = false;
        reading.answered(AccessError::none);
        reading.word = word;
        reading.answer = {};
        reading.tried = true;
        reading.updated_at = now;
        turn.busy = 0;
    }
    position_ = std::max(position_, block.last + 1);
    find_hole(block);
    if (joins_again) rebuild();
    return changed;
}

/// The turn that a transaction can begin with, from `index` on.
std::size_t ReadPlan::in_use_from(std::size_t index) const
{
    while (index < turns_.size() && !in_use(turns_[index])) ++index;
    return index;
}

/// A refused block is cut in the middle, where something is read; a half that is still refused is cut again.
/// A refused block says nothing about its words.
void ReadPlan::split(Block block)
{
    hold(block, AccessError::deferred);
    halves_ = Halves{block, in_use_from((block.first + block.last) / 2 + 1), false};
    turns_[halves_->second].cut = Cut::search;
    rebuild();
}

/// Both halves are given and the whole is not: the hole is between them.
void ReadPlan::find_hole(Block good)
{
    if (!halves_) return;
    if (good.first <= halves_->block.first && in_use_from(good.last + 1) == halves_->second)
        halves_->first_is_good = true;
    if (!halves_->first_is_good || good.first != halves_->second || good.last < halves_->block.last) return;
    turns_[halves_->second].cut = Cut::after_hole;
    remove_search_cuts();
}

/// The hole is found: the cuts made on the way to it are no longer needed.
void ReadPlan::remove_search_cuts()
{
    for (Turn& turn : turns_)
        if (turn.cut == Cut::search) turn.cut = Cut::none;
    halves_.reset();
    rebuild();
}

/// A cut would not help: the block waits for the next round, its words are held as they were.
bool ReadPlan::busy(Block block)
{
    bool changed = false, asked_once = false;
    for (std::size_t i = block.first; i <= block.last; ++i) {
        Reading& reading = turns_[i].reading();
        changed = changed || (reading.serves(kOfLayout) && !reading.tried);
        asked_once = asked_once || (uses_now(turns_[i]) & kAsked) != 0;
        reading.tried = true;
        if (reading.state == WordState::untried) reading.state = WordState::stale;
        hold(turns_[i], AccessError::not_understood);
    }
    position_ = std::max(position_, block.last + 1);
    if (asked_once) rebuild();
    return changed;
}

bool ReadPlan::bad(std::size_t index, const Outcome& outcome, Instant now)
{
    Turn& turn = turns_[index];
    Reading& reading = turn.reading();
    const Reading before = reading;
    reading.answered(outcome.error);
    reading.answer = answer_text(outcome.answer);
    reading.of_other_row = false;
    // A value that was read once in this layout is held; the value of a tag that never gave one is 0 (X-48,
    //
    if (!reading.was_read()) reading.word = 0;
    const bool was_asked_once = (uses_now(turn) & kAsked) != 0;
    reading.tried = true;
    turn.retry_at = now + kInvalidRetry;
    position_ = std::max(position_, index + 1);
    if (reading.is_excluded() && !before.is_excluded())
        remove_search_cuts();
    else if (reading.is_excluded() != before.is_excluded() || was_asked_once)
        rebuild();
    return reading.serves(kOfLayout) && (!before.tried || before.state != reading.state ||
                                         before.error != reading.error || before.word != reading.word);
}

void ReadPlan::refuse(DriveParameter& parameter, AccessError error, std::string_view answer)
{
    Reading& reading = parameter.reading;
    reading.refuse(error);
    reading.tried = true;
    reading.word = 0;
    reading.answer = answer_text(answer);
    rebuild();
}

void ReadPlan::skip(Block block)
{
    position_ = std::max(position_, block.last + 1);
    for (std::size_t i = block.first; i <= block.last; ++i) turns_[i].retry_at += kInvalidRetry;
}

void ReadPlan::defer(Block block, Instant now)
{
    position_ = std::max(position_, block.last + 1);
    for (std::size_t i = block.first; i <= block.last; ++i) turns_[i].retry_at = now + kDeferredRetry;
    hold(block, AccessError::deferred);
}

void ReadPlan::hold(const Turn& turn, AccessError why) const
{
    if (turn.reading().serves(cyclic_)) turn.reading().hold(why);
}

void ReadPlan::hold(Block block, AccessError why)
{
    for (std::size_t i = block.first; i <= block.last; ++i) hold(turns_[i], why);
}

void ReadPlan::hold_all()
{
    for (const Turn& turn : turns_) hold(turn, AccessError::no_answer);
}

void ReadPlan::drive_returned(Instant now)
{
    for (Turn& turn : turns_) {
        turn.retry_at = now;
        turn.cut = Cut::none;
    }
    halves_.reset();
    rebuild();
}

} // namespace dpslave::drive
