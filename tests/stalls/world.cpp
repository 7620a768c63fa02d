// SPDX-License-Identifier: Apache-2.0
#include "world.hpp"

#include "app/line/drive_thread.hpp"
#include "app/state/old_words.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::stalls {
namespace {

World* the_world = nullptr;

constexpr std::uint8_t kFirstAddress = 5;

/// An option board, as HA389815 describes it.
std::shared_ptr<const dp::Personality> board(drive::WhenLost when)
{
    auto one = std::make_shared<dp::Personality>();
    one->ident = 0x0533;
    one->max_tsdr.fill(Tbit{150});
    one->identifiers = {{0x50, 1, 0}, {0x60, 0, 1}};
    one->demand_identifier = 0x73;
    one->max_parameters = 12;
    one->prm = {.tags_at = 0, .min_length = 24, .max_length = 24};
    one->demand = dp::DemandForm::basic;
    one->tries_outputs = true;
    one->waits_for_drive = when != drive::WhenLost::hold;
    return one;
}

} // namespace

World* World::current()
{
    return the_world;
}

World::World(SimulatedLine& line, Setting setting, Open open)
    : line_(line),
      setting_(std::move(setting)),
      open_(std::move(open)),
      now_(line.time),
      judge_(line, setting_.stations, setting_.retries, setting_.answers_late),
      bus_{judge_.bus_thread, setting_.bus_tick, now_},
      main_{judge_.main_thread, setting_.main_tick, now_},
      drive_line_(setting_.line, config::TraceConfig{.samples_kib = 0, .drive_kib = 0}),
      views_(line.drives.size()),
      view_is_old_(line.drives.size())
{
    the_world = this;
    for (std::size_t i = 0; i < line_.drives.size(); ++i) make_station(i);
    set_.emplace(std::make_unique<app::BusStations>(stations_), next_, layer2_, signs_.main);
}

World::~World()
{
    the_world = nullptr;
}

void World::make_station(std::size_t drive)
{
    auto config = std::make_shared<config::StationConfig>();
    const StationRules& rules = setting_.stations[drive];
    config->name = "drive " + std::to_string(drive);
    config->address = static_cast<std::uint8_t>(kFirstAddress + drive);
    config->profile = std::make_shared<profile::Profile>();
    config->personality = board(rules.when);
    config->tags = std::make_shared<drive::TagTable>(setting_.tables[drive]);
    config->unit = {0, line_.drives[drive].unit};
    config->loss = {.when = rules.when, .after = rules.after};
    config->zero_after = rules.zero_after;
    config->watched = {line_.drives[drive].tags.front().number};
    auto link = std::make_shared<app::StationLink>(drive_line_.link.sign);
    link->zero_after_ms.store(app::to_ms(rules.zero_after));
    link->departures.store(rules.when == drive::WhenLost::silent ? 1 : 0); // it has not answered yet
    stations_.push_back(std::make_shared<app::BusStation>(*config, link));
    plcs_.push_back(std::make_unique<Plc>(*stations_.back(), setting_.layouts[drive]));
    units_.push_back({.number = static_cast<std::uint32_t>(drive + 1),
                      .config = std::move(config),
                      .link = std::move(link)});
    demanded_.emplace_back();
}

void World::run(const std::function<void()>& act)
{
    act_ = act;
    app::DriveThread line{setting_.line, false, units_, drive_line_.link, signs_};
    line.run(stop_.get_token(), wake_);
    if (leaves_) judge_.has_left(now_);
}

bool World::any_stall() const
{
    return line_stall_ || bus_.stall || main_.stall || judge_.line_thread.is_stalled() ||
           judge_.bus_thread.is_stalled() || judge_.main_thread.is_stalled();
}

// ---- beside the line

void World::others_until(Instant until)
{
    for (;;) {
        const Instant next = std::min({bus_.turns_at, main_.turns_at, acts_at});
        if (next > until) break;
        now_ = std::max(now_, next);
        line_.pass_until(now_);
        if (acts_at <= next) {
            acts_at = kNever;
            act_();
        } else if (bus_.turns_at <= next) {
            if (!begins_to_stall(bus_)) bus_turn();
        } else {
            if (!begins_to_stall(main_)) main_turn();
        }
        if (judge_.violation()) stop();
    }
    now_ = std::max(now_, until);
}

/// Else it goes round now, and again behind its tick.
bool World::begins_to_stall(Thread& thread)
{
    if (thread.timeline.is_stalled()) thread.timeline.goes_on(now_);
    if (thread.stall && thread.stall->due <= now_) {
        thread.timeline.stalls(now_);
        thread.turns_at = now_ + std::exchange(thread.stall, std::nullopt)->length;
        return true;
    }
    thread.turns_at = now_ + thread.tick;
    return false;
}

void World::bus_turn()
{
    signs_.bus.give(now_);
    if (leaves_) return; // the stations of the line are off the bus
    std::vector<dp::State> before;
    for (const auto& one : stations_) before.push_back(one->slave().state());
    set_->update(now_);
    if (layer2_.next_deadline() <= now_) layer2_.on_time(now_);
    for (std::size_t i = 0; i < stations_.size(); ++i) {
        const dp::State state = stations_[i]->slave().state();
        if (before[i] > dp::State::wait_prm && state <= dp::State::wait_prm)
            judge_.is_on_the_bus(i, false, now_); // also where it has come back already
        judge_.is_on_the_bus(i, state != dp::State::power_on, now_);
        plcs_[i]->turn(now_);
        note_exchange(i);
        static_cast<void>(stations_[i]->forward());
    }
    set_->forward();
}

void World::note_exchange(std::size_t drive)
{
    const Plc& plc = *plcs_[drive];
    judge_.asks_for_diagnosis(drive, plc.is_held(), now_);
    if (!plc.has_exchanged()) return;
    const auto& parameters = plc.parameters();
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (parameters[i].writes) judge_.wants(drive, parameters[i].tag, (*plc.sent())[i], now_);
    if (const auto order = std::exchange(demanded_[drive], std::nullopt))
        judge_.demands(drive, order->word, plc.is_served(), now_);
    if (!plc.is_served()) return;
    judge_.serves(drive, now_);
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (parameters[i].reads) judge_.shows(drive, parameters[i].tag, plc.input(i), plc.started_at(), now_);
}

/// As app/state/monitor and app/calls/pending_accesses do it.
void World::main_turn()
{
    signs_.main.give(now_);
    while (const auto answer = drive_line_.link.answers.pop()) {
        judge_.answers(*answer, now_);
        std::erase(waiting_, answer->number);
    }
    const auto silent = drive_line_.look(now_);
    bool any = false;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        app::StationLink& link = *units_[i].link;
        const auto& loss = units_[i].config->loss;
        if (link.drive_snapshot.fresh()) views_[i] = link.drive_snapshot.latest();
        view_is_old_[i] = silent >= loss.after;
        if (view_is_old_[i]) app::make_old(views_[i], loss.when);
        any = any || view_is_old_[i];
        judge_.views(i, views_[i], now_);
    }
    if (any) fail_orders();
}

void World::fail_orders()
{
    if (waiting_.empty()) return;
    using End = app::OrderStates::End;
    for (const std::uint32_t one : std::exchange(waiting_, {})) {
        const End end = drive_line_.link.order_states.end(one);
        if (end == End::answered)
            waiting_.push_back(one);
        else
            judge_.fails(one, end == End::not_begun, now_);
    }
    drive_line_.link.sign->give_up();
}

void World::order(std::size_t drive, std::uint16_t tag, std::optional<std::uint16_t> word)
{
    if (view_is_old_[drive] || judge_.main_thread.is_stalled()) return;
    if (!drive_line_.link.order_states.add(orders_ + 1)) return;
    const drive::OperateOrder order{
        .number = ++orders_, .unit = 0, .is_write = word.has_value(), .tag = tag, .word = word.value_or(0)};
    if (!drive_line_.link.orders.push({.station = units_[drive].number, .order = order}))
        return drive_line_.link.order_states.take_back(orders_);
    judge_.orders(orders_, drive, word);
    waiting_.push_back(orders_);
}

void World::demand(std::size_t drive, std::uint16_t tag, std::optional<std::uint16_t> word)
{
    if (!plcs_[drive]->exchanges()) return;
    plcs_[drive]->demand(word.has_value(), tag, word.value_or(0));
    demanded_[drive] = Demanded{word};
}

// ---- the line

void World::waits_until(Instant until)
{
    do {
        others_until(std::min(std::max(until, now_), now_ + io::ThreadSign::kSlice));
        io::give_sign();
        judge_.line_turn(now_);
    } while (now_ < until);
    line_.pass_until(now_);
}

void World::pass(Time length)
{
    others_until(now_ + length);
    line_.pass_until(now_);
}

/// What does not come in time, as a write to a drive that is away, is not waited for.
bool World::is_due(Where where) const
{
    constexpr Time kPatience = 20s;
    if (!line_stall_ || line_stall_->due > now_) return false;
    return line_stall_->where == where || (where == Where::rest && line_stall_->due + kPatience < now_);
}

LineStall World::begin_stall()
{
    judge_.line_thread.stalls(now_);
    return *std::exchange(line_stall_, std::nullopt);
}

void World::end_stall(const LineStall& stall)
{
    judge_.line_thread.goes_on(now_);
    if (stall.where == Where::rest) return;
    open_stall_ = stall.opens;
    if (stall.length >= io::ThreadSign::kStall) judge_.call_came_back(now_);
}

void World::may_rest()
{
    may_stall(Where::rest);
}

void World::may_stall(Where where)
{
    if (!is_due(where)) return;
    LineStall stall = begin_stall();
    stall.where = where;
    pass(stall.length);
    end_stall(stall);
}

bool World::writes(bool is_value, const std::function<void()>& leave)
{
    const bool is_meant = is_due(Where::write) || (is_value && is_due(Where::write_value));
    if (!is_meant) {
        leave();
        return true;
    }
    const LineStall stall = begin_stall();
    line_.handed = now_;
    if (stall.leave == Leave::at_once) leave();
    const Time meanwhile = stall.length / 3;
    pass(meanwhile);
    if (stall.leave == Leave::meanwhile) leave();
    pass(stall.length - meanwhile);
    const bool was_short = stall.length < io::ThreadSign::kStall; // nobody need have noticed
    if (was_short && stall.leave > Leave::meanwhile) leave();
    line_.handed.reset();
    end_stall(stall);
    return was_short || stall.leave != Leave::never;
}

std::unique_ptr<drive::Backend> World::open_port()
{
    open();
    return open_(*this);
}

void World::open()
{
    const io::InCall open{io::PortCall::open};
    if (const auto length = std::exchange(open_stall_, std::nullopt)) {
        judge_.line_thread.stalls(now_);
        pass(*length);
        judge_.line_thread.goes_on(now_);
    }
    line_.lose_input();
}

} // namespace dpslave::stalls
