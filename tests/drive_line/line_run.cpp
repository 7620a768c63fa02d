// SPDX-License-Identifier: Apache-2.0
#include "line_run.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::drive_line {
namespace {

/// The drive thread looks this often for something new from the bus.
constexpr Time kTick = 1ms;
constexpr unsigned kMostWithoutTime = 1'000;

std::vector<drive::DriveSettings>
settings_of(const SimulatedLine& line, const std::vector<drive::TagTable>& tables, const RunRules& rules)
{
    std::vector<drive::DriveSettings> all;
    for (std::size_t i = 0; i < line.drives.size(); ++i) {
        drive::DriveSettings unit;
        unit.address = {0, line.drives[i].unit};
        unit.tags = &tables[i];
        unit.output_refresh = rules.output_refresh;
        unit.zero_after = i < rules.zero_after.size() ? rules.zero_after[i] : drive::ZeroAfter{0ns};
        unit.compare_outputs = rules.compare_outputs;
        unit.watched = rules.watched;
        unit.retries = rules.retries;
        unit.loss = rules.loss;
        unit.zeroes_on_return = unit.zero_after.has_value();
        unit.decides_every = line.rules().timeout;
        if (rules.loss.when != drive::WhenLost::hold) unit.probe_interval = 10 * line.rules().timeout;
        all.push_back(unit);
    }
    return all;
}

} // namespace

LineRun::LineRun(SimulatedLine& line, drive::Backend& backend, const std::vector<drive::TagTable>& tables,
                 const RunRules& rules)
    : line_(line),
      backend_(backend),
      rules_(rules),
      settings_(settings_of(line, tables, rules)),
      poller_(settings_, backend.block_rule()),
      judge_(line),
      loss_judge_(line, rules.loss, rules.retries),
      masters_(line.drives.size()),
      words_(std::max<std::size_t>(backend.block_rule().max_tags, 1))
{}

void LineRun::report_violation(const std::string& text)
{
    if (!violation_) violation_ = text;
}

// ---- the drive thread

void LineRun::live(std::uint64_t transactions)
{
    while (transactions_ < transactions && !violation_ && !line_.words().used_up()) step(kNever);
}

void LineRun::live_for(Time duration)
{
    const Instant end = line_.time + duration;
    while (line_.time < end && !violation_) step(end);
}

/// One turn of the drive thread.
void LineRun::step(Instant until)
{
    if (rules_.masters_act && line_.time >= act_at_) act();
    const Instant before = line_.time;
    note_presence();
    const auto transaction = poller_.next(line_.time);
    if (transaction) carry_out(*transaction);
    publish();
    if (!transaction) {
        const Instant next =
            std::clamp(poller_.next_deadline(), line_.time + kTick / 10, line_.time + 10 * kTick);
        line_.pass_until(std::min(next, std::max(until, line_.time + 1us)));
        backend_.listen(); // as when octets come on the port
    }
    without_time_ = line_.time > before ? 0 : without_time_ + 1;
    if (without_time_ > kMostWithoutTime)
        report_violation("the drive side is busy without end, and no time passes");
    if (judge_.violation()) report_violation(*judge_.violation());
    if (loss_judge_.violation()) report_violation(*loss_judge_.violation());
}

void LineRun::carry_out(const drive::Transaction& transaction)
{
    using Kind = drive::Transaction::Kind;
    const drive::UnitAddress address{0, line_.drives[transaction.unit].unit};
    const Instant began = line_.time;
    ++transactions_;
    drive::Outcome outcome;
    switch (transaction.kind) {
        case Kind::read: {
            const std::span<std::uint16_t> words = std::span{words_}.first(transaction.count);
            outcome.error = backend_.read(address, *transaction.tag, words);
            outcome.words = words;
            break;
        }
        case Kind::write:
            outcome.error = transaction.once
                                ? backend_.write_once(address, *transaction.tag, transaction.words.first<1>())
                                : backend_.write(address, *transaction.tag, transaction.words);
            outcome.sent = backend_.has_sent();
            break;
        case Kind::probe: outcome.error = backend_.probe(address); break;
    }
    outcome.questions = backend_.questions();
    if (line_.traces())
        line_.trace(fmt::format("{:.1f} ms:    drive {} {} {} x{}: error {} {}",
                                double(line_.time.time_since_epoch().count()) / 1e6, transaction.unit,
                                transaction.kind == Kind::read    ? "read"
                                : transaction.kind == Kind::write ? "write"
                                                                  : "probe",
                                transaction.tag != nullptr ? transaction.tag->number : 0, transaction.count,
                                static_cast<int>(outcome.error), backend_.last_trouble()));
    note_presence();
    poller_.done(outcome, line_.time);
    if (outcome.error != AccessError::no_answer && outcome.error != AccessError::deferred)
        loss_judge_.answered(transaction.unit);
    judge_.attempted(transaction, outcome.error, began);
    if (on_transaction) on_transaction(transaction, outcome.error, began);
}

void LineRun::publish()
{
    for (std::size_t i = 0; i < masters_.size(); ++i) {
        if (const auto inputs = poller_.take_inputs(i)) {
            judge_.shown(i, *inputs);
            loss_judge_.shown(i, masters_[i].image.layout, *inputs);
        }
        while (const auto answer = poller_.take_demand_answer(i)) judge_.answered(i, *answer);
        judge_.shown(i, poller_.snapshot(i), rules_.watched);
    }
    while (const auto answer = poller_.take_operate_answer())
        if (answer->number < kFirstSurvey) judge_.answered(*answer);
    for (std::size_t i = 0; i < masters_.size(); ++i) {
        loss_judge_.shown(i, poller_.snapshot(i));
        if (poller_.snapshot(i).away) leave(i);
    }
    note_presence();
}

/// As the drive thread does it.
void LineRun::note_presence()
{
    for (std::size_t i = 0; i < masters_.size(); ++i) {
        const Instant at = backend_.counts({0, line_.drives[i].unit}).valid_at;
        if (at != Instant{}) poller_.heard(i, at);
    }
}

// ---- what the masters want

void LineRun::enter(std::size_t drive, const std::vector<LayoutEntry>& parameters)
{
    Master& master = masters_[drive];
    master.image = {};
    master.image.layout.generation = ++generation_;
    for (const LayoutEntry& parameter : parameters)
        master.image.layout.parameters[master.image.layout.count++] = parameter;
    line_.trace(fmt::format("the master of drive {} chooses layout {}", drive, generation_));
    poller_.set_outputs(drive, master.image);
    judge_.set_outputs(drive, master.image);
    loss_judge_.entered(drive);
}

void LineRun::change(std::size_t drive)
{
    Master& master = masters_[drive];
    master.image.may_write = true;
    for (std::size_t i = 0; i < master.image.layout.count; ++i) {
        const bool is_new = master.image.words[i] == 0 || !line_.chance().one_in(3);
        if (!master.image.layout.parameters[i].writes || !is_new) continue;
        master.image.words[i] = line_.words().take();
        if (line_.traces())
            line_.trace(fmt::format("the master of drive {} wants {:04X} in tag {}", drive,
                                    master.image.words[i], master.image.layout.parameters[i].tag));
    }
    judge_.set_outputs(drive, master.image);
    poller_.set_outputs(drive, master.image);
}

void LineRun::leave(std::size_t drive)
{
    Master& master = masters_[drive];
    if (master.image.layout.generation == 0) return;
    line_.trace(fmt::format("the master of drive {} leaves", drive));
    const bool goes_to_zero = drive >= rules_.zero_after.size() || rules_.zero_after[drive].has_value();
    judge_.left(drive, goes_to_zero);
    poller_.left_data_exchange(drive, {master.image.layout.generation});
    loss_judge_.left(drive, master.image, goes_to_zero);
    master.image = {};
    judge_.set_outputs(drive, master.image);
    poller_.set_outputs(drive, master.image);
}

/// A request of the master or of the operator, or a fault of a drive.
void LineRun::act()
{
    Chance& chance = line_.chance();
    act_at_ = line_.time + chance.between(1ms, 250ms);
    for (std::size_t i = 0; i < masters_.size(); ++i)
        if (masters_[i].returns_at <= line_.time) {
            masters_[i].returns_at = kNever;
            line_.returns(i, chance.one_in(2));
        }
    const std::size_t drive = chance.below(masters_.size());
    if (rules_.loss.when != drive::WhenLost::hold && chance.one_in(4)) return disturb_presence(drive);
    if (poller_.snapshot(drive).away) return;
    const bool exchanges = masters_[drive].image.layout.generation != 0;
    if (!exchanges) return choose_layout(drive);
    switch (chance.below(40)) {
        case 0: return choose_layout(drive);
        case 1: return leave(drive);
        case 2:
        case 3: return disturb(drive);
        case 4:
        case 5: return operate(drive);
        case 6:
        case 7:
        case 8:
        case 9:
        case 10:
        case 11:
        case 12: return order(drive);
        default: return change(drive);
    }
}

void LineRun::choose_layout(std::size_t drive)
{
    if (masters_[drive].image.layout.generation != 0 && line_.chance().one_in(2)) leave(drive);
    std::vector<LayoutEntry> parameters;
    for (const SimulatedTag& tag : line_.drives[drive].tags) {
        if ((tag.use != TagUse::input && tag.use != TagUse::output) || line_.chance().one_in(3)) continue;
        const bool writes = tag.use == TagUse::output;
        parameters.push_back({tag.number, !writes || line_.chance().one_in(3), writes});
    }
    if (masters_[drive].image.may_write)
        judge_.left(drive, drive >= rules_.zero_after.size() || rules_.zero_after[drive].has_value());
    enter(drive, parameters);
}

void LineRun::order(std::size_t drive)
{
    Chance& chance = line_.chance();
    Master& master = masters_[drive];
    const auto& tags = line_.drives[drive].tags;
    DemandOrder order;
    order.number = ++master.orders;
    order.generation = master.image.layout.generation;
    const SimulatedTag& tag = tags[chance.below(tags.size())];
    order.tag = tag.number;
    const std::size_t what = chance.below(4);
    order.kind = what == 0 ? DemandOrder::Kind::cancel : DemandOrder::Kind::read;
    if (what == 1 && tag.use == TagUse::demand) {
        order.kind = DemandOrder::Kind::write;
        order.value = line_.words().take();
    }
    if (line_.traces())
        line_.trace(fmt::format("order {} for drive {}: {} tag {} {:04X}", order.number, drive,
                                order.kind == DemandOrder::Kind::write  ? "write"
                                : order.kind == DemandOrder::Kind::read ? "read"
                                                                        : "cancel",
                                order.tag, order.value));
    judge_.ordered(drive, order);
    poller_.set_demand(drive, order);
}

void LineRun::operate(std::size_t drive)
{
    Chance& chance = line_.chance();
    const auto& tags = line_.drives[drive].tags;
    const SimulatedTag& tag = tags[chance.below(tags.size())];
    drive::OperateOrder order{
        .number = ++operates_, .unit = drive, .is_write = false, .tag = tag.number, .word = 0};
    if (tag.use == TagUse::operated && chance.one_in(2)) {
        order.is_write = true;
        order.word = line_.words().take();
    }
    judge_.operates(order);
    if (!poller_.operate(order)) --operates_;
}

void LineRun::disturb(std::size_t drive)
{
    Chance& chance = line_.chance();
    SimulatedDrive& one = line_.drives[drive];
    SimulatedTag& tag = one.tags[chance.below(one.tags.size())];
    switch (chance.below(6)) {
        case 0:
            if (!one.alive) return;
            line_.dies(drive);
            masters_[drive].returns_at =
                line_.time + (chance.one_in(4) ? chance.between(5s, 60s) : chance.between(50ms, 4s));
            return;
        case 1:
            if (one.alive) line_.returns(drive, true); // a moment without power
            return;
        case 2:
        case 3: return line_.denies(tag, !tag.now().denied);
        case 4: return line_.refuses(tag, !tag.refuses);
        default: return;
    }
}

/// What must not make a station leave, and what has to.
void LineRun::disturb_presence(std::size_t drive)
{
    Chance& chance = line_.chance();
    SimulatedDrive& one = line_.drives[drive];
    switch (chance.below(5)) {
        case 0:
        case 1:
            if (!one.alive) return;
            ++silences_;
            line_.dies(drive);
            masters_[drive].returns_at = line_.time + chance.between(50ms, 4 * rules_.loss.after);
            return;
        case 2:
            if (one.answers_every == 0ns) ++silences_;
            one.answers_every =
                one.answers_every != 0ns ? 0ns : chance.between(rules_.loss.after / 4, rules_.loss.after);
            return;
        case 3: {
            const SimulatedTag& tag = one.tags[chance.below(one.tags.size())];
            poller_.survey(drive, ++surveys_, tag.number);
            return;
        }
        default: { // a reload that changes nothing
            std::vector<std::optional<std::size_t>> stays;
            for (std::size_t i = 0; i < masters_.size(); ++i) stays.emplace_back(i);
            poller_.exchange(settings_, stays, backend_.block_rule());
        }
    }
}

// ---- the end

void LineRun::settle(Time limit)
{
    if (violation_) return;
    line_.trace("all faults end");
    line_.faults = {};
    rules_.masters_act = false;
    for (std::size_t i = 0; i < masters_.size(); ++i) {
        SimulatedDrive& drive = line_.drives[i];
        if (!drive.alive) line_.returns(i, true);
        for (SimulatedTag& tag : drive.tags)
            if (tag.refuses) line_.refuses(tag, false);
        drive.live_until(line_.time, line_.words(), line_.chance());
        drive.stands_still();
        drive.answers_every = {};
    }
    const Instant end = line_.time + limit;
    std::string wrong;
    for (Time wait = 100ms; !violation_; wait = std::min<Time>(2 * wait, 2s)) {
        live_for(wait);
        wrong.clear();
        for (std::size_t i = 0; i < masters_.size() && wrong.empty(); ++i)
            wrong = judge_.not_settled(i, poller_.snapshot(i));
        if (wrong.empty()) return;
        if (line_.time > end) return report_violation("in the end " + wrong);
    }
}

} // namespace dpslave::drive_line
