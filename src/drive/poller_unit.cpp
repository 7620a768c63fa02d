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
/// Several dead drives on one line must not eat it: their probes come more and more seldom.
constexpr int kMaxProbeFactor = 8;

} // namespace

Poller::Unit::Unit(const UnitSettings& settings, BlockRule rule, std::size_t index)
    : settings_(settings),
      index_(index),
      tags_(settings.tags, settings.tags_only_from_table),
      reads_(rule),
      outputs_(settings.output_refresh),
      probe_wait_(settings.probe_interval)
{}

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
    if (is_new) show();
}

void Poller::Unit::new_layout(const OutputImage& image)
{
    left_data_exchange(image_.layout.generation);
    ++serial_;
    reads_.reset(tags_.inputs_of(image.layout));
    outputs_.reset(tags_.outputs_of(image.layout));
    if (lost_) {
        reads_.drive_lost();
        outputs_.drive_lost();
    }
    master_wrote_ = zeroed_ = false;
    inputs_not_understood_ = outputs_not_understood_ = 0;
    in_round_ = false;
    round_began_.reset();
    orders_in_round_ = 0;
    snapshot_.cycle = {};
    snapshot_.words = {};
    snapshot_.updated_at = {};
    snapshot_.states = {};
    inputs_changed_ = true;
}

/// Of the present layout nothing is written any more. Its outputs are zeroed once, and only if the master was
/// in Data_Exchange with it: a drive that runs locally is left alone by start-ups that fail.
void Poller::Unit::end_layout()
{
    outputs_.stop();
    if (!master_wrote_ || zeroed_ || settings_.output_loss != OutputLoss::zero) return;
    zeroed_ = true;
    for (const OutputPlan::Item& item : outputs_.items())
        if (item.asked) outputs_.zero(item.row);
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
        operates_.push_back({order, row, 0});
    else
        operate_answers_.push_back({order.number, error, 0});
    return true;
}

// ---- what next

std::optional<Transaction> Poller::Unit::next(Instant now)
{
    if (lost_) return probe(now);
    if (auto transaction = asked(now)) return transaction;
    begin_round(now);
    if (auto transaction = asked(now)) return transaction;
    order_was_last_ = zero_waits_ = false; // nothing cyclic is there to go first
    if (auto transaction = asked(now)) return transaction;
    return probe(now);
}

/// What this round still has.
std::optional<Transaction> Poller::Unit::asked(Instant now)
{
    if (const Tag* row = zero_waits_ ? nullptr : outputs_.next_zero(now))
        return make(Purpose::safe_state, Transaction::Kind::write, row);
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
        const bool is_write = entry->order.kind == DemandOrder::Kind::write;
        const auto kind = is_write ? Transaction::Kind::write : Transaction::Kind::read;
        return make(Purpose::demand, kind, entry->row, is_write ? entry->order.value : std::uint16_t{0});
    }
    if (!operates_.empty()) {
        order_was_last_ = true;
        const WaitingOperate& waiting = operates_.front();
        job_.order = waiting.order.number;
        const auto kind = waiting.order.is_write ? Transaction::Kind::write : Transaction::Kind::read;
        return make(Purpose::operate, kind, waiting.row, waiting.order.word);
    }
    return std::nullopt;
}

/// Outputs before inputs. As an output is written once a round at most, one that changes all the time takes
/// no more than its own share of the cycle.
std::optional<Transaction> Poller::Unit::cyclic(Instant now)
{
    job_.layout = serial_;
    if (!round_began_) round_began_ = now;
    if (const auto output = outputs_.next(now)) {
        order_was_last_ = zero_waits_ = false;
        outputs_.started(*output, now);
        job_.output = *output;
        const OutputPlan::Item& item = outputs_.items()[*output];
        return make(Purpose::output, Transaction::Kind::write, item.row, item.wanted);
    }
    if (const auto block = reads_.next(now)) {
        order_was_last_ = zero_waits_ = false;
        in_round_ = true;
        job_.block = *block;
        Transaction transaction =
            make(Purpose::input, Transaction::Kind::read, reads_.items()[block->first].row);
        transaction.count = reads_.count_of(*block);
        return transaction;
    }
    return std::nullopt;
}

/// While lost, and when nothing else has been asked for a while. A silence that may be the first of a loss is
/// followed up at once.
std::optional<Transaction> Poller::Unit::probe(Instant now)
{
    const bool due = !ever_asked_ || (silences_ > 0 && !lost_) || now >= asked_at_ + probe_wait_;
    if (!due) return std::nullopt;
    return make(Purpose::probe, Transaction::Kind::probe, nullptr);
}

Transaction Poller::Unit::make(Purpose purpose, Transaction::Kind kind, const Tag* row,
                               std::uint16_t word) const
{
    Transaction transaction;
    transaction.kind = kind;
    transaction.purpose = purpose;
    transaction.unit = index_;
    transaction.tag = row;
    transaction.word = word;
    return transaction;
}

void Poller::Unit::begin_round(Instant now)
{
    if (in_round_ && round_began_) snapshot_.cycle = now - *round_began_;
    round_began_ = now;
    in_round_ = false;
    orders_in_round_ = 0;
    reads_.begin_round();
    outputs_.begin_round();
}

Instant Poller::Unit::next_deadline() const
{
    const Instant next_probe = asked_at_ + probe_wait_;
    if (lost_) return next_probe;
    const bool something =
        !ever_asked_ || silences_ > 0 || demand_.front() != nullptr || !operates_.empty() || !reads_.empty();
    if (something) return kAtOnce;
    return std::min({next_probe, outputs_.next_due(), reads_.next_retry()});
}

// ---- what became of it

void Poller::Unit::done(const Transaction& transaction, const Outcome& outcome, Instant now)
{
    Outcome what = outcome;
    if (transaction.kind == Transaction::Kind::read && what.error == AccessError::none &&
        what.words.size() < transaction.count)
        what.error = AccessError::no_answer; // half an answer is none
    ever_asked_ = true;
    asked_at_ = now;
    count(transaction, what.error);
    switch (transaction.purpose) {
        case Purpose::input: done_input(what, now); break;
        case Purpose::output: done_output(transaction, what.error, now); break;
        case Purpose::safe_state: done_zero(transaction.tag, what.error, now); break;
        case Purpose::demand: done_demand(transaction, what); break;
        case Purpose::operate: done_operate(transaction, what); break;
        case Purpose::probe: break;
    }
    link(what.error != AccessError::no_answer, now);
    show();
}

void Poller::Unit::count(const Transaction& transaction, AccessError error)
{
    if (error == AccessError::no_answer)
        ++snapshot_.silences;
    else if (error != AccessError::none)
        ++snapshot_.refusals;
    else if (transaction.kind == Transaction::Kind::read)
        ++snapshot_.reads;
    else if (transaction.kind == Transaction::Kind::write)
        ++snapshot_.writes;
}

/// What the drive did not understand is repeated like silence. When that does not help it is left to later:
/// the drive is there, and the others go on.
bool Poller::Unit::is_repeated(AccessError error, int& not_understood) const
{
    not_understood = error == AccessError::not_understood ? not_understood + 1 : 0;
    if (not_understood <= settings_.retries) return not_understood > 0;
    not_understood = 0;
    return false;
}

void Poller::Unit::done_input(const Outcome& outcome, Instant now)
{
    if (job_.layout != serial_) return; // read for a layout that is gone
    if (outcome.error == AccessError::no_answer) {
        if (silences_ >= settings_.retries)
            reads_.skip(job_.block); // lost on it: after the return another one goes first
        return;
    }
    if (is_repeated(outcome.error, inputs_not_understood_)) return;
    if (reads_.done(job_.block, outcome.error, outcome.words, now)) inputs_changed_ = true;
}

void Poller::Unit::done_output(const Transaction& transaction, AccessError error, Instant now)
{
    if (job_.layout != serial_) return;
    if (error == AccessError::no_answer) {
        if (silences_ >= settings_.retries) outputs_.lost_on(job_.output);
        return;
    }
    if (is_repeated(error, outputs_not_understood_)) return;
    outputs_.done(job_.output, transaction.word, error, now);
}

void Poller::Unit::done_zero(const Tag* row, AccessError error, Instant now)
{
    zero_waits_ = error == AccessError::no_answer || error == AccessError::not_understood;
    if (error == AccessError::no_answer || is_repeated(error, zeros_not_understood_)) return;
    if (error == AccessError::not_understood)
        outputs_.postpone_zero(row, now);
    else
        outputs_.zeroed(row);
}

void Poller::Unit::done_demand(const Transaction& transaction, const Outcome& outcome)
{
    if (outcome.error == AccessError::no_answer) return;
    if (outcome.error == AccessError::not_understood) {
        demand_.not_understood(job_.order, settings_.retries);
        return;
    }
    const bool has_word = outcome.error == AccessError::none && transaction.kind == Transaction::Kind::read;
    demand_.done(job_.order, outcome.error, has_word ? outcome.words[0] : transaction.word);
}

void Poller::Unit::done_operate(const Transaction& transaction, const Outcome& outcome)
{
    WaitingOperate& waiting = operates_.front();
    const bool may_pass =
        outcome.error == AccessError::no_answer || outcome.error == AccessError::not_understood;
    if (may_pass && ++waiting.attempts <= settings_.retries) return;
    const bool has_word = outcome.error == AccessError::none && transaction.kind == Transaction::Kind::read;
    operate_answers_.push_back(
        {waiting.order.number, outcome.error, has_word ? outcome.words[0] : transaction.word});
    operates_.pop_front();
}

void Poller::Unit::link(bool answered, Instant now)
{
    if (!answered) {
        if (lost_)
            probe_wait_ = std::min(2 * probe_wait_, kMaxProbeFactor * settings_.probe_interval);
        else if (++silences_ > settings_.retries)
            lose();
        return;
    }
    silences_ = 0;
    if (lost_) {
        lost_ = false;
        probe_wait_ = settings_.probe_interval;
        reads_.drive_returned(now);
        outputs_.drive_returned();
        outputs_.begin_round(); // they go before the rest of the reads
        round_began_.reset();
        order_was_last_ = zero_waits_ = false;
    }
    if (!snapshot_.answers) inputs_changed_ = true;
    snapshot_.known = true;
    snapshot_.answers = true;
}

void Poller::Unit::lose()
{
    lost_ = true;
    silences_ = 0;
    in_round_ = false;
    snapshot_.known = true;
    snapshot_.answers = false;
    ++snapshot_.losses;
    inputs_changed_ = true;
    reads_.drive_lost();
    outputs_.drive_lost();
    demand_.drop_superseded();
    for (const WaitingOperate& waiting : operates_)
        operate_answers_.push_back({waiting.order.number, AccessError::no_answer, 0});
    operates_.clear();
}

// ---- what can be seen

std::optional<InputImage> Poller::Unit::take_inputs()
{
    if (!inputs_changed_ || !snapshot_.known) return std::nullopt;
    inputs_changed_ = false;
    InputImage image;
    image.generation = image_.layout.generation;
    image.drive_answers = snapshot_.answers;
    image.every_input_tried = reads_.every_item_tried();
    const std::span<const Parameter> parameters = parameters_of(image_.layout);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const Parameter& parameter = parameters[i];
        if (!parameter.reads) continue;
        if (const auto item = reads_.find(parameter.tag)) image.words[i] = reads_.items()[*item].word;
    }
    return image;
}

std::optional<OperateAnswer> Poller::Unit::take_operate_answer()
{
    if (operate_answers_.empty()) return std::nullopt;
    const OperateAnswer first = operate_answers_.front();
    operate_answers_.pop_front();
    return first;
}

/// Of a parameter that is both read and written the refusal of a write is shown, else the read.
void Poller::Unit::show()
{
    snapshot_.generation = image_.layout.generation;
    snapshot_.orders_dropped = demand_.dropped();
    for (const OutputPlan::Item& item : outputs_.items()) {
        snapshot_.words[item.parameter] = item.written;
        snapshot_.states[item.parameter] = item.state;
        snapshot_.updated_at[item.parameter] = item.updated_at;
    }
    const std::span<const Parameter> parameters = parameters_of(image_.layout);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const Parameter& parameter = parameters[i];
        const auto found = parameter.reads ? reads_.find(parameter.tag) : std::nullopt;
        if (!found) continue;
        const ReadPlan::Item& item = reads_.items()[*found];
        const WordState written = parameter.writes ? snapshot_.states[i] : WordState::untried;
        const bool refused = written == WordState::read_only || written == WordState::out_of_range ||
                             written == WordState::refused;
        snapshot_.words[i] = item.word;
        snapshot_.updated_at[i] = item.updated_at;
        if (!refused) snapshot_.states[i] = item.state;
    }
}

} // namespace dpslave::drive
