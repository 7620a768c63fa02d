// SPDX-License-Identifier: Apache-2.0
#include "output_plan.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::drive {
namespace {

constexpr unsigned kMaxRepeats = 6; ///< 64 s: beyond every limit

} // namespace

void OutputPlan::reset(ParameterSet& parameters)
{
    use(parameters);
    failed_blocks_ = 0;
    may_write_ = false;
    stopped_ = false;
}

void OutputPlan::use(ParameterSet& parameters)
{
    turns_.clear();
    for (DriveParameter& one : parameters.all()) {
        if (!one.writing.is_output) continue;
        turns_.push_back({.parameter = &one, .repeated = {}});
        sent_once_.show(*one.row, one.writing);
    }
    std::sort(turns_.begin(), turns_.end(),
              [](const Turn& a, const Turn& b) { return a.writing().parameter < b.writing().parameter; });
    by_tag_.clear();
    for (std::size_t i = 0; i < turns_.size(); ++i)
        if (turns_[i].writing().asked) by_tag_.push_back(i);
    std::sort(by_tag_.begin(), by_tag_.end(), [this](auto a, auto b) {
        return turns_[a].parameter->row->number < turns_[b].parameter->row->number;
    });
    batch_.clear();
}

void OutputPlan::exchange(ParameterSet& parameters, std::chrono::nanoseconds refresh)
{
    rule_.refresh = refresh;
    const std::vector<Turn> before = std::move(turns_);
    use(parameters);
    for (std::size_t i = 0; i < turns_.size(); ++i) { // the layout is the same, so are the places
        DriveParameter* const parameter = turns_[i].parameter;
        const Writing& was = before[i].writing();
        const bool is_proven = was.knowledge == Knowledge::acknowledged || was.knowledge == Knowledge::held;
        if (!parameter->row->once)
            sent_once_.forget(*parameter->row);
        else if (!before[i].parameter->row->once && is_proven)
            sent_once_.note(*parameter->row, was.known, was.error, was.answered_at);
        if (!is_written_alike(*before[i].parameter, *parameter)) continue;
        turns_[i] = before[i];
        turns_[i].parameter = parameter;
    }
}

void OutputPlan::set(std::span<const std::uint16_t> words, bool may_write)
{
    const bool begins = may_write && !may_write_;
    may_write_ = may_write;
    for (const Turn& turn : turns_) {
        turn.writing().wanted = words[turn.writing().parameter];
        if (begins) turn.writing().layout_begins();
    }
}

/// A changed word is due at once, kAtOnce. A word that is dropped is tried rarely; a word that the drive did
/// not understand is tried as rarely, unless its refresh comes first.
Instant OutputPlan::due_at(const Turn& turn) const
{
    const Writing& writing = turn.writing();
    const Tag& row = *turn.parameter->row;
    if (!writing.asked || sent_once_.was(row, writing.wanted)) return kNever;
    if (writing.is_dropped()) return turn.attempted_at + kInvalidRetry;
    if (row.once) // refused before it was sent
        return turn.repeated == writing.wanted ? turn.attempted_at + kInvalidRetry : kAtOnce;
    if (!writing.is_settled()) return kAtOnce;
    if (rule_.compare) return repeat_at(turn);
    const bool not_understood = writing.error == AccessError::not_understood;
    return turn.attempted_at + (not_understood ? std::min(rule_.refresh, kInvalidRetry) : rule_.refresh);
}

/// Returns when a compared output whose word was answered is written again. It is never repeated while the
/// drive holds it.
Instant OutputPlan::repeat_at(const Turn& turn) const
{
    const Writing& writing = turn.writing();
    const bool differs = writing.knowledge == Knowledge::differs;
    if (writing.knowledge == Knowledge::held || (!writing.is_refused() && !differs)) return kNever;
    if (!writing.is_refused() && turn.repeats == 0) return kAtOnce; // overridden, or lost in a block
    const auto pause = kFirstRepeat * (1U << std::min(turn.repeats, kMaxRepeats));
    return turn.attempted_at + std::min(pause, writing.is_refused() ? kInvalidRetry : kRepeatNotKept);
}

bool OutputPlan::joins(const Turn& turn, Instant now) const
{
    const Writing& writing = turn.writing();
    const Tag& row = *turn.parameter->row;
    return writing.readable && !row.once && !turn.alone && !turn.waits && !row.modbus_register &&
           !writing.is_dropped() && turn.round != round_ && due_at(turn) <= now;
}

/// Fills the batch with the output and its neighbours by tag as far as they are due.
void OutputPlan::join_neighbours(std::size_t index, Instant now)
{
    batch_.assign(1, index);
    const std::size_t limit = std::min<std::size_t>(rule_.max_written, kMaxParameters);
    const bool blocks = rule_.compare && failed_blocks_ < kMaxFailedBlocks;
    if (!blocks || limit < 2 || !joins(turns_[index], now)) return;
    const auto here =
        static_cast<std::size_t>(std::find(by_tag_.begin(), by_tag_.end(), index) - by_tag_.begin());
    const auto turn_at = [this](std::size_t place) -> const Turn& { return turns_[by_tag_[place]]; };
    const auto adjoins = [&](std::size_t place) { // `place` and the one after it
        return turn_at(place).parameter->row->number + 1 == turn_at(place + 1).parameter->row->number;
    };
    std::size_t first = here, last = here;
    while (last - first + 1 < limit && first > 0 && adjoins(first - 1) && joins(turn_at(first - 1), now))
        --first;
    while (last - first + 1 < limit && last + 1 < by_tag_.size() && adjoins(last) &&
           joins(turn_at(last + 1), now))
        ++last;
    batch_.assign(by_tag_.begin() + static_cast<std::ptrdiff_t>(first),
                  by_tag_.begin() + static_cast<std::ptrdiff_t>(last + 1));
}

std::optional<OutputPlan::Write> OutputPlan::start(Instant now)
{
    if (!writes_now()) return std::nullopt;
    std::optional<std::size_t> chosen;
    for (std::size_t i = 0; i < turns_.size(); ++i) {
        if (turns_[i].round == round_) continue;
        const Instant due = due_at(turns_[i]);
        if (due > now || (chosen && due != kAtOnce)) continue;
        chosen = i;
        if (due == kAtOnce) break;
    }
    if (!chosen) return std::nullopt;
    join_neighbours(*chosen, now);
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        Turn& turn = turns_[batch_[i]];
        words_[i] = turn.writing().wanted;
        turn.writing().on(KnowledgeEvent::sent);
        turn.attempted_at = now;
    }
    return Write{turns_[batch_.front()].parameter->row, std::span{words_}.first(batch_.size())};
}

Instant OutputPlan::next_due() const
{
    Instant at = kNever;
    if (writes_now())
        for (const Turn& turn : turns_) at = std::min(at, due_at(turn));
    return at;
}

void OutputPlan::done(AccessError error, Instant now)
{
    if (writes_block() && error != AccessError::none) {
        hold(AccessError::deferred);
        return block_failed();
    }
    if (writes_block()) failed_blocks_ = 0;
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        Turn& turn = turns_[batch_[i]];
        turn.writing().write_answered(words_[i], error, writes_block(), now);
        turn.round = round_;
        turn.alone = turn.writing().is_refused();
        turn.repeats = turn.repeated == words_[i] ? std::min(turn.repeats + 1, kMaxRepeats) : 0;
        turn.repeated = words_[i];
    }
}

void OutputPlan::not_answered(bool drive_lost)
{
    if (drive_lost)
        for (const std::size_t index : batch_) turns_[index].waits = true;
    hold(AccessError::no_answer);
    if (writes_block()) block_failed();
}

void OutputPlan::defer()
{
    for (const std::size_t index : batch_) turns_[index].round = round_;
    hold(AccessError::deferred);
}

void OutputPlan::hold(AccessError why)
{
    for (const std::size_t index : batch_) turns_[index].writing().hold(why);
}

/// None of its words is known to be written, so each is due at once.
void OutputPlan::block_failed()
{
    ++failed_blocks_;
    for (const std::size_t index : batch_) turns_[index].alone = true;
}

/// If outputs are compared, at most one is asked for each tag.
OutputPlan::Turn* OutputPlan::find_asked(const Tag* row)
{
    const auto at = std::find_if(turns_.begin(), turns_.end(), [row](const Turn& turn) {
        return turn.parameter->row == row && turn.writing().asked;
    });
    return at == turns_.end() ? nullptr : &*at;
}

void OutputPlan::observed(const Tag* row, std::uint16_t word, Instant began)
{
    Turn* const turn = find_asked(row);
    if (turn == nullptr) return;
    Writing& writing = turn->writing();
    writing.readable = true;
    if (word == writing.wanted) {
        writing.wanted_seen(began);
        turn->repeats = 0;
        turn->repeated.reset();
        turn->alone = turn->alone && writing.is_refused();
        return;
    }
    if (!writing.is_settled()) return; // it is written anyway
    if (writing.knowledge != Knowledge::assumed && began < writing.answered_at + kSettling) return;
    turn->alone = turn->alone || writing.knowledge == Knowledge::unproven;
    writing.on(KnowledgeEvent::another_seen);
    if (writing.is_refused() || turn->repeats == 0) return;
    writing.state = WordState::refused; // accepted again and again, and not kept
    writing.error = AccessError::not_understood;
}

void OutputPlan::unreadable(const Tag* row)
{
    Turn* const turn = find_asked(row);
    if (turn == nullptr) return;
    turn->writing().on(KnowledgeEvent::not_given); // not proven: only a single write proves it
    turn->writing().readable = false;
}

void OutputPlan::refuse(const Tag* row, AccessError error)
{
    for (const Turn& turn : turns_)
        if (turn.parameter->row == row) turn.writing().refuse(error);
}

void OutputPlan::port_changed()
{
    leaves_port_ = false;
    for (Turn& turn : turns_) {
        if (!turn.writing().asked) continue;
        turn = {.parameter = turn.parameter, .round = round_, .repeated = {}};
        turn.writing().port_changed();
        sent_once_.show(*turn.parameter->row, turn.writing());
    }
    batch_.clear();
    failed_blocks_ = 0;
}

/// The knowledge about blocks stays: the drive may have been lost on one.
void OutputPlan::drive_returned()
{
    for (Turn& turn : turns_) {
        if (!turn.writing().asked) continue;
        turn.writing().drive_returned();
        sent_once_.show(*turn.parameter->row, turn.writing());
        turn.repeats = 0;
        turn.repeated.reset();
        turn.round = turn.waits ? round_ + 1 : round_;
        turn.waits = false;
    }
}

} // namespace dpslave::drive
