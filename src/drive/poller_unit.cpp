// SPDX-License-Identifier: Apache-2.0
#include "poller_unit.hpp"

#include "generations.hpp"
#include "unit_view.hpp"

#include <algorithm>
#include <limits>

namespace dpslave::drive {
namespace {

/// So many transactions in a row that could not be asked, and the drive rests: what is owed to it needs time.
constexpr int kDeferredAtOnce = 4;
constexpr std::chrono::milliseconds kDeferredRest{5};

} // namespace

Poller::Unit::Unit(const UnitSettings& settings, BlockRule rule, std::size_t index)
    : settings_(settings),
      index_(index),
      tags_(settings),
      cyclic_(tags_.parameters({}), rule,
              {settings.output_refresh, settings.compare_outputs, rule.max_written}),
      safe_state_(settings.zero_after)
{
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
    cyclic_.outputs().set(image_.words, image_.may_write);
    if (image_.may_write && phase_ == Phase::before_data_exchange) phase_ = Phase::waits;
    if (has_ended(image_.layout.generation)) end_layout();
    if (cyclic_.outputs().writes_now() && phase_ != Phase::writing) begin_writing();
    if (is_new) show();
}

void Poller::Unit::new_layout(const OutputImage& image)
{
    left_data_exchange(image_.layout.generation);
    phase_ = Phase::before_data_exchange;
    cyclic_.reset(tags_.parameters(image.layout), link_.is_lost());
    turn_.round_begins();
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
    phase_ = Phase::writing;
    cyclic_.compare(settings_.compare_outputs);
    cyclic_.outputs().for_each_row([this](const Tag* row) { safe_state_.remove(row); });
}

/// Of the present layout nothing is written any more. Its outputs go to the safe state, and only if the
/// master was in Data_Exchange with it: a drive that runs locally is left alone by start-ups that fail.
void Poller::Unit::end_layout()
{
    cyclic_.outputs().stop();
    cyclic_.compare(false);
    if (phase_ != Phase::before_data_exchange && phase_ != Phase::safe) zero_outputs();
}

void Poller::Unit::zero_outputs()
{
    phase_ = Phase::safe;
    cyclic_.outputs().for_each_row([this](const Tag* row) { safe_state_.add(row); });
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
    if (link_.is_lost()) demand_.drop_superseded();
    snapshot_.orders_dropped = demand_.dropped();
}

bool Poller::Unit::operate(const OperateOrder& order)
{
    const Tag* row = tags_.row(order.tag);
    AccessError error = tags_.verdict(*row, order.is_write);
    if (error == AccessError::none && link_.is_lost()) error = AccessError::no_answer;
    return operates_.add(order, row, error);
}

bool Poller::Unit::survey(std::uint32_t number, std::uint16_t tag)
{
    if (!survey_.set(number, *tags_.row(tag))) return false;
    if (link_.is_lost()) survey_.done({.error = AccessError::no_answer, .words = {}}, {});
    return true;
}

// ---- another port, other settings

void Poller::Unit::leave_port()
{
    cyclic_.outputs().leave_port();
    if (phase_ == Phase::writing) zero_outputs();
    safe_state_.cancel_ride_through();
}

/// Nothing is known of what is there: a drive that was lost may answer here, and the other way round.
void Poller::Unit::port_changed()
{
    safe_state_.ride_again();
    if (phase_ == Phase::safe && !has_ended(image_.layout.generation)) phase_ = Phase::waits;
    link_.port_changed();
    cyclic_.port_changed();
    zero_waits_ = false;
    turn_.nothing_cyclic();
    if (cyclic_.outputs().writes_now()) begin_writing();
    show();
}

void Poller::Unit::go_on_as(std::size_t index, const UnitSettings& settings)
{
    index_ = index;
    settings_.retries = settings.retries;
    if (settings == settings_) return;
    UnitTags tags{settings};
    tags.keep_contradicted(tags_);
    cyclic_.exchange(tags.parameters(image_.layout), settings.output_refresh, link_.is_lost());
    const auto row_of = [&tags](const Tag* row) { return tags.row(row->number); };
    safe_state_.exchange(row_of);
    demand_.exchange(row_of);
    operates_.exchange(row_of);
    tags_ = std::move(tags); // rows that are in no table stay where they are
    settings_ = settings;
    snapshot_.watched = {};
    inputs_changed_ = true;
    show();
}

// ---- what next

void Poller::Unit::set_now(Instant now)
{
    safe_state_.set_now(now);
    snapshot_.ride_ends = safe_state_.ride_ends();
}

std::optional<Transaction> Poller::Unit::next(Instant now)
{
    if (now < rests_until_) return std::nullopt;
    auto transaction = asked(now);
    if (!transaction) {
        begin_round(now);
        transaction = asked(now);
    }
    if (!transaction) {
        zero_waits_ = false; // nothing cyclic is there to go first
        turn_.nothing_cyclic();
        transaction = asked(now);
    }
    // Nothing has been asked for a while; or a silence may be the first of a loss.
    if (!transaction && (!link_.is_certain() || now >= probe_due())) transaction = probe();
    owes_round_ = owes_round_ && transaction;
    if (!transaction) return std::nullopt;
    wrote_last_ = wrote_last_ || is_write(*transaction);
    transaction->unit = index_;
    return transaction;
}

/// What this round still has.
std::optional<Transaction> Poller::Unit::asked(Instant now)
{
    if (!zero_waits_) {
        if (const Tag* row = safe_state_.next(now)) return write(Purpose::safe_state, row, 0);
        if (const Tag* row = safe_state_.next_proof(now)) return read_of(Purpose::safe_state, row);
    }
    if (auto order = ordered()) return order;
    std::optional<Transaction> transaction;
    if (wrote_last_) transaction = cyclic_.next_read(now); // fast outputs do not starve inputs
    if (!transaction) transaction = cyclic_.next(now);
    if (!transaction) return std::nullopt;
    wrote_last_ = zero_waits_ = false;
    turn_.cyclic_goes();
    return transaction;
}

/// Demand Data first, then dpctl.
std::optional<Transaction> Poller::Unit::ordered()
{
    const DemandQueue::Entry* demand = demand_.front();
    if (demand != nullptr && turn_.may_go(*demand)) {
        turn_.goes(*demand);
        order_ = demand->order.number;
        return demand->writes_next() ? write(Purpose::demand, demand->row, demand->order.value)
                                     : read_of(Purpose::demand, demand->row);
    }
    const OperateQueue::Entry* operate = operates_.front();
    if (operate == nullptr || !turn_.may_operate()) return std::nullopt;
    turn_.operates();
    return operate->writes_next() ? write(Purpose::operate, operate->row, operate->order.word)
                                  : read_of(Purpose::operate, operate->row);
}

std::optional<Transaction> Poller::Unit::next_survey(Instant now) const
{
    if (link_.is_lost() || survey_.due() > now) return std::nullopt;
    Transaction transaction = read_of(Purpose::survey, survey_.row());
    transaction.unit = index_;
    return transaction;
}

Transaction Poller::Unit::write(Purpose purpose, const Tag* row, std::uint16_t word)
{
    word_[0] = word;
    return write_of(purpose, row, word_);
}

Transaction Poller::Unit::probe() const
{
    Transaction transaction;
    transaction.unit = index_;
    return transaction;
}

void Poller::Unit::begin_round(Instant now)
{
    if (const auto took = cyclic_.begin_round(now)) {
        snapshot_.cycle = *took;
        const auto longest = std::chrono::milliseconds{std::numeric_limits<std::uint32_t>::max()};
        snapshot_.refresh_ms.add(static_cast<std::uint32_t>(
            std::min(std::chrono::ceil<std::chrono::milliseconds>(*took), longest).count()));
    }
    owes_round_ = false;
    turn_.round_begins();
}

/// Of a lost drive only what is not asked of it: its probe is the line's business.
Instant Poller::Unit::next_deadline() const
{
    if (link_.is_lost()) return safe_state_.needs_now() ? kAtOnce : kNever;
    const bool at_once = !link_.is_certain() || demand_.front() != nullptr || operates_.front() != nullptr;
    const Instant next =
        at_once ? kAtOnce
                : std::min({probe_due(), survey_.due(), safe_state_.next_due(), cyclic_.next_due()});
    return std::max(next, rests_until_);
}

// ---- what became of it

void Poller::Unit::done(const Transaction& transaction, const Outcome& outcome, Instant now)
{
    if (transaction.purpose == Purpose::survey)
        return survey_.done(outcome, now); // nothing else follows from it
    Outcome what = outcome;
    if (transaction.kind == Transaction::Kind::read && what.error == AccessError::none &&
        what.words.size() < transaction.count)
        what.error = AccessError::no_answer; // half an answer is none
    what.error = judge(transaction, what);
    if (what.error == AccessError::deferred) {
        defer(transaction, now);
        return show();
    }
    deferred_ = 0;
    asked_at_ = now;
    count(snapshot_, transaction, what.error);
    switch (transaction.purpose) {
        case Purpose::input:
        case Purpose::output:
        case Purpose::watch:
            if (cyclic_.done(transaction, what, {settings_.retries, link_.is_last_try(settings_.retries)},
                             phase_ == Phase::writing, now))
                inputs_changed_ = true;
            break;
        case Purpose::safe_state:
            zero_waits_ =
                safe_state_.done(transaction, what, proven_by_reading(transaction), settings_.retries, now);
            break;
        case Purpose::demand:
            demand_.done(order_, transaction, what, proven_by_reading(transaction), settings_.retries);
            break;
        case Purpose::operate:
            operates_.done(transaction, what, proven_by_reading(transaction), settings_.retries);
            break;
        case Purpose::probe:
        case Purpose::survey: break;
    }
    if (what.error != AccessError::no_answer)
        note_answer(now);
    else
        note_silence();
    show();
}

/// Neither silence nor answer: it is asked again in a later round, and until then what is known is held.
void Poller::Unit::defer(const Transaction& transaction, Instant now)
{
    if (++deferred_ >= kDeferredAtOnce) rests_until_ = now + kDeferredRest;
    if (transaction.purpose == Purpose::safe_state) zero_waits_ = true;
    if (is_cyclic(transaction.purpose)) cyclic_.defer(transaction, now);
}

/// With what the table says of a refusal; and a row that an answer has once contradicted stays refused,
/// whatever answers come later: 12.5 may fit where 12.34 has shown that the decimals are wrong.
AccessError Poller::Unit::judge(const Transaction& transaction, const Outcome& outcome)
{
    const AccessError error = with_reason(transaction, outcome.error);
    if (transaction.tag == nullptr || transaction.count != 1) return error;
    const std::uint16_t tag = transaction.tag->number;
    if (error == AccessError::contradicted) {
        tags_.contradict(tag);
        cyclic_.contradict(transaction.tag, outcome.answer);
        inputs_changed_ = true;
    }
    return error == AccessError::none && tags_.is_contradicted(tag) ? AccessError::contradicted : error;
}

/// Where outputs are not compared the answer to a write names nothing (EI-ASCII): it is no proof.
bool Poller::Unit::proven_by_reading(const Transaction& transaction) const
{
    return !settings_.compare_outputs && tags_.verdict(*transaction.tag, false) == AccessError::none;
}

void Poller::Unit::note_answer(Instant now)
{
    if (link_.answered()) {
        cyclic_.drive_returned(now);
        safe_state_.drive_returned();
        zero_waits_ = wrote_last_ = false;
        turn_.nothing_cyclic();
    }
    if (!snapshot_.answers) inputs_changed_ = true;
    snapshot_.known = true;
    snapshot_.answers = true;
}

void Poller::Unit::note_silence()
{
    if (link_.is_lost()) return;
    cyclic_.hold_reads();
    if (!link_.not_answered(settings_.retries)) return;
    snapshot_.known = true;
    snapshot_.answers = false;
    ++snapshot_.losses;
    inputs_changed_ = true;
    cyclic_.drive_lost();
    demand_.drop_superseded();
    operates_.drive_lost();
    survey_.done({.error = AccessError::no_answer, .words = {}}, {});
}

// ---- what can be seen

std::optional<InputImage> Poller::Unit::take_inputs()
{
    if (!inputs_changed_ || !snapshot_.known) return std::nullopt;
    inputs_changed_ = false;
    InputImage image = inputs(image_.layout, cyclic_.parameters());
    image.scale_missing = image.scale_missing && settings_.unscaled_holds;
    return image;
}

std::optional<OperateAnswer> Poller::Unit::take_operate_answer()
{
    if (auto answer = operates_.take_answer()) return answer;
    return survey_.take();
}

void Poller::Unit::show()
{
    snapshot_.generation = image_.layout.generation;
    snapshot_.orders_dropped = demand_.dropped();
    const int repeats = link_.is_lost() ? 0 : settings_.retries;
    show_parameters(snapshot_, image_.layout, cyclic_.parameters(), repeats);
    show_watched(snapshot_, tags_, cyclic_.parameters(), repeats);
}

} // namespace dpslave::drive
