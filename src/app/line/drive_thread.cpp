// SPDX-License-Identifier: Apache-2.0
#include "drive_thread.hpp"

#include "probe_run.hpp"
#include "transaction_log.hpp"

#include "dpslave/drive/carry_out.hpp"
#include "dpslave/io/clock.hpp"
#include "dpslave/io/thread_sign.hpp"
#include "dpslave/report/words.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace dpslave::app {

namespace {

/// What says something about the tag: neither silence nor an answer that is not proven.
bool is_refusal(AccessError error)
{
    return error != AccessError::none && error != AccessError::no_answer && error != AccessError::deferred;
}

template <class Units>
auto find_unit(Units& units, std::uint32_t number)
{
    return std::find_if(units.begin(), units.end(),
                        [number](const DriveUnit& unit) { return unit.number == number; });
}

} // namespace

DriveThread::DriveThread(config::LineConfig line, bool port_is_held, const std::vector<DriveUnit>& units,
                         LineLink& link, const ProgramSigns& signs)
    : line_(std::move(line)),
      link_(link),
      signs_(signs),
      port_(port_is_held, listeners_of(link)),
      units_(units.begin(), units.end()),
      poller_(poller_settings(units, line_), LineBackend::block_rule(line_)),
      orders_(link, poller_, units_),
      troubles_(link.happenings, link.troubles),
      words_(LineBackend::block_rule(line_).max_tags)
{
    port_.set_units(units);
}

void DriveThread::run(const std::stop_token& stop, io::EventFd& wake)
{
    io::set_sign_of_this_thread(link_.sign.get(), this);
    while (!stop.stop_requested()) {
        io::give_sign();
        if (link_.sign->stall()) recover();
        take_change();
        if (const auto order = link_.probes.pop()) probe(*order, stop);
        fetch();
        note_stalls();
        if (std::exchange(master_is_lost_, false)) lose_master();
        if (stop.stop_requested()) break; // after lose_master(), whose waits have no limit
        const bool waits = port_.is_awaited(io::monotonic_now()) && !port_.open(line_);
        note_heard(); // an answer that came between two questions
        const auto transaction = waits ? std::nullopt : poller_.next(io::monotonic_now());
        if (transaction) carry_out(*transaction);
        publish(); // also what the poller has decided without the drive
        if (next_ && leaving_is_over()) {
            apply_change();
        } else if (!transaction) {
            rest(wake.fd(), waits ? kTickWithLayout : rest_time(io::monotonic_now()));
            wake.clear(); // a change and stop are looked at right after this
        }
    }
    io::set_sign_of_this_thread(link_.sign.get()); // who has ended gives no sign, and is not judged any more
    write_safe_state();
    port_.close(); // here: it may take long, and the main thread takes this object away
    io::set_sign_of_this_thread(nullptr);
}

void DriveThread::fetch()
{
    for (std::size_t i = 0; i < units_.size(); ++i) units_[i].fetch(poller_, i);
    orders_.fetch();
}

/// An order that has just ended is not sent: the poller forgets it in the next round.
void DriveThread::carry_out(const drive::Transaction& transaction)
{
    const LineUnit& unit = units_[transaction.unit];
    drive::Outcome outcome{.error = AccessError::no_answer, .words = {}, .sent = false};
    if (transaction.order != 0 && !orders_.begin(transaction.order))
        outcome.error = AccessError::deferred;
    else if (port_.open(line_))
        outcome = exchange_with(unit, transaction);
    if (transaction.order != 0) orders_.done(transaction.order, outcome.sent);
    log_transaction(line_.name, unit, transaction, outcome);
    note_heard();
    poller_.done(outcome, io::monotonic_now());
}

/// Through a port whose settings another program has changed nothing is asked, and nothing is believed.
drive::Outcome DriveThread::exchange_with(const LineUnit& unit, const drive::Transaction& transaction)
{
    static_cast<void>(port_.settings_hold(line_));
    if (port_.backend() == nullptr) return {.error = AccessError::no_answer, .words = {}, .sent = false};
    drive::Backend& backend = port_.backend()->backend();
    drive::Outcome outcome = drive::carry_out(transaction, backend, unit.config->unit, words_);
    if (!port_.settings_hold(line_)) { // then there may be no back-end any more
        outcome.error = AccessError::no_answer;
        outcome.words = {};
        return outcome;
    }
    if (transaction.purpose == drive::Purpose::survey) {
        survey_trouble_ = backend.last_trouble();
        outcome.trouble = survey_trouble_;
        return outcome; // a survey is no trouble
    }
    // What was ordered by hand was answered there: it says nothing about the plant.
    const bool is_by_hand = transaction.purpose == drive::Purpose::operate;
    if (transaction.tag != nullptr && transaction.count == 1) {
        if (outcome.error == AccessError::none)
            troubles_.remove(unit, transaction);
        else if (is_refusal(outcome.error) && !is_by_hand)
            troubles_.add(unit, transaction, outcome.error, backend.last_trouble());
    }
    return outcome;
}

void DriveThread::publish()
{
    LineBackend* const backend = port_.backend();
    for (std::size_t i = 0; i < units_.size(); ++i) {
        std::optional<drive::AnswerCounts> heard;
        if (backend != nullptr) heard = backend->backend().counts(units_[i].config->unit);
        units_[i].publish(poller_, i, heard);
        units_[i].sample(poller_.snapshot(i), link_.samples);
    }
    orders_.answer();
    if (backend != nullptr) backend->tell_port_messages();
    for (std::size_t i = 0; i < units_.size(); ++i) units_[i].tell(poller_.snapshot(i), link_.happenings);
}

/// Whether a drive is gone is decided by its last valid frame, whoever was asked then.
void DriveThread::note_heard()
{
    if (port_.backend() == nullptr) return;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        const Instant at = port_.backend()->backend().counts(units_[i].config->unit).valid_at;
        if (at != Instant{}) poller_.heard(i, at);
    }
}

/// A call of the port has come back that was given up by all who wait for this line. What it has not
/// sent goes with the port, and each tag gets what it owes now. A port that was only slow to open is a new
/// one.
void DriveThread::recover()
{
    const io::ThreadSign::Stall stall = *link_.sign->stall();
    link_.sign->clear_stall();
    if (stall.call == io::PortCall::open || stall.call == io::PortCall::close) return;
    if (port_.backend() != nullptr) port_.backend()->reopen();
    link_.happenings.tell(
        Severity::error, 0,
        fmt::format(
            "line {}: the port stalled for {:.1f} s ({}): what had not left is thrown away, and the port is opened again. Look at its adapter and its cable",
            line_.name, std::chrono::duration<double>(stall.length).count(), io::name(stall.call)),
        LineHappenings::Kind::port_missing);
}

/// The bus and the main thread have done without this line where no sign has come for too long. The bus goes
/// by what is published here when it is noted.
void DriveThread::note_stalls()
{
    link_.sign->clear_given_up();
    orders_.drop_ended(); // behind clear_given_up(): what was ended before that is seen
    bool is_new = false;
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (units_[i].note_stall(poller_, i, io::monotonic_now())) is_new = true;
    if (!is_new) return;
    publish();
    for (LineUnit& unit : units_) unit.show_stall();
}

/// Also while this thread waits for an answer.
void DriveThread::on_sign(Instant now)
{
    if (!others_.look(signs_.bus.last(), signs_.main.last(), now)) return;
    master_is_lost_ = true;
    link_.sign->end_waits(now + kLastAnswer);
}

/// Nobody will say that the master is lost. The layouts end here, and the bus is told for when it goes round
/// again.
void DriveThread::lose_master()
{
    link_.sign->end_waits(kNever);
    for (std::size_t i = 0; i < units_.size(); ++i) {
        poller_.left_data_exchange(i, {.generation = units_[i].layout()});
        poller_.end_ride(i);
        units_[i].lose_master();
    }
    link_.happenings.tell(
        Severity::error, 0,
        fmt::format(
            "line {}: the {} has stalled: the master counts as lost, and the outputs go to their safe state",
            line_.name, others_.which()));
}

/// The line does nothing else meanwhile, unless outputs have to go to their safe state; its own port is
/// closed for it and opened again like one that was not there.
void DriveThread::probe(const ProbeOrder& order, const std::stop_token& stop)
{
    link_.probe_tried.store(0, std::memory_order_relaxed);
    ProbeReport report{.number = order.number, .tried = 0, .answers = {}, .count = 0};
    const auto unit = find_unit(units_, order.station);
    const bool is_wanted = link_.probe_states.begin(order.number); // its caller may have gone since
    if (is_wanted && unit != units_.end() && !unit->leaves) {
        port_.close();
        for (std::size_t i = 0; i < units_.size(); ++i) poller_.not_asked(i, io::monotonic_now());
        publish();
        report = run_probe(order, line_, *unit, units_, link_, [&] {
            return stop.stop_requested() || master_is_lost_ || link_.probe_states.has_ended(order.number);
        });
    }
    link_.probe_reports.push(report);
    link_.probe_states.remove(order.number);
}

/// Until the next deadline, but not longer than an order of the master may wait.
std::chrono::nanoseconds DriveThread::rest_time(Instant now) const
{
    const auto is_busy = [](const LineUnit& unit) { return unit.is_busy(); };
    const auto is_lost = [](const LineUnit& unit) { return unit.is_lost(); };
    std::chrono::nanoseconds tick = kTickIdle;
    if (std::any_of(units_.begin(), units_.end(), is_busy)) tick = kTickWithLayout;
    if (!units_.empty() && std::all_of(units_.begin(), units_.end(), is_lost)) tick = kTickLost;
    return std::clamp<std::chrono::nanoseconds>(poller_.next_deadline() - now, std::chrono::nanoseconds{0},
                                                tick);
}

/// Nothing to do: waits, until something is to be looked at. An answer that comes too late comes now: its
/// delay is measured here.
void DriveThread::rest(int wake, std::chrono::nanoseconds wait)
{
    LineBackend* const backend = port_.backend();
    const timespec time{.tv_sec = 0, .tv_nsec = static_cast<long>(wait.count())};
    std::array<pollfd, 2> fds{
        {{.fd = wake, .events = POLLIN, .revents = 0},
         {.fd = backend != nullptr ? backend->fd() : -1, .events = POLLIN, .revents = 0}}};
    ::ppoll(fds.data(), fds.size(), &time, nullptr); // a negative descriptor is not looked at
    if (fds[1].revents != 0) backend->backend().listen();
}

/// The bus has been left. Each drive has its share of the time: one that does not answer costs the others
/// none.
void DriveThread::write_safe_state()
{
    Instant latest = io::monotonic_now() + kSafeStateLimit; // of a line that leaves a program that stays
    const auto ends_by = [&] {
        const Instant wanted = link_.ends_by.load(std::memory_order_relaxed);
        return wanted == kNever ? latest : wanted;
    };
    fetch();
    orders_.drop_all();
    // Usually the bus has said so; one that hangs or has failed has not.
    for (std::size_t i = 0; i < units_.size(); ++i) {
        poller_.left_data_exchange(i, {.generation = units_[i].layout()});
        poller_.cancel_ride_through(i); // nothing could zero the outputs later
    }
    for (;;) {
        io::give_sign();
        link_.sign->end_waits(ends_by()); // of what is opened
        if (link_.sign->stall()) {
            recover();
            latest = io::monotonic_now() + kSafeStateLimit;
        }
        note_stalls();
        const Instant now = io::monotonic_now(), end = ends_by();
        std::int64_t waiting = 0;
        for (std::size_t i = 0; i < units_.size(); ++i) waiting += is_pending(i) ? 1 : 0;
        if (waiting == 0 || now >= end) break;
        const auto share = std::max<std::chrono::nanoseconds>((end - now) / waiting, kLastAnswer);
        link_.sign->end_waits(std::min(end, now + share));
        if (const auto transaction = poller_.next(now))
            carry_out(*transaction);
        else
            rest(-1, rest_time(now));
    }
    publish(); // the cause first
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (is_pending(i))
            link_.happenings.tell(Severity::error, units_[i].number,
                                  fmt::format("{}: not every output could be put into its safe state: {}",
                                              units_[i].config->name, not_written(i)));
}

bool DriveThread::is_pending(std::size_t unit) const
{
    return !poller_.safe_state_left(unit).empty();
}

std::string DriveThread::not_written(std::size_t unit) const
{
    return zeros_in_words(poller_.safe_state_left(unit)) +
           (poller_.snapshot(unit).answers ? "; there was no more time" : "; the drive does not answer");
}

// ---- other drives, another port

/// The main thread has other drives for this line. The stations of those that leave are off the bus: their
/// outputs go to the safe state first, between the transactions of the others.
void DriveThread::take_change()
{
    if (next_ || !link_.change.take(next_)) return;
    next_->begins_at(line_.port);
    leave_until_ = io::monotonic_now() + kSafeStateLimit;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        units_[i].leaves = find_unit(next_->units, units_[i].number) == next_->units.end();
        if (units_[i].leaves) poller_.cancel_ride_through(i); // nothing could zero the outputs later
    }
    if (next_->leaves_drives) poller_.leave_port();
}

bool DriveThread::leaving_is_over() const
{
    // A drive that is lost at the port that is left is not waited for: its cable may be at the new one.
    const auto is_waited_for = [this](std::size_t i) {
        return is_pending(i) && (units_[i].leaves || (next_->leaves_drives && poller_.snapshot(i).answers));
    };
    bool pending = false;
    for (std::size_t i = 0; i < units_.size(); ++i) pending = pending || is_waited_for(i);
    if (pending && io::monotonic_now() < leave_until_) return false;
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (is_pending(i) && (units_[i].leaves || next_->leaves_drives))
            link_.happenings.tell(
                Severity::error, units_[i].number,
                fmt::format("{}: not every output could be put into its safe state before {}: {}",
                            units_[i].config->name,
                            units_[i].leaves ? "the station was taken away" : line_.port + " was left",
                            not_written(i)));
    return true;
}

/// The new drives come only now: no station writes to a drive that another one still leaves.
void DriveThread::apply_change()
{
    if (next_->line) line_ = *next_->line;
    std::vector<LineUnit> units;
    std::vector<std::optional<std::size_t>> stays;
    for (const DriveUnit& one : next_->units) {
        const auto known = find_unit(units_, one.number);
        const bool is_known = known != units_.end();
        if (is_known) troubles_.remove_changed_rows(*known, *one.config);
        stays.push_back(is_known ? std::optional{static_cast<std::size_t>(known - units_.begin())}
                                 : std::nullopt);
        units.push_back(is_known ? *known : LineUnit{one});
        units.back().config = one.config;
    }
    if (next_->opens_port) {
        port_.exchange(next_->is_held);
        if (next_->is_other_port) poller_.port_changed();
    }
    const drive::BlockRule rule = LineBackend::block_rule(line_);
    poller_.exchange(poller_settings(next_->units, line_), stays,
                     rule); // the tables of before are there still
    units_ = std::move(units);
    port_.set_units(next_->units);
    words_.resize(std::max<std::size_t>(words_.size(), rule.max_tags)); // those that stay keep their rule
    troubles_.keep_only(next_->units);
    orders_.on_other_drives();
    next_.reset();
    link_.changes_done.fetch_add(1, std::memory_order_release);
}

} // namespace dpslave::app
