// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/drive_thread.hpp"

#include "dpslave/io/clock.hpp"

#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace dpslave::app {

namespace {

std::vector<drive::UnitSettings> unit_settings(const Config& config, std::size_t line)
{
    std::vector<drive::UnitSettings> units;
    for (const StationConfig& station : config.stations) {
        if (station.line != line) continue;
        drive::UnitSettings unit;
        unit.address = station.unit;
        unit.tags = station.tags.get();
        unit.tags_only_from_table = station.profile->tags_only_from_table;
        unit.output_refresh = station.output_refresh;
        unit.zero_after = station.zero_after;
        // Modbus instruments keep what they are told in a memory that wears: only what differs is written.
        unit.compare_outputs = config.lines[line].protocol == kModbusRtu;
        unit.never_written = station.profile->never_written;
        unit.watched = station.watched;
        unit.retries = config.lines[line].retries;
        units.push_back(unit);
    }
    return units;
}

} // namespace

DriveThread::DriveThread(const Config& config, std::size_t line, std::unique_ptr<drive::Backend> backend,
                         std::vector<std::unique_ptr<StationLink>>& stations, LineLink& link)
    : backend_(std::move(backend)),
      poller_(unit_settings(config, line), backend_->block_rule()),
      link_(link),
      words_(backend_->block_rule().max_tags)
{
    for (std::size_t i = 0; i < config.stations.size(); ++i)
        if (config.stations[i].line == line)
            units_.push_back({.config = &config.stations[i],
                              .station = static_cast<std::uint32_t>(i),
                              .link = stations[i].get(),
                              .zero_after_ms = to_ms(config.stations[i].zero_after),
                              .ended = 0,
                              .has_layout = false,
                              .was_known = false,
                              .answered = false});
}

void DriveThread::run(std::stop_token stop, io::EventFd& wake)
{
    while (!stop.stop_requested()) {
        fetch();
        const auto transaction = poller_.next(io::monotonic_now());
        if (transaction) carry_out(*transaction);
        publish(); // also what the poller has decided without the drive
        if (!transaction) rest(wake.fd(), io::monotonic_now());
    }
    farewell();
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
            unit.has_layout = outputs->layout.generation != 0;
        }
        while (const auto order = unit.link->demand_orders.pop()) poller_.set_demand(i, *order);
    }
    while (const auto order = link_.orders.pop())
        if (!poller_.operate(*order))
            link_.answers.push({.number = order->number, .error = AccessError::no_answer, .word = 0});
}

void DriveThread::carry_out(const drive::Transaction& transaction)
{
    using Kind = drive::Transaction::Kind;
    const Unit& unit = units_[transaction.unit];
    const drive::UnitAddress address = unit.config->unit;
    drive::Outcome outcome;
    switch (transaction.kind) {
        case Kind::read: {
            const std::span<std::uint16_t> words = std::span{words_}.first(transaction.count);
            outcome.error = backend_->read(address, *transaction.tag, words);
            outcome.words = words;
            break;
        }
        case Kind::write:
            outcome.error = backend_->write(address, *transaction.tag, transaction.words);
            break;
        case Kind::probe:
            outcome.error = backend_->probe(address) ? AccessError::none : AccessError::no_answer;
            break;
    }
    if (transaction.tag != nullptr && transaction.count == 1) {
        if (outcome.error == AccessError::none)
            forget_trouble(unit, transaction);
        else if (outcome.error != AccessError::no_answer)
            remember_trouble(unit, transaction, backend_->last_trouble());
    }
    poller_.done(outcome, io::monotonic_now());
}

void DriveThread::publish()
{
    for (std::size_t i = 0; i < units_.size(); ++i) {
        StationLink& link = *units_[i].link;
        if (const auto inputs = poller_.take_inputs(i)) link.inputs.publish(*inputs);
        while (const auto answer = poller_.take_demand_answer(i)) link.demand_answer.publish(*answer);
        link.drive_snapshot.publish(poller_.snapshot(i));
    }
    while (const auto answer = poller_.take_operate_answer()) link_.answers.push(*answer);
    say_link_changes();
}

void DriveThread::say_link_changes()
{
    for (std::size_t i = 0; i < units_.size(); ++i) {
        Unit& unit = units_[i];
        const drive::UnitSnapshot& now = poller_.snapshot(i);
        if (!now.known || (unit.was_known && unit.answered == now.answers)) continue;
        if (now.answers)
            spdlog::info("{}: the drive answers", unit.config->name);
        else
            spdlog::warn(
                "{}: the drive does not answer; inputs are held, outputs are written again when it returns",
                unit.config->name);
        unit.was_known = true;
        unit.answered = now.answers;
    }
}

/// Said once in the log, shown by `dpctl diag` until the access works.
void DriveThread::remember_trouble(const Unit& unit, const drive::Transaction& access,
                                   const std::string& text)
{
    const std::uint16_t tag = access.tag->number;
    const bool is_write = access.kind == drive::Transaction::Kind::write;
    const auto line = (is_write ? "write of tag " : "tag ") + std::to_string(tag) + ": " + text;
    for (std::size_t k = 0; k < troubles_.count; ++k) {
        Trouble& known = troubles_.troubles[k];
        if (known.station != unit.station || known.tag != tag || known.is_write != is_write) continue;
        if (line.compare(0, known.text.size() - 1, known.text.data()) == 0) return;
        forget_trouble(unit, access);
        break;
    }
    spdlog::warn("{}: {}", unit.config->name, line);
    if (troubles_.count == troubles_.troubles.size()) { // the oldest makes room
        std::copy(troubles_.troubles.begin() + 1, troubles_.troubles.end(), troubles_.troubles.begin());
        --troubles_.count;
    }
    Trouble& trouble = troubles_.troubles[troubles_.count++];
    trouble = {.station = unit.station, .tag = tag, .is_write = is_write, .text = {}};
    line.copy(trouble.text.data(), trouble.text.size() - 1);
    link_.troubles.publish(troubles_);
}

void DriveThread::forget_trouble(const Unit& unit, const drive::Transaction& access)
{
    const bool is_write = access.kind == drive::Transaction::Kind::write;
    const auto end = troubles_.troubles.begin() + troubles_.count;
    const auto found = std::find_if(troubles_.troubles.begin(), end, [&](const Trouble& one) {
        return one.station == unit.station && one.tag == access.tag->number && one.is_write == is_write;
    });
    if (found == end) return;
    std::copy(found + 1, end, found);
    --troubles_.count;
    link_.troubles.publish(troubles_);
}

/// Nothing to do: waits for the next deadline, but not longer than an order of the master may wait.
void DriveThread::rest(int wake, Instant now) const
{
    const bool busy = std::any_of(units_.begin(), units_.end(),
                                  [](const Unit& unit) { return unit.has_layout && unit.answered; });
    const std::chrono::nanoseconds tick = busy ? kTickWithLayout : kTickIdle;
    const auto wait = std::clamp<std::chrono::nanoseconds>(poller_.next_deadline() - now,
                                                           std::chrono::nanoseconds{0}, tick);
    const timespec time{.tv_sec = 0, .tv_nsec = static_cast<long>(wait.count())};
    pollfd one{.fd = wake, .events = POLLIN, .revents = 0};
    ::ppoll(&one, 1, &time, nullptr);
}

/// The bus has been left: the outputs still go to their safe state, as far as the drives let us. A drive that
/// does not answer at this moment is waited for as long as any.
void DriveThread::farewell()
{
    const Instant end = io::monotonic_now() + kFarewell;
    fetch();
    poller_.ride_no_longer(); // nobody is there any more to zero the outputs later
    while (poller_.safe_state_pending() && io::monotonic_now() < end) {
        if (const auto transaction = poller_.next(io::monotonic_now()))
            carry_out(*transaction);
        else
            rest(-1, io::monotonic_now()); // a negative descriptor is not looked at
    }
    if (poller_.safe_state_pending())
        spdlog::error("not every output could be put into its safe state: a drive does not answer");
    publish();
}

} // namespace dpslave::app
