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
constexpr std::size_t kMaxPastLayouts = 4;

std::span<const Parameter> parameters_of(const Layout& layout)
{
    return std::span{layout.parameters}.first(std::min<std::size_t>(layout.count, kMaxParameters));
}

} // namespace

Poller::Unit::Unit(const UnitSettings& settings, BlockRule rule, std::size_t index)
    : settings_(settings), index_(index), reads_(rule), outputs_(settings.output_refresh)
{}

/// The row of the table, or one made for a tag that is in none; valid as long as the unit.
const Tag* Poller::Unit::row_of(std::uint16_t number)
{
    if (const Tag* row = settings_.tags != nullptr ? settings_.tags->find(number) : nullptr) return row;
    return &unlisted_.try_emplace(number, unlisted_tag(number)).first->second;
}

/// What is known without asking the drive. The limits of the table are not among it: for cyclic and Demand
/// Data writes the drive decides, because its own limits may have been set otherwise.
AccessError Poller::Unit::verdict(const Tag& row, bool is_write) const
{
    if (!row.listed && settings_.tags_only_from_table) return AccessError::invalid_tag;
    if (row.type == TagType::string) return AccessError::unsupported_type;
    if (is_write && row.access == Access::read_only) return AccessError::read_only;
    if (!is_write && row.access == Access::write_only) return AccessError::unsupported_type;
    return AccessError::none;
}

bool Poller::Unit::has_ended(Generation generation) const
{
    return left_ && generation != 0 && !is_newer(generation, *left_);
}

// ---- what is wanted

void Poller::Unit::set_outputs(const OutputImage& image)
{
    const bool is_new = image.layout.generation != image_.layout.generation;
    if (is_new) new_layout(image);
    image_ = image;
    outputs_.set(image_.words, image_.may_write);
    if (is_new) show();
}

void Poller::Unit::new_layout(const OutputImage& image)
{
    const Generation old = image_.layout.generation;
    if (old != 0 && !has_ended(old)) {
        past_.push_back({old, output_rows()});
        if (past_.size() > kMaxPastLayouts) past_.erase(past_.begin());
    }
    ++serial_;
    reads_.reset(inputs_of(image.layout));
    outputs_.reset(outputs_of(image.layout));
    if (lost_) {
        reads_.drive_lost();
        outputs_.drive_lost();
    }
    const Generation present = image.layout.generation;
    if (present == 0) {
        demand_.end(old);
    } else if (has_ended(present)) {
        outputs_.stop(); // its end was told before the layout itself
        if (settings_.output_loss == OutputLoss::zero) zero_all(output_rows());
    } else {
        demand_.end(present - 1);
    }
    in_round_ = false;
    round_began_.reset();
    orders_in_round_ = 0;
    snapshot_.cycle = {};
    snapshot_.words = {};
    snapshot_.updated_at = {};
    snapshot_.states = {};
    inputs_changed_ = true;
}

/// Each tag once, however often the layout names it.
std::vector<ReadPlan::Item> Poller::Unit::inputs_of(const Layout& layout)
{
    std::vector<ReadPlan::Item> items;
    for (const Parameter& parameter : parameters_of(layout)) {
        if (!parameter.reads) continue;
        ReadPlan::Item item;
        item.row = row_of(parameter.tag);
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

std::vector<OutputPlan::Item> Poller::Unit::outputs_of(const Layout& layout)
{
    std::vector<OutputPlan::Item> items;
    std::size_t place = 0;
    for (const Parameter& parameter : parameters_of(layout)) {
        OutputPlan::Item item;
        item.parameter = place++;
        if (!parameter.writes) continue;
        item.row = row_of(parameter.tag);
        const AccessError error = verdict(*item.row, true);
        item.asked = error == AccessError::none;
        if (!item.asked) item.state = state_of(error);
        items.push_back(item);
    }
    return items;
}

std::vector<const Tag*> Poller::Unit::output_rows() const
{
    std::vector<const Tag*> rows;
    for (const OutputPlan::Item& item : outputs_.items())
        if (item.asked) rows.push_back(item.row);
    return rows;
}

void Poller::Unit::zero_all(const std::vector<const Tag*>& rows)
{
    for (const Tag* row : rows) outputs_.zero(row);
}

void Poller::Unit::left_data_exchange(Generation generation)
{
    if (generation == 0 || has_ended(generation)) return;
    const bool zeroes = settings_.output_loss == OutputLoss::zero;
    for (const PastLayout& past : past_)
        if (zeroes && !is_newer(past.generation, generation)) zero_all(past.outputs);
    past_.erase(
        std::remove_if(past_.begin(), past_.end(),
                       [generation](const PastLayout& p) { return !is_newer(p.generation, generation); }),
        past_.end());
    const Generation present = image_.layout.generation;
    if (present != 0 && !has_ended(present) && !is_newer(present, generation)) {
        outputs_.stop();
        if (zeroes) zero_all(output_rows());
    }
    demand_.end(generation);
    left_ = generation;
}

void Poller::Unit::set_demand(const DemandOrder& order)
{
    if (has_ended(order.generation)) return;
    const Tag* row = row_of(order.tag);
    demand_.set(order, row, verdict(*row, order.kind == DemandOrder::Kind::write));
}

bool Poller::Unit::operate(const OperateOrder& order)
{
    if (operates_.size() + operate_answers_.size() >= kMaxOperates) return false;
    const Tag* row = row_of(order.tag);
    AccessError error = verdict(*row, order.is_write);
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
    if (const Tag* row = zero_waits_ ? nullptr : outputs_.next_zero())
        return make(Purpose::safe_state, Transaction::Kind::write, row);
    if (auto transaction = ordered()) return transaction;
    return cyclic(now);
}

/// Demand Data first, then dpctl; but after each of them one cyclic transaction, and a standing read once a
/// round.
std::optional<Transaction> Poller::Unit::ordered()
{
    if (order_was_last_) return std::nullopt;
    const DemandQueue::Entry* entry = demand_.front();
    if (entry != nullptr && orders_in_round_ < (entry->answered ? 1 : kOrdersPerRound)) {
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
    const bool due = !ever_asked_ || (silences_ > 0 && !lost_) || now >= asked_at_ + settings_.probe_interval;
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
    const Instant next_probe = asked_at_ + settings_.probe_interval;
    if (lost_) return next_probe;
    const bool something = !ever_asked_ || silences_ > 0 || outputs_.zeros_wait() ||
                           demand_.front() != nullptr || !operates_.empty() || !reads_.empty();
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
        case Purpose::safe_state:
            zero_waits_ = what.error == AccessError::no_answer;
            if (!zero_waits_) outputs_.zeroed(transaction.tag);
            break;
        case Purpose::demand: {
            if (what.error == AccessError::no_answer) break;
            const bool is_read = transaction.kind == Transaction::Kind::read;
            const auto value = is_read && what.error == AccessError::none ? what.words[0] : transaction.word;
            demand_.done(job_.order, what.error, value);
            break;
        }
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

void Poller::Unit::done_input(const Outcome& outcome, Instant now)
{
    if (job_.layout != serial_) return; // read for a layout that is gone
    if (outcome.error == AccessError::no_answer) {
        if (silences_ >= settings_.retries)
            reads_.skip(job_.block); // lost on it: after the return another one goes first
        return;
    }
    if (reads_.done(job_.block, outcome.error, outcome.words, now)) inputs_changed_ = true;
}

void Poller::Unit::done_output(const Transaction& transaction, AccessError error, Instant now)
{
    if (job_.layout != serial_) return;
    if (error == AccessError::no_answer) {
        if (silences_ >= settings_.retries) outputs_.lost_on(job_.output);
        return;
    }
    outputs_.done(job_.output, transaction.word, error, now);
}

void Poller::Unit::done_operate(const Transaction& transaction, const Outcome& outcome)
{
    WaitingOperate& waiting = operates_.front();
    if (outcome.error == AccessError::no_answer && ++waiting.attempts <= settings_.retries) return;
    const bool has_word = outcome.error == AccessError::none && transaction.kind == Transaction::Kind::read;
    operate_answers_.push_back(
        {waiting.order.number, outcome.error, has_word ? outcome.words[0] : transaction.word});
    operates_.pop_front();
}

void Poller::Unit::link(bool answered, Instant now)
{
    if (!answered) {
        if (!lost_ && ++silences_ > settings_.retries) lose();
        return;
    }
    silences_ = 0;
    if (lost_) {
        lost_ = false;
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
