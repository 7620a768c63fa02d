// SPDX-License-Identifier: Apache-2.0
#include "poller_unit.hpp"

#include "drive_view.hpp"
#include "generations.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace dpslave::drive {
namespace {

constexpr std::array<std::uint16_t, 1> kZero{};

} // namespace

Poller::Unit::Unit(const DriveSettings& settings, BlockRule rule, std::size_t index)
    : settings_(settings),
      index_(index),
      tags_(settings),
      cyclic_(tags_.parameters({}), rule,
              {settings.output_refresh, settings.compare_outputs, rule.max_written}),
      safe_state_(settings.zero_after),
      contact_(settings)
{
    cyclic_.loss_is_a_result(!presence().is_supervised());
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
    if (presence().is_away()) left_data_exchange(image_.layout.generation); // the bus does not know yet
    if (has_ended(image_.layout.generation)) end_layout();
    if (cyclic_.outputs().writes_now() && phase_ != Phase::writing) begin_writing();
    if (is_new) show();
}

void Poller::Unit::new_layout(const OutputImage& image)
{
    left_data_exchange(image_.layout.generation);
    phase_ = Phase::before_data_exchange;
    if (image.layout.generation != 0 && !presence().is_away()) safe_state_.drive_is_used();
    tags_.scales().begin(tags_.depends_on_scales(image.layout));
    cyclic_.reset(tags_.parameters(image.layout), link().is_lost());
    orders_.pacing().round_begins();
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
    cyclic_.outputs().for_each_row([this](const Tag* row) {
        if (!cyclic_.outputs().sent_once().was(*row, 0)) safe_state_.add(row);
    });
}

void Poller::Unit::left_data_exchange(Generation generation)
{
    if (generation == 0 || has_ended(generation)) return;
    ended_ = generation;
    orders_.end(generation);
    if (has_ended(image_.layout.generation)) end_layout();
}

void Poller::Unit::set_demand(const DemandOrder& order)
{
    if (has_ended(order.generation)) return;
    const Tag* row = tags_.row(order.tag);
    orders_.set_demand(order, row, tags_.verdict(*row, order.kind == DemandOrder::Kind::write),
                       link().is_lost());
    snapshot_.orders_dropped = orders_.dropped();
}

bool Poller::Unit::operate(const OperateOrder& order)
{
    const Tag* row = tags_.row(order.tag);
    AccessError error = tags_.verdict(*row, order.is_write);
    if (error == AccessError::none && link().is_lost()) error = AccessError::no_answer;
    return orders_.operate(order, row, error);
}

bool Poller::Unit::survey(std::uint32_t number, std::uint16_t tag, std::optional<MnemonicRule> rule)
{
    return orders_.survey(number, *tags_.row(tag), rule, link().is_lost());
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
    link().port_changed();
    cyclic_.port_changed();
    tags_.scales().begin(tags_.depends_on_scales(image_.layout));
    zero_waits_ = false;
    orders_.pacing().no_cyclic_left();
    if (cyclic_.outputs().writes_now()) begin_writing();
    show();
}

void Poller::Unit::go_on_as(std::size_t index, const DriveSettings& settings)
{
    index_ = index;
    settings_.retries = settings.retries;
    contact_.set(settings);
    cyclic_.loss_is_a_result(!presence().is_supervised());
    if (settings == settings_) return;
    DriveTags tags{settings};
    tags.keep_contradicted(tags_);
    tags_.scales().exchange(settings.scale_registers);
    tags.scales() = tags_.scales();
    tags.scales().begin(tags.depends_on_scales(image_.layout));
    cyclic_.exchange(tags.parameters(image_.layout), settings.output_refresh, link().is_lost());
    const auto row_of = [&tags](const Tag* row) { return tags.row(row->number); };
    safe_state_.exchange(row_of);
    orders_.exchange(row_of);
    tags_ = std::move(tags); // rows that are in no table stay where they are
    settings_ = settings;
    snapshot_.watched = {};
    inputs_changed_ = true;
    show();
}

// ---- what next

bool Poller::Unit::set_now(Instant now)
{
    safe_state_.set_now(now);
    const bool has_decided = note_presence(now);
    snapshot_.ride_ends = safe_state_.ride_ends();
    return has_decided;
}

/// A drive that is gone has lost what the master wanted of it: with silent the station leaves, and nothing is
/// written before it is back.
bool Poller::Unit::note_presence(Instant now)
{
    const bool was_reported = presence().is_reported(), was_away = snapshot_.away;
    if (presence().on_time(now, safe_state_pending())) {
        ++snapshot_.departures;
        if (presence().is_away()) {
            left_data_exchange(image_.layout.generation);
            safe_state_.drive_gone(settings_.zeroes_on_return);
        }
    }
    inputs_changed_ = inputs_changed_ || was_reported != presence().is_reported();
    snapshot_.presence = presence().state();
    snapshot_.away = presence().is_away();
    snapshot_.not_zeroed = presence().state() == DrivePresence::here ? safe_state_.not_zeroed() : 0;
    return was_away != snapshot_.away || was_reported != presence().is_reported();
}

std::optional<Transaction> Poller::Unit::next(Instant now)
{
    if (now < contact_.rests_until()) return std::nullopt;
    auto transaction = probes_next_ ? std::optional{probe()} : asked(now);
    probes_next_ = false;
    if (!transaction) {
        begin_round(now);
        transaction = asked(now);
    }
    if (!transaction) {
        zero_waits_ = false; // nothing cyclic is there to go first
        orders_.pacing().no_cyclic_left();
        transaction = asked(now);
    }
    // Nothing has been asked for a while; or a silence may be the first of a loss.
    if (!transaction && (!link().is_certain() || now >= contact_.probe_due())) transaction = probe();
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
        if (const Tag* row = safe_state_.next(now)) return write_of(Purpose::safe_state, row, kZero);
        if (const Tag* row = safe_state_.next_proof(now)) return read_of(Purpose::safe_state, row);
    }
    // Before anything is written or read whose scale depends on it.
    if (const auto tag = tags_.scales().next(now)) return read_of(Purpose::scale, tags_.row(*tag));
    if (auto order = orders_.next()) return order;
    std::optional<Transaction> transaction;
    if (wrote_last_) transaction = cyclic_.next_read(now); // fast outputs do not starve inputs
    if (!transaction) transaction = cyclic_.next(now);
    if (!transaction) return std::nullopt;
    wrote_last_ = zero_waits_ = false;
    orders_.pacing().cyclic_sent();
    return transaction;
}

std::optional<Transaction> Poller::Unit::next_survey(Instant now) const
{
    if (link().is_lost()) return std::nullopt;
    auto transaction = orders_.next_survey(now);
    if (transaction) transaction->unit = index_;
    return transaction;
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
    orders_.pacing().round_begins();
}

/// Of a lost drive only what is not asked of it: its probe is the line's business.
Instant Poller::Unit::next_deadline() const
{
    if (link().is_lost()) return safe_state_.needs_now() ? kAtOnce : presence().next_deadline();
    const bool at_once = !link().is_certain() || orders_.wait();
    const Instant next =
        at_once ? kAtOnce
                : std::min({contact_.probe_due(), orders_.survey_due(), safe_state_.next_due(),
                            tags_.scales().next_due(), cyclic_.next_due(), presence().next_deadline()});
    return std::max(next, contact_.rests_until());
}

// ---- what became of it

void Poller::Unit::done(const Transaction& transaction, const Outcome& outcome, Instant began, Instant now)
{
    contact_.began(began, now);
    if (transaction.purpose == Purpose::survey) {
        // Only with the next one, if that has no answer either; nothing else follows from it.
        if (outcome.error == AccessError::no_answer) contact_.note_unanswered(outcome, began);
        return orders_.survey_done(outcome, now);
    }
    Outcome what = outcome;
    if (transaction.kind == Transaction::Kind::read && what.error == AccessError::none &&
        what.words.size() < transaction.count)
        what.error = AccessError::no_answer; // half an answer is none
    if (outcome.may_be_older && what.error == AccessError::none && must_be_new(transaction.purpose))
        what.error = AccessError::deferred;
    const AccessError error = what.error = judge(transaction, what);
    if (is_write(transaction) && transaction.tag->once) what.error = end_of_once(what);
    if (what.error == AccessError::deferred) {
        defer(transaction, now);
        return show();
    }
    contact_.asked(began, now);
    count(snapshot_, transaction, error);
    if (error == AccessError::no_answer) contact_.note_unanswered(outcome, began);
    note_sent(transaction, what, now);
    switch (transaction.purpose) {
        case Purpose::input:
        case Purpose::output:
        case Purpose::watch:
            if (cyclic_.done(transaction, what, {settings_.retries, contact_.is_last_try()},
                             phase_ == Phase::writing, now))
                inputs_changed_ = true;
            break;
        case Purpose::safe_state:
            zero_waits_ =
                safe_state_.done(transaction, what, proven_by_reading(transaction), settings_.retries, now);
            break;
        case Purpose::demand:
        case Purpose::operate:
            orders_.done(transaction, what, proven_by_reading(transaction), settings_.retries);
            break;
        case Purpose::scale: note_scale(transaction, what, now); break;
        case Purpose::probe:
        case Purpose::survey: break;
    }
    if (error == AccessError::no_answer)
        note_silence(began, now);
    else if (error == AccessError::none || presence().was_heard_since(began))
        note_answer(now); // a refusal without a word of the drive was never asked of it
    show();
}

/// What the outputs and their safe state have sent to a parameter of which each write counts.
void Poller::Unit::note_sent(const Transaction& transaction, const Outcome& outcome, Instant now)
{
    const bool is_output =
        transaction.purpose == Purpose::output || transaction.purpose == Purpose::safe_state;
    if (is_write(transaction) && is_output && transaction.tag->once && outcome.sent)
        cyclic_.outputs().sent_once().note(*transaction.tag, transaction.words.front(), outcome.error, now);
}

/// A contradiction that is new, or gone, makes others of the parameters: what was read is held.
void Poller::Unit::note_scale(const Transaction& transaction, const Outcome& outcome, Instant now)
{
    inputs_changed_ = true;
    const std::uint16_t tag = transaction.tag->number;
    if (outcome.error == AccessError::no_answer) {
        if (contact_.is_last_try()) tags_.scales().lost_on(tag);
    } else if (tags_.scales().done(tag, outcome, now)) {
        cyclic_.exchange(tags_.parameters(image_.layout), settings_.output_refresh, link().is_lost());
    }
}

/// Neither silence nor answer: it is asked again in a later round, and until then what is known is held.
void Poller::Unit::defer(const Transaction& transaction, Instant now)
{
    if (transaction.purpose == Purpose::safe_state) zero_waits_ = true;
    if (is_cyclic(transaction.purpose)) cyclic_.defer(transaction, now);
    probes_next_ = contact_.defer(now) && transaction.kind != Transaction::Kind::probe;
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

/// What is read first in a layout or behind the return of a drive, and what is ordered, is no value from
/// before that.
bool Poller::Unit::must_be_new(Purpose purpose) const
{
    if (is_cyclic(purpose)) return !cyclic_.was_read();
    return purpose == Purpose::demand || purpose == Purpose::operate;
}

/// Where outputs are not compared the answer to a write names nothing (EI-ASCII): it is no proof.
bool Poller::Unit::proven_by_reading(const Transaction& transaction) const
{
    return !settings_.compare_outputs && tags_.verdict(*transaction.tag, false) == AccessError::none;
}

void Poller::Unit::note_answer(Instant now)
{
    presence().answered(now);
    if (link().answered()) {
        tags_.scales().begin(tags_.depends_on_scales(image_.layout));
        cyclic_.drive_returned(now);
        safe_state_.drive_returned();
        zero_waits_ = wrote_last_ = false;
        orders_.pacing().no_cyclic_left();
    }
    if (!snapshot_.answers) inputs_changed_ = true;
    snapshot_.known = true;
    snapshot_.answers = true;
}

void Poller::Unit::note_silence(Instant began, Instant now)
{
    if (link().is_lost()) return presence().not_answered(began);
    cyclic_.hold_reads();
    inputs_changed_ = inputs_changed_ || !snapshot_.known; // it is found silent
    if (link().not_answered(settings_.retries)) lose(now);
}

void Poller::Unit::lose(Instant now)
{
    snapshot_.known = true;
    snapshot_.answers = false;
    ++snapshot_.losses;
    presence().lost(now);
    inputs_changed_ = true;
    cyclic_.drive_lost();
    orders_.drive_lost();
}

/// Its words are old, and nothing is written to it before it is back, as if it were gone: it may be.
void Poller::Unit::not_asked(Instant now)
{
    orders_.drop_superseded();
    if (!link().is_lost()) {
        link().lose();
        lose(now);
        contact_.ask_at_once();
    }
    if (presence().is_supervised()) {
        presence().not_asked(now);
        note_presence(now);
    }
    show();
}

// ---- what can be seen

std::optional<InputImage> Poller::Unit::take_inputs()
{
    if (!inputs_changed_) return std::nullopt;
    inputs_changed_ = false;
    InputImage image = inputs(image_.layout, cyclic_.parameters(), settings_);
    image.every_input_tried = image.every_input_tried && snapshot_.known;
    image.drive_answers = snapshot_.answers || !link().is_in_doubt();
    image.drive_gone = presence().is_reported();
    image.every_input_tried = image.every_input_tried && tags_.scales().is_over();
    if (settings_.unscaled_holds && tags_.scales().fault()) image.hold = StartHold::unscaled;
    if (presence().is_supervised() && link().is_lost()) image.every_input_tried = false; // gone soon, or back
    return image;
}

void Poller::Unit::show()
{
    snapshot_.generation = image_.layout.generation;
    snapshot_.orders_dropped = orders_.dropped();
    snapshot_.scale_fault = tags_.scales().fault();
    const int repeats = link().is_lost() ? 0 : settings_.retries;
    show_parameters(snapshot_, image_.layout, cyclic_.parameters(), repeats);
    show_watched(snapshot_, tags_, cyclic_.parameters(), repeats);
}

} // namespace dpslave::drive
