// SPDX-License-Identifier: Apache-2.0
#include "drive_thread.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <utility>

namespace dpslave::app {

namespace {

drive::UnitSettings unit_settings(const config::StationConfig& station, const config::LineConfig& line)
{
    drive::UnitSettings unit;
    unit.address = station.unit;
    unit.tags = station.tags.get();
    unit.tags_only_from_table = station.profile->tags_only_from_table;
    unit.scale_from_table = line.protocol == config::kEiAscii;
    unit.unlisted_decimals = station.unlisted_decimals;
    unit.unscaled_holds = station.unscaled_holds;
    unit.output_refresh = station.output_refresh;
    unit.zero_after = station.zero_after;
    // Modbus instruments keep what they are told in a memory that wears: only what differs is written.
    unit.compare_outputs = line.protocol == config::kModbusRtu;
    unit.never_written = station.profile->never_written;
    unit.watched = station.watched;
    unit.retries = line.retries;
    // Ten time-outs, as the clients have it: a late answer to a probe is then over.
    unit.probe_interval = line.settle.count() != 0 ? line.settle : 10 * line.timeout;
    return unit;
}

/// What says something about the tag: neither silence nor an answer that is not proven.
bool is_refusal(AccessError error)
{
    return error != AccessError::none && error != AccessError::no_answer && error != AccessError::deferred;
}

std::vector<drive::UnitSettings> settings_of(const std::vector<DriveUnit>& units,
                                             const config::LineConfig& line)
{
    std::vector<drive::UnitSettings> settings;
    for (const DriveUnit& unit : units) settings.push_back(unit_settings(*unit.config, line));
    return settings;
}

} // namespace

DriveThread::Unit::Unit(const DriveUnit& made_of)
    : number(made_of.number),
      config(made_of.config),
      link(made_of.link),
      zero_after_ms(to_ms(made_of.config->zero_after))
{}

DriveThread::DriveThread(config::LineConfig line, std::unique_ptr<LineBackend> backend,
                         const std::vector<DriveUnit>& units, LineLink& link)
    : line_(std::move(line)),
      backend_(std::move(backend)),
      units_(units.begin(), units.end()),
      poller_(settings_of(units, line_), LineBackend::block_rule(line_)),
      link_(link),
      words_(LineBackend::block_rule(line_).max_tags)
{
    link_.port_open.store(true, std::memory_order_relaxed);
    if (backend_)
        backend_->set_units(units);
    else
        port_comes_until_ = io::monotonic_now() + kPortPatience;
}

void DriveThread::run(std::stop_token stop, io::EventFd& wake)
{
    while (!stop.stop_requested()) {
        take_work();
        if (const auto order = link_.probes.pop()) probe_line(*order, stop);
        fetch();
        const bool waits = waits_for_port(io::monotonic_now()) && !is_open();
        const auto transaction = waits ? std::nullopt : poller_.next(io::monotonic_now());
        if (transaction) carry_out(*transaction);
        publish(); // also what the poller has decided without the drive
        if (next_ && leaving_is_over()) {
            take_over();
        } else if (!transaction) {
            rest(wake.fd(), waits ? kTickWithLayout : rest_time(io::monotonic_now()));
            wake.clear(); // work and stop are looked at right after this
        }
    }
    farewell();
    link_.ended.store(true, std::memory_order_release);
}

void DriveThread::fetch()
{
    for (std::size_t i = 0; i < units_.size(); ++i) {
        Unit& unit = units_[i];
        // First the outputs, then the end of layouts (links.hpp says why), which is said to the poller first.
        const OutputImage* outputs = unit.link->outputs.fresh() ? &unit.link->outputs.latest() : nullptr;
        const Generation ended = unit.link->ended.load(std::memory_order_acquire);
        // Before the end of a layout: the time that counts for it may just have been set.
        const std::int64_t zero_after_ms = unit.link->zero_after_ms.load(std::memory_order_relaxed);
        if (zero_after_ms != unit.zero_after_ms) poller_.set_zero_after(i, from_ms(zero_after_ms));
        unit.zero_after_ms = zero_after_ms;
        if (ended != unit.ended) poller_.left_data_exchange(i, {.generation = ended});
        unit.ended = ended;
        if (outputs != nullptr) {
            poller_.set_outputs(i, *outputs);
            unit.layout = outputs->layout.generation;
        }
        while (const auto order = unit.link->demand_orders.pop()) poller_.set_demand(i, *order);
    }
    fetch_orders();
}

/// An order for a drive that is about to come waits for it: the highest numbers are the newest.
void DriveThread::fetch_orders()
{
    while (const auto order = link_.orders.pop()) {
        const bool is_early = std::all_of(units_.begin(), units_.end(),
                                          [&](const Unit& unit) { return unit.number < order->station; });
        if (is_early)
            early_orders_.push_back(*order);
        else
            operate(*order);
    }
}

void DriveThread::operate(LineOrder order)
{
    const auto unit = std::find_if(units_.begin(), units_.end(),
                                   [&](const Unit& one) { return one.number == order.station; });
    order.order.unit = static_cast<std::size_t>(unit - units_.begin());
    const bool taken = order.is_survey ? poller_.survey(order.order.unit, order.order.number, order.order.tag)
                                       : poller_.operate(order.order);
    if (!taken) // also where the station has left the line in the meantime
        link_.answers.push({.number = order.order.number, .error = AccessError::no_answer, .word = 0});
}

void DriveThread::carry_out(const drive::Transaction& transaction)
{
    const Unit& unit = units_[transaction.unit];
    const drive::Outcome outcome = is_open() ? exchange_with(unit, transaction)
                                             : drive::Outcome{.error = AccessError::no_answer, .words = {}};
    poller_.done(outcome, io::monotonic_now());
}

drive::Outcome DriveThread::exchange_with(const Unit& unit, const drive::Transaction& transaction)
{
    using Kind = drive::Transaction::Kind;
    drive::Backend& backend = backend_->backend();
    const drive::UnitAddress address = unit.config->unit;
    drive::Outcome outcome;
    switch (transaction.kind) {
        case Kind::read: {
            const std::span<std::uint16_t> words = std::span{words_}.first(transaction.count);
            outcome.error = backend.read(address, *transaction.tag, words);
            outcome.words = words;
            outcome.answer = backend.last_answer();
            break;
        }
        case Kind::write: outcome.error = backend.write(address, *transaction.tag, transaction.words); break;
        case Kind::probe:
            outcome.error = backend.probe(address) ? AccessError::none : AccessError::no_answer;
            break;
    }
    if (transaction.purpose == drive::Purpose::survey) {
        trouble_ = backend.last_trouble();
        outcome.trouble = trouble_;
        return outcome; // a survey is no trouble
    }
    // What a person asked for by hand was answered to that person: it says nothing about the plant.
    const bool is_by_hand = transaction.purpose == drive::Purpose::operate;
    if (transaction.tag != nullptr && transaction.count == 1) {
        if (outcome.error == AccessError::none)
            forget_trouble(unit, transaction);
        else if (is_refusal(outcome.error) && !is_by_hand)
            remember_trouble(unit, transaction, outcome.error, backend.last_trouble());
    }
    return outcome;
}

void DriveThread::publish()
{
    for (std::size_t i = 0; i < units_.size(); ++i) {
        StationLink& link = *units_[i].link;
        if (const auto inputs = poller_.take_inputs(i)) link.inputs.publish(*inputs);
        while (const auto answer = poller_.take_demand_answer(i)) link.demand_answer.publish(*answer);
        drive::UnitSnapshot snapshot = poller_.snapshot(i);
        if (backend_) snapshot.heard = backend_->backend().counts(units_[i].config->unit);
        link.drive_snapshot.publish(snapshot);
        say_ride(i);
    }
    while (const auto answer = poller_.take_operate_answer()) link_.answers.push(*answer);
    if (backend_) backend_->say_port_news(log_, io::monotonic_now());
    say_link_changes();
    log_.on_time(io::monotonic_now());
}

void DriveThread::say_link_changes()
{
    for (std::size_t i = 0; i < units_.size(); ++i) {
        Unit& unit = units_[i];
        const drive::UnitSnapshot& now = poller_.snapshot(i);
        if (!now.known || (unit.was_known && unit.answered == now.answers)) continue;
        log_.say(now.answers ? LimitedLog::Level::info : LimitedLog::Level::warning,
                 unit.config->name +
                     (now.answers ? ": the drive answers"
                                  : ": the drive does not answer; inputs are held, outputs are written again "
                                    "when it returns"),
                 io::monotonic_now());
        unit.was_known = true;
        unit.answered = now.answers;
    }
}

/// The outputs of a lost master stand for a while: a person at the machine has to know that it begins and
/// how it ends.
void DriveThread::say_ride(std::size_t index)
{
    Unit& unit = units_[index];
    const auto ends = poller_.snapshot(index).ride_ends;
    const auto before = std::exchange(unit.ride_ends, ends);
    if (ends == before) return;
    const std::string& name = unit.config->name;
    if (ends && !before) unit.ride_layout = unit.layout;
    if (ends == kNever)
        spdlog::warn("{}: the master is lost; the outputs stand until it returns (RIDE THROUGH)", name);
    else if (ends)
        spdlog::warn("{}: the master is lost; the outputs stand for {:.1f} s more (RIDE THROUGH)", name,
                     std::chrono::duration<double>(*ends - io::monotonic_now()).count());
    else if (unit.layout != unit.ride_layout)
        spdlog::info("{}: the master is back and has taken over the outputs that stood", name);
    else
        spdlog::warn("{}: RIDE THROUGH is over: the outputs are set to 0", name);
}

/// Said once in the log, shown by `dpctl diag` until the access works. A value that never fits is a new text
/// each time; the log counts those of one cause.
void DriveThread::remember_trouble(const Unit& unit, const drive::Transaction& access, AccessError cause,
                                   const std::string& text)
{
    const std::uint16_t tag = access.tag->number;
    const bool is_write = access.kind == drive::Transaction::Kind::write;
    const auto line = (is_write ? "write of tag " : "tag ") + std::to_string(tag) + ": " + text;
    for (std::size_t k = 0; k < troubles_.count; ++k) {
        Trouble& known = troubles_.troubles[k];
        if (known.station != unit.number || known.tag != tag || known.is_write != is_write) continue;
        if (line.compare(0, known.text.size() - 1, known.text.data()) == 0) return;
        forget_trouble(unit, access);
        break;
    }
    log_.say(LimitedLog::Level::warning,
             fmt::format("{}/{}/{}/{}", unit.number, tag, is_write, static_cast<int>(cause)),
             unit.config->name + ": " + line, io::monotonic_now());
    if (troubles_.count == troubles_.troubles.size()) { // the oldest makes room
        std::copy(troubles_.troubles.begin() + 1, troubles_.troubles.end(), troubles_.troubles.begin());
        --troubles_.count;
    }
    Trouble& trouble = troubles_.troubles[troubles_.count++];
    trouble = {.station = unit.number, .tag = tag, .is_write = is_write, .error = cause, .text = {}};
    line.copy(trouble.text.data(), trouble.text.size() - 1);
    link_.troubles.publish(troubles_);
}

void DriveThread::forget_trouble(const Unit& unit, const drive::Transaction& access)
{
    const bool is_write = access.kind == drive::Transaction::Kind::write;
    const auto end = troubles_.troubles.begin() + troubles_.count;
    const auto found = std::find_if(troubles_.troubles.begin(), end, [&](const Trouble& one) {
        return one.station == unit.number && one.tag == access.tag->number && one.is_write == is_write;
    });
    if (found == end) return;
    std::copy(found + 1, end, found);
    --troubles_.count;
    link_.troubles.publish(troubles_);
}

/// Asks on behalf of a person whether a drive answers with other settings. The line does nothing else
/// meanwhile; its own port is closed for it and opened again like one that was not there.
void DriveThread::probe_line(const ProbeOrder& order, const std::stop_token& stop)
{
    link_.probe_tried.store(0, std::memory_order_relaxed);
    ProbeReport report{.number = order.number, .tried = 0, .answers = {}, .count = 0};
    const auto unit = std::find_if(units_.begin(), units_.end(),
                                   [&](const Unit& one) { return one.number == order.station; });
    if (unit != units_.end()) {
        spdlog::info("{}: looking for the drive on {} with other rates, formats and units",
                     unit->config->name, line_.port);
        backend_.reset();
        next_open_ = {};
        config::LineConfig trial = line_;
        trial.timeout = probe_timeout(line_);
        // Each question has a back-end of its own, which is owed nothing, and an answer counts when it comes
        // twice: what answers late could be taken for the answer of the next unit.
        const auto answers = [&trial](drive::UnitAddress address) {
            std::atomic<bool> is_open{false}; // a trial is no news of the port
            const auto backend = LineBackend::open(trial, is_open);
            return backend && (*backend)->backend().probe(address);
        };
        // The drive of another station is where it should be: what answers there is not the one looked for.
        const auto is_of_another = [&](drive::UnitAddress address) {
            return std::any_of(units_.begin(), units_.end(), [&](const Unit& one) {
                return one.number != order.station && one.config->unit == address;
            });
        };
        const auto is_over = [&] {
            return stop.stop_requested() || link_.probe_ended.load(std::memory_order_relaxed) == order.number;
        };
        for (const ProbeTry& one : probe_plan(line_, unit->config->unit)) {
            trial.baud = one.baud;
            trial.format = one.format;
            for (const drive::UnitAddress address : one.units) {
                if (is_over()) break;
                if (is_of_another(address)) continue;
                link_.probe_tried.store(++report.tried, std::memory_order_relaxed);
                if (answers(address) && answers(address) && report.count < report.answers.size())
                    report.answers[report.count++] = {one.baud, one.format, address};
            }
            if (report.count != 0 || is_over()) break; // what answers at one rate answers at no other
        }
        if (is_over()) spdlog::info("{}: the search for the drive was ended", unit->config->name);
    }
    link_.probe_reports.push(report);
}

/// Until the next deadline, but not longer than an order of the master may wait.
std::chrono::nanoseconds DriveThread::rest_time(Instant now) const
{
    const bool busy = std::any_of(units_.begin(), units_.end(),
                                  [](const Unit& unit) { return unit.layout != 0 && unit.answered; });
    const std::chrono::nanoseconds tick = busy ? kTickWithLayout : kTickIdle;
    return std::clamp<std::chrono::nanoseconds>(poller_.next_deadline() - now, std::chrono::nanoseconds{0},
                                                tick);
}

/// Nothing to do: waits, until something is to be looked at. An answer that comes too late comes now: its
/// delay is measured here.
void DriveThread::rest(int wake, std::chrono::nanoseconds wait)
{
    const timespec time{.tv_sec = 0, .tv_nsec = static_cast<long>(wait.count())};
    std::array<pollfd, 2> fds{{{.fd = wake, .events = POLLIN, .revents = 0},
                               {.fd = backend_ ? backend_->fd() : -1, .events = POLLIN, .revents = 0}}};
    ::ppoll(fds.data(), fds.size(), &time, nullptr); // a negative descriptor is not looked at
    if (fds[1].revents != 0) backend_->backend().listen();
}

/// The bus has been left: the outputs still go to their safe state, as far as the drives let us. A drive that
/// does not answer at this moment is waited for as long as any.
void DriveThread::farewell()
{
    const Instant end = io::monotonic_now() + kFarewell;
    fetch();
    // Usually the bus has said so; one that hangs or had to give up has not.
    for (std::size_t i = 0; i < units_.size(); ++i)
        poller_.left_data_exchange(i, {.generation = units_[i].layout});
    poller_.ride_no_longer(); // nobody is there any more to zero the outputs later
    while (poller_.safe_state_pending() && io::monotonic_now() < end) {
        if (const auto transaction = poller_.next(io::monotonic_now()))
            carry_out(*transaction);
        else
            rest(-1, rest_time(io::monotonic_now()));
    }
    if (poller_.safe_state_pending())
        spdlog::error("not every output could be put into its safe state: a drive does not answer");
    publish();
}

// ---- other drives, another port

/// The main thread has other drives for this line. The bus has let go of those who leave: their outputs go to
/// the safe state first, between the transactions of the others, who notice nothing.
void DriveThread::take_work()
{
    if (next_ || !link_.work.take(next_)) return;
    leave_until_ = io::monotonic_now() + kFarewell;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        Unit& unit = units_[i];
        unit.leaves = std::none_of(next_->units.begin(), next_->units.end(),
                                   [&](const DriveUnit& one) { return one.number == unit.number; });
        if (unit.leaves) poller_.ride_no_longer(i); // nobody is there any more to zero the outputs later
    }
    if (next_->leaves_drives) poller_.leave_port();
}

bool DriveThread::leaving_is_over() const
{
    // A drive that is lost at the port that is left is not waited for: its cable may be at the new one.
    const auto is_waited_for = [this](std::size_t i) {
        return poller_.safe_state_pending(i) &&
               (units_[i].leaves || (next_->leaves_drives && poller_.snapshot(i).answers));
    };
    bool pending = false;
    for (std::size_t i = 0; i < units_.size(); ++i) pending = pending || is_waited_for(i);
    if (pending && io::monotonic_now() < leave_until_) return false;
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (poller_.safe_state_pending(i) && (units_[i].leaves || next_->leaves_drives))
            spdlog::error(
                "{}: not every output could be put into its safe state before {}: the drive does not "
                "answer",
                units_[i].config->name,
                units_[i].leaves ? "the station was taken away" : line_.port + " was left");
    return true;
}

/// The new port, or the old one set in another way. One that a line of ours still has is waited for.
void DriveThread::take_port()
{
    backend_.reset(); // first: the next one may need the same port
    backend_ = std::move(next_->backend);
    next_open_ = {};
    port_comes_until_ = io::monotonic_now() + kPortPatience;
    open_failure_said_ = false;
    link_.port_open.store(true, std::memory_order_relaxed); // a moment without it is no fault
    if (next_->is_other_port) poller_.port_changed();
}

/// Only now come those who are new: no one writes to a drive that another station still leaves.
void DriveThread::take_over()
{
    if (next_->line) line_ = *next_->line;
    std::vector<Unit> units;
    std::vector<std::optional<std::size_t>> stays;
    for (const DriveUnit& one : next_->units) {
        const auto known = std::find_if(units_.begin(), units_.end(),
                                        [&](const Unit& unit) { return unit.number == one.number; });
        const bool is_known = known != units_.end();
        if (is_known) forget_troubles_of_other_rows(*known, *one.config);
        stays.push_back(is_known ? std::optional{static_cast<std::size_t>(known - units_.begin())}
                                 : std::nullopt);
        units.push_back(is_known ? *known : Unit{one});
        units.back().config = one.config;
    }
    if (next_->opens_port) take_port();
    const drive::BlockRule rule = LineBackend::block_rule(line_);
    poller_.exchange(settings_of(next_->units, line_), stays, rule); // the tables of before are still there
    units_ = std::move(units);
    if (backend_) backend_->set_units(next_->units);
    words_.resize(std::max<std::size_t>(words_.size(), rule.max_tags)); // those who stay keep their rule
    forget_troubles_of_the_gone();
    for (const LineOrder& order : std::exchange(early_orders_, {})) operate(order);
    next_.reset();
    link_.work_done.fetch_add(1, std::memory_order_release);
}

void DriveThread::forget_troubles_of_the_gone()
{
    forget_troubles_where([&](const Trouble& trouble) {
        return std::none_of(units_.begin(), units_.end(),
                            [&](const Unit& unit) { return unit.number == trouble.station; });
    });
}

/// What was said of a row is not true of another one, also where no master asks for it now.
void DriveThread::forget_troubles_of_other_rows(const Unit& unit, const config::StationConfig& now)
{
    const config::StationConfig& before = *unit.config;
    forget_troubles_where([&](const Trouble& trouble) {
        if (trouble.station != unit.number) return false;
        const drive::Tag* const old = before.tags->find(trouble.tag);
        const drive::Tag* const row = now.tags->find(trouble.tag);
        if (old == nullptr || row == nullptr)
            return old != row || before.unlisted_decimals != now.unlisted_decimals;
        return !drive::is_same_value(*old, *row) || drive::has_scale(*old) != drive::has_scale(*row);
    });
}

template <class IsOver>
void DriveThread::forget_troubles_where(IsOver is_over)
{
    const auto end = troubles_.troubles.begin() + troubles_.count;
    const auto kept = std::remove_if(troubles_.troubles.begin(), end, is_over);
    if (kept == end) return;
    troubles_.count = static_cast<std::uint8_t>(kept - troubles_.troubles.begin());
    link_.troubles.publish(troubles_);
}

/// A port that another line of ours had until now is opened as soon as that one has let go of it.
bool DriveThread::is_open()
{
    if (backend_) return true;
    const Instant now = io::monotonic_now();
    if (now < next_open_) return false;
    auto opened = LineBackend::open(line_, link_.port_open);
    if (!opened && waits_for_port(now)) return false;
    next_open_ = now + kOpenAgainAfter;
    if (!opened) {
        link_.port_open.store(false, std::memory_order_relaxed);
        if (!open_failure_said_) spdlog::error("line {}: {}; it is tried again", line_.name, opened.error());
        open_failure_said_ = true;
        return false;
    }
    backend_ = std::move(*opened);
    link_.port_open.store(true, std::memory_order_relaxed);
    std::vector<DriveUnit> units;
    for (const Unit& unit : units_) units.push_back({unit.number, unit.config, unit.link});
    backend_->set_units(units);
    spdlog::info("line {}: {} is open", line_.name, line_.port);
    return true;
}

} // namespace dpslave::app
