// SPDX-License-Identifier: Apache-2.0
// What was counted, with a meaning beside each number.
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::app {

namespace {

struct Counter {
    std::string name;
    std::uint64_t value = 0;
    std::string_view meaning;
};
struct Group {
    std::uint32_t owner = 0; ///< the number of a station; CounterHistory::kOfBus, kOfControl
    std::string name;
    std::vector<Counter> counters; ///< the same in the same order each time
};

void add(std::vector<Counter>& counters, std::string name, std::uint64_t value, std::string_view meaning)
{
    counters.push_back({std::move(name), value, meaning});
}

Group bus_counters(const View& view)
{
    const fdl::Counters& fdl = view.bus.counters;
    std::vector<Counter> c;
    add(c, "octets", fdl.octets, "received");
    add(c, "telegrams", fdl.telegrams, "valid ones, to any address");
    add(c, "checked", fdl.checked, "those of them that have a checksum: noise cannot make them");
    add(c, "requests", fdl.requests, "to one of our addresses or to all");
    add(c, "replies", fdl.replies, "sent");
    add(c, "retries", fdl.retries,
        "answered with the stored reply: the master had not received the first one");
    add(c, "overtaken", fdl.overtaken,
        "requests dropped because something followed them: the machine reads too late");
    add(c, "late", fdl.late, "replies suppressed because MaxTsdr had passed: see [realtime] and max_tsdr");
    add(c, "too_late", view.bus.too_late,
        "replies begun in time whose write ended behind MaxTsdr: see [realtime] and max_tsdr");
    add(c, "own_address", fdl.own_address,
        "telegrams with one of our addresses as the sender: of another device, or those in came_back");
    add(c, "came_back", fdl.came_back, "replies that came back as they were sent: check echo under [bus]");
    add(c, "write_errors", view.bus.write_errors,
        "replies that the port did not accept, or did not send in time");
    add(c, "unsent", view.bus.unsent,
        "replies that did not go out: those, or the port was closed, or the driver enable did not work");
    add(c, "settings_changed", view.bus.settings_changed,
        "times another program had changed settings of the port, which are set again: dpctl doctor");
    add(c, "driver_raised", view.driver_raised,
        "times another program had raised the driver enable by opening the port: dpctl doctor");
    add(c, "driver_errors", view.bus.driver_errors,
        "edges of the driver enable that failed: check gpio_chip, gpio_line and the log");
    add(c, "driver_guarded", view.bus.driver_guarded,
        "times that the guard released the driver: the UART did not report that it had sent all");
    add(c, "echo_missing", view.bus.echo_missing,
        "echoes of our replies that did not come: check echo under [bus]");
    add(c, "echo_broken", view.bus.echo_broken,
        "echoes of our replies that differ from what was sent: a collision, or a short circuit");
    add(c, "page_faults", view.bus.page_faults,
        "of the bus thread while it serves: see lock_memory in [realtime]");
    for (std::size_t i = 0; i < fdl::kFlaws; ++i)
        add(c, fmt::format("flaw: {}", fdl::text(static_cast<fdl::Flaw>(i))), fdl.flaws[i],
            "pieces of the stream that were not a telegram: noise, wiring, termination, rate");
    add(c, "search_flaws", fdl.search_flaws,
        "the same while the rate was searched: at a rate that is not the bus's nothing is a telegram");
    add(c, "lost_events", view.lost_events, "events that did not fit into the log");
    return {CounterHistory::kOfBus, "bus", std::move(c)};
}

Group station_counters(const Station& station)
{
    const dp::Counters& dp = station.bus.counters;
    const drive::DriveSnapshot& drive = station.drive;
    std::vector<Counter> c;
    add(c, "data_exchange", dp.data_exchange, "Data_Exchange telegrams carried out");
    add(c, "slave_diag", dp.slave_diag, "");
    add(c, "set_prm", dp.set_prm, "");
    add(c, "foreign_prm", dp.foreign_prm, "those of them from a master that does not own this slave");
    add(c, "chk_cfg", dp.chk_cfg, "");
    add(c, "get_cfg", dp.get_cfg, "");
    add(c, "rd_inp", dp.rd_inp, "");
    add(c, "rd_outp", dp.rd_outp, "");
    add(c, "global_control", dp.global_control, "received, also those for other groups or of other masters");
    add(c, "not_activated", dp.not_activated,
        "requests answered RS: not possible in this state or for this master");
    add(c, "no_resource", dp.no_resource, "requests answered RR");
    add(c, "watchdog_expired", dp.watchdog_expired,
        "the master was silent for longer than its watchdog time");
    add(c, "left_data_exchange", dp.left_data_exchange,
        "times that Data_Exch was left: the outputs went to their safe state");
    add(c, "demand_orders", dp.demand_orders, "Demand Data reads and writes");
    add(c, "demand_rejects", dp.demand_rejects, "answered with 7");
    add(c, "drive_reads", drive.reads, "transactions with the drive");
    add(c, "drive_writes", drive.writes, "");
    add(c, "drive_silences", drive.silences, "transactions without answer");
    add(c, "drive_refusals", drive.refusals, "transactions that the drive refused");
    add(c, "drive_not_understood", drive.not_understood,
        "those of them that the drive could not take: noise on the way to it, or a wrong format");
    add(c, "drive_not_accepted", drive.heard.not_accepted,
        "requests that the drive refused for their checksum (EI-ASCII: EE 02): noise on the way to it");
    add(c, "drive_losses", drive.losses, "times the drive was treated as lost until it answered again");
    add(c, "drive_damaged", drive.heard.damaged, "answers with a wrong checksum, a parity error or no form");
    add(c, "drive_bad_checksum", drive.heard.bad_checksum,
        "those of them that were whole but for their checksum (EI-ASCII)");
    add(c, "drive_late", drive.heard.late, "answers that came after their timeout");
    add(c, "drive_foreign", drive.heard.foreign, "frames that answered no request");
    add(c, "drive_came_back", drive.heard.came_back,
        "requests that were received again: the line has an echo and [[line]] echo is off");
    add(c, "drive_early", drive.heard.early,
        "answers that had begun before the request had left: duplicates, or another master ([[line]] wire_time)");
    add(c, "drive_noise", drive.heard.noise,
        "times octets came that are no part of an answer, before one or (Modbus) instead of one: bias, direction");
    add(c, "drive_delay_ms", static_cast<std::uint64_t>(drive.heard.delay / std::chrono::milliseconds{1}),
        "of the late answers: the longest since one came in time");
    add(c, "drive_needs_timeout_ms", static_cast<std::uint64_t>(drive::needed_timeout(drive.heard).count()),
        "not 0: the drive is always late, and timeout_ms has to be at least this");
    add(c, "line_settings_changed", station.settings_changed,
        "of its line: times another program had changed settings of the port, which are set again");
    add(c, "line_late_releases", station.late_releases,
        "of its line: the transceiver was released later than a character behind a request");
    add(c, "line_driver_guarded", station.guarded_releases,
        "of its line: only a guard released the transceiver, the UART did not report that it had sent all");
    add(c, "line_driver_raised", station.driver_raised,
        "of its line: times another program had raised the driver enable by opening the port");
    add(c, "line_driver_errors", station.driver_errors,
        "of its line: edges of the driver enable that failed");
    add(c, "demand_orders_lost", dp.orders_lost, "Demand Data orders that the bus side had no room for");
    add(c, "drive_orders_dropped", drive.orders_dropped,
        "Demand Data writes that the master withdrew before they could be carried out");
    add(c, "line_orders_dropped", station.orders_dropped,
        "Demand Data writes that were never made: newer orders came while the line stalled");
    return {station.number, station.config->name, std::move(c)};
}

Group control_counters(const control::ServerCounters& calls)
{
    std::vector<Counter> c;
    add(c, "connections", calls.connections, "accepted");
    add(c, "calls", calls.calls, "");
    add(c, "errors", calls.errors, "calls answered with an error");
    add(c, "turned_away", calls.turned_away, "connections refused: all places were taken");
    add(c, "displaced", calls.displaced, "idle connections ended to make room for another one");
    add(c, "malformed", calls.malformed, "connections ended because what came was no call");
    add(c, "too_slow", calls.too_slow, "connections ended because replies were not fetched");
    add(c, "not_permitted", calls.not_permitted, "calls of users who may not operate");
    add(c, "handler_failures", calls.handler_failures, "faults of the daemon: report them");
    return {CounterHistory::kOfControl, "control socket", std::move(c)};
}

/// The bus first, then each station, then the control socket.
std::vector<Group> groups_of(const View& view)
{
    std::vector<Group> groups{bus_counters(view)};
    for (const Station& one : view.stations) groups.push_back(station_counters(one));
    groups.push_back(control_counters(view.calls));
    return groups;
}

report::Counter counter_report(const Counter& counter, const RecentCount* recent, Instant now)
{
    const auto age = [now](Instant then) {
        return then == Instant{}
                   ? std::nullopt
                   : std::optional{std::chrono::duration<double, std::milli>(now - then).count()};
    };
    report::Counter result{counter.name, integer(counter.value), std::string{counter.meaning}};
    if (recent == nullptr) return result;
    result.minute = integer(recent->in_span());
    result.last_age_ms = age(recent->last());
    result.since_age_ms = age(recent->since());
    return result;
}

report::Distribution distribution(const char* unit, const Histogram& counted)
{
    report::Distribution result{unit, integer(counted.count()), integer(counted.sum())};
    for (std::size_t n = 0; n < Histogram::kClasses; ++n) {
        if (counted.in_class(n) == 0) continue;
        result.classes.push_back({Histogram::lower_end(n), std::nullopt, integer(counted.in_class(n))});
        if (n + 1 < Histogram::kClasses) result.classes.back().to = integer(Histogram::lower_end(n + 1)) - 1;
    }
    if (counted.count() == 0) return result;
    result.p50 = counted.quantile(0.5);
    result.p99 = counted.quantile(0.99);
    result.p999 = counted.quantile(0.999);
    result.highest = counted.highest();
    return result;
}

} // namespace

void CounterHistory::sample(const View& view, Instant now)
{
    std::vector<std::vector<RecentCount>> next;
    std::vector<std::uint32_t> owners;
    for (const Group& group : groups_of(view)) {
        owners.push_back(group.owner);
        const auto known = std::find(owners_.begin(), owners_.end(), group.owner);
        std::vector<RecentCount>& counts = next.emplace_back(
            known != owners_.end() ? std::move(counts_[static_cast<std::size_t>(known - owners_.begin())])
                                   : std::vector<RecentCount>{});
        counts.resize(group.counters.size());
        for (std::size_t k = 0; k < counts.size(); ++k) counts[k].sample(group.counters[k].value, now);
    }
    owners_ = std::move(owners);
    counts_ = std::move(next);
}

const RecentCount* CounterHistory::find(std::uint32_t owner, std::size_t counter) const
{
    const auto known = std::find(owners_.begin(), owners_.end(), owner);
    if (known == owners_.end()) return nullptr;
    const std::vector<RecentCount>& counts = counts_[static_cast<std::size_t>(known - owners_.begin())];
    return counter < counts.size() ? &counts[counter] : nullptr;
}

report::GetCountersReply counters_report(const View& view, Instant now)
{
    report::GetCountersReply result;
    for (const Group& one : groups_of(view)) {
        report::CounterGroup& group = result.groups.emplace_back();
        group.name = one.name;
        for (std::size_t k = 0; k < one.counters.size(); ++k)
            group.counters.push_back(counter_report(one.counters[k], view.history.find(one.owner, k), now));
    }
    result.turnaround = {distribution("us", view.bus.turnaround_us),
                         distribution("T_bit", view.bus.turnaround_tbit)};
    for (const Station& one : view.stations)
        result.refresh.push_back({one.config->name, one.line != nullptr ? one.line->name : std::string{},
                                  distribution("ms", one.drive.refresh_ms)});
    return result;
}

} // namespace dpslave::app
