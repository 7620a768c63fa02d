// SPDX-License-Identifier: Apache-2.0
/// What became of a transaction, and what can be seen of it.
#include "poller_unit.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

/// So many transactions in a row that could not be asked, and the drive rests: what is owed to it needs time.
constexpr int kDeferredAtOnce = 4;
constexpr std::chrono::milliseconds kDeferredRest{5};

bool is_refusal(AccessError error)
{
    return error != AccessError::none && error != AccessError::no_answer;
}

/// What the answer to an order tells: the word that was read or written.
std::uint16_t word_of(const Transaction& transaction, const Outcome& outcome)
{
    if (transaction.kind == Transaction::Kind::write) return transaction.words.front();
    return outcome.error == AccessError::none ? outcome.words.front() : std::uint16_t{0};
}

/// What the read behind a write says of it; nothing: the drive holds another word. A tag that the drive takes
/// and does not give (EE 04) cannot be proven.
std::optional<AccessError> proof_of(std::uint16_t written, const Outcome& outcome)
{
    if (outcome.error == AccessError::unsupported_type) return AccessError::none;
    if (outcome.error == AccessError::none && outcome.words.front() != written) return std::nullopt;
    return outcome.error;
}

/// Also a value that does not fit: then it is not this word.
bool shows_another_word(std::uint16_t written, const Outcome& outcome)
{
    if (outcome.error == AccessError::none) return outcome.words.front() != written;
    return outcome.error == AccessError::out_of_range || outcome.error == AccessError::value_not_encoded;
}

/// A drive that refuses because it runs, or is not in configuration mode, says the same as for a tag that is
/// read only or a value out of range; only the row of the table tells (EI-ASCII reference, section 4).
AccessError with_reason(const Transaction& transaction, AccessError error)
{
    if (transaction.kind != Transaction::Kind::write || transaction.words.size() != 1) return error;
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

} // namespace

void Poller::Unit::done(const Transaction& transaction, const Outcome& outcome, Instant now)
{
    if (transaction.purpose == Purpose::survey)
        return survey_.done(outcome, now); // nothing else follows from it
    Outcome what = outcome;
    if (transaction.kind == Transaction::Kind::read && what.error == AccessError::none &&
        what.words.size() < transaction.count)
        what.error = AccessError::no_answer; // half an answer is none
    what.error = judged(transaction, what);
    if (what.error == AccessError::deferred) {
        defer(transaction, now);
        return show();
    }
    deferred_ = 0;
    ever_asked_ = true;
    asked_at_ = now;
    count(transaction, what.error);
    switch (transaction.purpose) {
        case Purpose::output:
            if (transaction.kind == Transaction::Kind::write) {
                done_output(what.error, now);
                break;
            }
            [[fallthrough]];
        case Purpose::input:
        case Purpose::watch: done_read(what, now); break;
        case Purpose::safe_state: done_zero(transaction, what, now); break;
        case Purpose::demand: done_demand(transaction, what); break;
        case Purpose::operate: done_operate(transaction, what); break;
        case Purpose::probe:
        case Purpose::survey: break;
    }
    link(what.error != AccessError::no_answer, now);
    show();
}

/// Neither silence nor answer: it is asked again in a later round, and until then what is known is held.
void Poller::Unit::defer(const Transaction& transaction, Instant now)
{
    if (++deferred_ >= kDeferredAtOnce) rests_until_ = now + kDeferredRest;
    const bool is_write = transaction.kind == Transaction::Kind::write;
    switch (transaction.purpose) {
        case Purpose::input:
        case Purpose::output:
        case Purpose::watch:
            if (job_.layout != serial_) break;
            if (is_write)
                outputs_.defer();
            else
                reads_.defer(job_.block, now);
            break;
        case Purpose::safe_state: zero_waits_ = true; break;
        case Purpose::demand:
        case Purpose::operate:
        case Purpose::probe:
        case Purpose::survey: break;
    }
}

/// With what the table says of a refusal; and a row that an answer has once contradicted stays refused,
/// whatever answers come later: 12.5 may fit where 12.34 has shown that the decimals are wrong.
AccessError Poller::Unit::judged(const Transaction& transaction, const Outcome& outcome)
{
    const AccessError error = with_reason(transaction, outcome.error);
    if (transaction.tag == nullptr || transaction.count != 1) return error;
    const std::uint16_t tag = transaction.tag->number;
    if (error == AccessError::contradicted) {
        tags_.contradict(tag);
        reads_.refuse(tag, error, outcome.answer);
        outputs_.refuse(transaction.tag, error);
        inputs_changed_ = true;
    }
    return error == AccessError::none && tags_.is_contradicted(tag) ? AccessError::contradicted : error;
}

void Poller::Unit::count(const Transaction& transaction, AccessError error)
{
    if (error == AccessError::not_understood) ++snapshot_.not_understood;
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

void Poller::Unit::done_read(const Outcome& outcome, Instant now)
{
    if (job_.layout != serial_) return; // read for a layout that is gone
    if (outcome.error == AccessError::no_answer) {
        if (silences_ >= settings_.retries)
            reads_.skip(job_.block); // lost on it: after the return another one goes first
        return;
    }
    if (is_repeated(outcome.error, inputs_not_understood_)) return reads_.hold(job_.block, outcome.error);
    if (reads_.done(job_.block, outcome.error, outcome.words, now, outcome.answer)) inputs_changed_ = true;
    if (writing_) compare(outcome);
}

/// The outputs with what the drive was found to hold.
void Poller::Unit::compare(const Outcome& outcome)
{
    const std::uint16_t from = reads_.items()[job_.block.first].row->number;
    for (std::size_t i = job_.block.first; i <= job_.block.last; ++i) {
        const ReadPlan::Item& item = reads_.items()[i];
        if (!item.compared) continue;
        if (outcome.error == AccessError::none)
            outputs_.observed(item.row, outcome.words[static_cast<std::size_t>(item.row->number - from)],
                              job_.began);
        else if (job_.block.first == job_.block.last)
            outputs_.unreadable(item.row);
    }
}

/// A block is not repeated as such: single writes show what is wrong with which word.
void Poller::Unit::done_output(AccessError error, Instant now)
{
    if (job_.layout != serial_) return;
    if (error == AccessError::no_answer) return outputs_.not_answered(silences_ >= settings_.retries);
    if (!outputs_.writes_block() && is_repeated(error, outputs_not_understood_)) return outputs_.hold(error);
    outputs_.done(error, now);
}

/// A zero that the drive does not hold is treated like one that it has not understood.
void Poller::Unit::done_zero(const Transaction& transaction, const Outcome& outcome, Instant now)
{
    const Tag* const row = transaction.tag;
    AccessError error = outcome.error;
    if (transaction.kind == Transaction::Kind::write) {
        if (error == AccessError::none && proven_by_reading(transaction)) return safe_state_.written(row);
    } else if (shows_another_word(0, outcome)) {
        safe_state_.not_held(row);
        error = AccessError::not_understood;
    }
    zero_waits_ = error == AccessError::no_answer || error == AccessError::not_understood;
    if (error == AccessError::no_answer || is_repeated(error, zeros_not_understood_)) return;
    if (error == AccessError::not_understood)
        safe_state_.postpone(row, now);
    else
        safe_state_.remove(row);
}

void Poller::Unit::done_demand(const Transaction& transaction, const Outcome& outcome)
{
    if (outcome.error == AccessError::no_answer) return;
    if (outcome.error == AccessError::not_understood) {
        demand_.not_understood(job_.order, settings_.retries);
        return;
    }
    const bool is_write = transaction.kind == Transaction::Kind::write;
    const auto* entry = demand_.front();
    if (is_write && outcome.error == AccessError::none && proven_by_reading(transaction))
        return demand_.written(job_.order);
    const bool proves = !is_write && entry != nullptr && entry->order.number == job_.order && entry->written;
    if (!proves) return demand_.done(job_.order, outcome.error, word_of(transaction, outcome));
    const std::uint16_t written = entry->order.value;
    const auto proof = proof_of(written, outcome);
    if (proof) return demand_.done(job_.order, *proof, written);
    demand_.not_held(job_.order, settings_.retries);
}

/// Where outputs are not compared the answer to a write names nothing (EI-ASCII): it is no proof.
bool Poller::Unit::proven_by_reading(const Transaction& transaction) const
{
    return !settings_.compare_outputs && tags_.verdict(*transaction.tag, false) == AccessError::none;
}

void Poller::Unit::done_operate(const Transaction& transaction, const Outcome& outcome)
{
    WaitingOperate& waiting = operates_.front();
    const bool may_pass =
        outcome.error == AccessError::no_answer || outcome.error == AccessError::not_understood;
    if (may_pass && ++waiting.attempts <= settings_.retries) return;
    const bool is_write = transaction.kind == Transaction::Kind::write;
    if (is_write && outcome.error == AccessError::none && proven_by_reading(transaction)) {
        waiting.written = true;
        return;
    }
    OperateAnswer answer{waiting.order.number, outcome.error, word_of(transaction, outcome)};
    if (waiting.written) {
        const auto proof = proof_of(waiting.order.word, outcome);
        waiting.written = false;
        if (!proof && ++waiting.attempts <= settings_.retries) return; // it does not hold it: written again
        answer = {waiting.order.number, proof.value_or(AccessError::not_kept), waiting.order.word};
    }
    operate_answers_.push_back(answer);
    operates_.pop_front();
}

void Poller::Unit::link(bool answered, Instant now)
{
    if (!answered) {
        if (lost_) return;
        reads_.hold_all();
        if (++silences_ > settings_.retries) lose();
        return;
    }
    silences_ = 0;
    if (lost_) {
        lost_ = false;
        reads_.drive_returned(now);
        outputs_.drive_returned();
        safe_state_.drive_returned();
        outputs_.begin_round(); // they go before the rest of the reads
        round_began_.reset();
        order_was_last_ = zero_waits_ = wrote_last_ = false;
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
    survey_.done({.error = AccessError::no_answer, .words = {}}, {});
}

// ---- what can be seen

std::optional<InputImage> Poller::Unit::take_inputs()
{
    if (!inputs_changed_ || !snapshot_.known) return std::nullopt;
    inputs_changed_ = false;
    InputImage image;
    image.generation = image_.layout.generation;
    image.drive_answers = snapshot_.answers;
    image.every_input_tried = reads_.every_input_tried();
    image.scale_missing = settings_.unscaled_holds && reads_.scale_missing();
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
    if (operate_answers_.empty()) return survey_.take();
    const OperateAnswer first = operate_answers_.front();
    operate_answers_.pop_front();
    return first;
}

void Poller::Unit::show()
{
    snapshot_.generation = image_.layout.generation;
    snapshot_.orders_dropped = demand_.dropped();
    for (const OutputPlan::Item& item : outputs_.items()) {
        snapshot_.words[item.parameter] = item.written;
        snapshot_.states[item.parameter] = item.state;
        snapshot_.errors[item.parameter] = item.error;
        snapshot_.repeated[item.parameter] = is_only_repeated(item.state, item.failures);
        snapshot_.updated_at[item.parameter] = item.updated_at;
        show_form(item);
    }
    show_inputs();
    show_watched();
}

/// A repetition mends it as a rule.
bool Poller::Unit::is_only_repeated(WordState state, int failures) const
{
    return state == WordState::stale && !lost_ && failures > 0 && failures <= settings_.retries;
}

/// Of an output that waits for its form: what the drive has answered.
void Poller::Unit::show_form(const OutputPlan::Item& output)
{
    const auto found = output.row != nullptr ? reads_.find(output.row->number) : std::nullopt;
    if (!found) return;
    const ReadPlan::Item& item = reads_.items()[*found];
    snapshot_.answer_texts[output.parameter] = item.answer;
    if (!item.form || output.state != WordState::untried || item.state != WordState::unscaled) return;
    snapshot_.states[output.parameter] = item.state;
    snapshot_.errors[output.parameter] = item.error;
}

/// Of a parameter that is both read and written the refusal of a write is shown, else the read.
void Poller::Unit::show_inputs()
{
    const std::span<const Parameter> parameters = parameters_of(image_.layout);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const Parameter& parameter = parameters[i];
        const auto found = parameter.reads ? reads_.find(parameter.tag) : std::nullopt;
        if (!found) continue;
        const ReadPlan::Item& item = reads_.items()[*found];
        snapshot_.words[i] = item.word;
        snapshot_.updated_at[i] = item.updated_at;
        snapshot_.answer_texts[i] = item.answer;
        if (parameter.writes && snapshot_.states[i] != WordState::stale && is_refusal(snapshot_.errors[i]))
            continue;
        snapshot_.states[i] = item.state;
        snapshot_.errors[i] = item.error;
        snapshot_.repeated[i] = is_only_repeated(item.state, item.failures);
    }
}

/// A new layout reads them anew: until then, and while the drive is silent, the last word stands.
void Poller::Unit::show_watched()
{
    const std::vector<std::uint16_t>& tags = tags_.watched();
    for (std::size_t i = 0; i < tags.size(); ++i) {
        snapshot_.watched[i].tag = tags[i];
        const auto found = reads_.find(tags[i]);
        if (!found) continue;
        const ReadPlan::Item& item = reads_.items()[*found];
        if (item.state == WordState::untried) continue;
        snapshot_.watched[i].state = item.state;
        snapshot_.watched[i].repeated = is_only_repeated(item.state, item.failures);
        if (item.state == WordState::good) snapshot_.watched[i].word = item.word;
    }
}

} // namespace dpslave::drive
