// SPDX-License-Identifier: Apache-2.0
#include "poller_unit.hpp"

#include "generations.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

/// Active Demand Data may lengthen a round by 16 ms on the 590 and by 30 ms on the 584S, where a parameter
/// takes 8 and 15 ms (HA389815 ch. 8): that is two transactions. One repeats the standing order, one is for a
/// new order.
constexpr int kOrdersPerRound = 2;
constexpr std::size_t kMaxOperates = 16;

} // namespace

Poller::Unit::Unit(const UnitSettings& settings, BlockRule rule, std::size_t index)
    : settings_(settings),
      index_(index),
      tags_(settings),
      reads_(rule),
      outputs_({settings.output_refresh, settings.compare_outputs, rule.max_written}),
      safe_state_(settings.zero_after)
{
    reads_.reset(tags_.reads_of({}));
    show();
}

bool Poller::Unit::has_ended(Generation generation) const
{
    return ended_ != 0 && generation != 0 && !is_newer(generation, ended_);
}

// ---- what is wanted

void Poller::Unit::set_outputs(const OutputImage& image)
{
    const bool is_new = image.layout.generation != image_.layout.generation;
    if (is_new) new_layout(image);
    image_ = image;
    outputs_.set(image_.words, image_.may_write);
    master_wrote_ = master_wrote_ || image_.may_write;
    if (has_ended(image_.layout.generation)) end_layout();
    if (outputs_.writes_now() && !writing_ && !leaves_port_) begin_writing();
    if (is_new) show();
}

void Poller::Unit::new_layout(const OutputImage& image)
{
    left_data_exchange(image_.layout.generation);
    ++serial_;
    reads_.reset(tags_.reads_of(image.layout));
    outputs_.reset(tags_.outputs_of(image.layout));
    if (lost_) {
        reads_.drive_lost();
        outputs_.drive_lost();
    }
    master_wrote_ = writing_ = zeroed_ = false;
    inputs_not_understood_ = outputs_not_understood_ = 0;
    in_round_ = false;
    round_began_.reset();
    orders_in_round_ = 0;
    snapshot_.cycle = {};
    snapshot_.words = {};
    snapshot_.updated_at = {};
    snapshot_.states = {};
    snapshot_.errors = {};
    snapshot_.repeated = {};
    snapshot_.answer_texts = {};
    inputs_changed_ = true;
}

/// What the present layout writes is left to it: a zero of the layout before would come after the newer word.
void Poller::Unit::begin_writing()
{
    writing_ = true;
    reads_.compare(settings_.compare_outputs);
    for (const OutputPlan::Item& item : outputs_.items())
        if (item.asked) safe_state_.remove(item.row);
}

/// Of the present layout nothing is written any more. Its outputs go to the safe state, and only if the
/// master was in Data_Exchange with it: a drive that runs locally is left alone by start-ups that fail.
void Poller::Unit::end_layout()
{
    outputs_.stop();
    reads_.compare(false);
    writing_ = false;
    if (!master_wrote_ || zeroed_) return;
    zero_outputs();
}

void Poller::Unit::zero_outputs()
{
    zeroed_ = true;
    for (const OutputPlan::Item& item : outputs_.items())
        if (item.asked) safe_state_.add(item.row);
}

// ---- another port, other settings

void Poller::Unit::leave_port()
{
    leaves_port_ = true;
    outputs_.pause(true);
    if (writing_) zero_outputs();
    writing_ = false;
    safe_state_.ride_no_longer();
}

/// Nothing is known of what is there: a drive that was lost may answer here, and the other way round.
void Poller::Unit::port_changed()
{
    leaves_port_ = false;
    safe_state_.ride_again();
    zeroed_ = has_ended(image_.layout.generation) && zeroed_;
    lost_ = false;
    silences_ = 0;
    ever_asked_ = false;
    reads_.drive_returned(kAtOnce);
    outputs_.pause(false);
    outputs_.forget();
    outputs_.begin_round();
    round_began_.reset();
    order_was_last_ = zero_waits_ = false;
    if (outputs_.writes_now()) begin_writing();
    show();
}

void Poller::Unit::go_on_as(std::size_t index, const UnitSettings& settings)
{
    index_ = index;
    settings_.retries = settings.retries;
    if (settings == settings_) return;
    UnitTags tags{settings};
    tags.keep_contradicted(tags_);
    reads_.exchange(tags.reads_of(image_.layout));
    if (lost_) reads_.drive_lost();
    outputs_.exchange(tags.outputs_of(image_.layout), settings.output_refresh);
    const auto row_of = [&tags](const Tag* row) { return tags.row(row->number); };
    safe_state_.exchange(row_of);
    demand_.exchange(row_of);
    for (WaitingOperate& waiting : operates_) waiting.row = row_of(waiting.row);
    tags_ = std::move(tags); // rows that are in no table stay where they are
    settings_ = settings;
    snapshot_.watched = {};
    inputs_changed_ = true;
    show();
}

void Poller::Unit::left_data_exchange(Generation generation)
{
    if (generation == 0 || has_ended(generation)) return;
    ended_ = generation;
    demand_.end(generation);
    if (has_ended(image_.layout.generation)) end_layout();
}

void Poller::Unit::set_demand(const DemandOrder& order)
{
    if (has_ended(order.generation)) return;
    const Tag* row = tags_.row(order.tag);
    demand_.set(order, row, tags_.verdict(*row, order.kind == DemandOrder::Kind::write));
    if (lost_) demand_.drop_superseded();
    snapshot_.orders_dropped = demand_.dropped();
}

bool Poller::Unit::operate(const OperateOrder& order)
{
    if (operates_.size() + operate_answers_.size() >= kMaxOperates) return false;
    const Tag* row = tags_.row(order.tag);
    AccessError error = tags_.verdict(*row, order.is_write);
    if (error == AccessError::none && lost_) error = AccessError::no_answer;
    if (error == AccessError::none)
        operates_.push_back({order, row});
    else
        operate_answers_.push_back({order.number, error, 0});
    return true;
}

bool Poller::Unit::survey(std::uint32_t number, std::uint16_t tag)
{
    if (!survey_.set(number, *tags_.row(tag))) return false;
    if (lost_) survey_.done({.error = AccessError::no_answer, .words = {}}, {});
    return true;
}

// ---- what next

std::optional<Transaction> Poller::Unit::next(Instant now)
{
    if (now < rests_until_) return std::nullopt;
    auto transaction = asked(now);
    if (!transaction) {
        begin_round(now);
        transaction = asked(now);
    }
    if (!transaction) {
        order_was_last_ = zero_waits_ = false; // nothing cyclic is there to go first
        transaction = asked(now);
    }
    if (!transaction) transaction = idle_probe(now);
    if (transaction)
        wrote_last_ = transaction->kind == Transaction::Kind::write;
    else
        owes_round_ = false;
    return transaction;
}

/// What this round still has.
std::optional<Transaction> Poller::Unit::asked(Instant now)
{
    if (!zero_waits_) {
        if (const Tag* row = safe_state_.next(now)) return make_write(Purpose::safe_state, row, 0);
        if (const Tag* row = safe_state_.next_proof(now)) return make_read(Purpose::safe_state, row);
    }
    if (wrote_last_)
        if (auto read = cyclic_read(now)) return read; // fast outputs do not starve inputs
    if (auto transaction = ordered()) return transaction;
    return cyclic(now);
}

/// Demand Data first, then dpctl; but after each of them one cyclic transaction, and what is asked again once
/// a round.
std::optional<Transaction> Poller::Unit::ordered()
{
    if (order_was_last_) return std::nullopt;
    const DemandQueue::Entry* entry = demand_.front();
    const bool is_again = entry != nullptr && (entry->answered || entry->not_understood > 0);
    if (entry != nullptr && orders_in_round_ < (is_again ? 1 : kOrdersPerRound)) {
        order_was_last_ = true;
        ++orders_in_round_;
        job_.order = entry->order.number;
        return entry->order.kind == DemandOrder::Kind::write && !entry->written
                   ? make_write(Purpose::demand, entry->row, entry->order.value)
                   : make_read(Purpose::demand, entry->row);
    }
    if (!operates_.empty()) {
        order_was_last_ = true;
        const WaitingOperate& waiting = operates_.front();
        job_.order = waiting.order.number;
        return waiting.order.is_write && !waiting.written
                   ? make_write(Purpose::operate, waiting.row, waiting.order.word)
                   : make_read(Purpose::operate, waiting.row);
    }
    return std::nullopt;
}

std::optional<Transaction> Poller::Unit::next_survey(Instant now) const
{
    return survey_.due() <= now && !lost_ ? std::optional{make_read(Purpose::survey, survey_.row())}
                                          : std::nullopt;
}

/// Outputs before inputs. As an output is written once a round at most, one that changes all the time takes
/// no more than its own share of the cycle.
std::optional<Transaction> Poller::Unit::cyclic(Instant now)
{
    if (!round_began_) round_began_ = now;
    job_.layout = serial_;
    job_.began = now;
    if (const auto write = outputs_.start(now)) {
        order_was_last_ = zero_waits_ = false;
        return make_write(Purpose::output, write->row, write->words);
    }
    return cyclic_read(now);
}

std::optional<Transaction> Poller::Unit::cyclic_read(Instant now)
{
    const auto block = reads_.next(now);
    if (!block) return std::nullopt;
    if (!round_began_) round_began_ = now;
    job_.layout = serial_;
    job_.began = now;
    job_.block = *block;
    order_was_last_ = zero_waits_ = false;
    const Purpose purpose = reads_.serves_input(*block)    ? Purpose::input
                            : reads_.serves_output(*block) ? Purpose::output
                                                           : Purpose::watch;
    in_round_ = in_round_ || purpose != Purpose::watch;
    Transaction transaction = make_read(purpose, reads_.items()[block->first].row);
    transaction.count = reads_.count_of(*block);
    return transaction;
}

Transaction Poller::Unit::probe() const
{
    Transaction transaction;
    transaction.unit = index_;
    return transaction;
}

/// When nothing else has been asked for a while. A silence that may be the first of a loss is followed up at
/// once.
std::optional<Transaction> Poller::Unit::idle_probe(Instant now) const
{
    if (ever_asked_ && silences_ == 0 && now < probe_due()) return std::nullopt;
    return probe();
}

Transaction Poller::Unit::make_read(Purpose purpose, const Tag* row) const
{
    Transaction transaction;
    transaction.kind = Transaction::Kind::read;
    transaction.purpose = purpose;
    transaction.unit = index_;
    transaction.tag = row;
    return transaction;
}

Transaction Poller::Unit::make_write(Purpose purpose, const Tag* row,
                                     std::span<const std::uint16_t> words) const
{
    Transaction transaction = make_read(purpose, row);
    transaction.kind = Transaction::Kind::write;
    transaction.count = static_cast<std::uint16_t>(words.size());
    transaction.words = words;
    return transaction;
}

Transaction Poller::Unit::make_write(Purpose purpose, const Tag* row, std::uint16_t word)
{
    word_[0] = word;
    return make_write(purpose, row, std::span<const std::uint16_t>{word_});
}

void Poller::Unit::begin_round(Instant now)
{
    if (in_round_ && round_began_) snapshot_.cycle = now - *round_began_;
    round_began_ = now;
    in_round_ = false;
    owes_round_ = false;
    orders_in_round_ = 0;
    reads_.begin_round(now);
    outputs_.begin_round();
}

/// Of a lost drive only what is not asked of it: its probe is the line's business.
Instant Poller::Unit::next_deadline() const
{
    if (lost_) return safe_state_.untold() ? kAtOnce : kNever;
    const bool at_once = !ever_asked_ || silences_ > 0 || demand_.front() != nullptr || !operates_.empty();
    const Instant next = at_once ? kAtOnce
                                 : std::min({probe_due(), survey_.due(), outputs_.next_due(),
                                             safe_state_.next_due(), reads_.next_due()});
    return std::max(next, rests_until_);
}

} // namespace dpslave::drive
