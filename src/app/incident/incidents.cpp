// SPDX-License-Identifier: Apache-2.0
#include "incidents.hpp"

#include "dpslave/app/version.hpp"
#include "dpslave/base/base64.hpp"
#include "dpslave/io/clock.hpp"
#include "dpslave/refusal/words.hpp"
#include "dpslave/report/words.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;

namespace {

constexpr std::chrono::seconds kLongestRead{30};          // a disk that hangs keeps no caller
constexpr std::chrono::seconds kCountsInterval{60};       // a flash memory wears out
constexpr std::chrono::milliseconds kOldestSnapshot{200}; // one is published every 50 ms
constexpr std::size_t kMostEarly = 32, kMostWaiting = 4, kMostAsked = 8;

report::IncidentPart part_of(const IncidentKey& key, const std::string& text)
{
    report::IncidentPart part{.kind = std::string{code(key.kind)}, .reason = key.reason, .text = text};
    if (!key.station.empty()) part.station = key.station;
    return part;
}

report::IncidentStation station_of(const Station& station)
{
    report::IncidentStation one{.name = station.config->name,
                                .address = station.address,
                                .profile = station.config->profile->name,
                                .state = std::string{dp::text(station.bus.state)}};
    if (station.bus.master != dp::kNoMaster) one.master = station.bus.master;
    one.set_prm = hex(station.bus.prm);
    one.chk_cfg = hex(station.bus.cfg);
    return one;
}

report::Incident report_of(const Incident& incident)
{
    report::Incident one{.number = integer(incident.number),
                         .kind = std::string{code(incident.key.kind)},
                         .reason = incident.key.reason,
                         .text = incident.text,
                         .count = integer(incident.count),
                         .first_unix_ns = incident.first_unix_ns,
                         .last_unix_ns = incident.last_unix_ns,
                         .also = integer(incident.also.size())};
    if (!incident.key.station.empty()) one.station = incident.key.station;
    return one;
}

std::string reason_to_be_off(const config::TraceConfig& config, const std::filesystem::path& state)
{
    if (config.bus_kib == 0) return "bus_kib is 0 in [trace]";
    if (!config.incidents) return "incidents is false in [trace]";
    if (state.empty())
        return "the daemon has no folder for them: start it as a service, or set STATE_DIRECTORY";
    return {};
}

} // namespace

Incidents::Incidents(const Monitor& monitor, const BusLink& bus, const DriveLines& lines,
                     const std::filesystem::path& state)
    : monitor_(monitor),
      bus_(bus),
      lines_(lines),
      folder_(state / "incidents"),
      off_because_(reason_to_be_off(monitor.config().trace, state))
{}

void Incidents::on_happening(const Happening& happening, Instant now)
{
    if (!off_because_.empty()) return;
    for (const Station* const station : happening.recorded) {
        if (happening.bus_event != nullptr) on_bus_event(*station, *happening.bus_event, happening.text, now);
        if (!happening.drive_loss.empty())
            happened(IncidentKind::drive, station_of(*station), std::string{happening.drive_loss},
                     happening.text, now);
    }
}

void Incidents::on_bus_event(const Station& station, const dp::Event& event, const std::string& text,
                             Instant now)
{
    using Kind = dp::Event::Kind;
    if (event.kind == Kind::refused)
        happened(IncidentKind::refused, station_of(station), std::string{refusal::code(event.refusal.why)},
                 text, now);
    if (event.kind == Kind::foreign_set_prm)
        happened(IncidentKind::refused, station_of(station), "foreign_set_prm", text, now);
    if (event.kind != Kind::state) return;
    Exchange& exchange = exchanges_[station.number];
    const dp::State before = std::exchange(exchange.state, event.state);
    const bool is_our_own = event.reason == dp::LeaveReason::stop || event.reason == dp::LeaveReason::none;
    if (before == dp::State::data_exch && !is_our_own) {
        // As it was in the exchange: the telegrams that ended it are among the records.
        report::IncidentStation was = station_of(station);
        was.state = dp::text(before);
        if (event.master != dp::kNoMaster) was.master = event.master;
        was.set_prm = exchange.set_prm;
        was.chk_cfg = exchange.chk_cfg;
        happened(IncidentKind::left, was, std::string{report::code(event.reason)}, text, now);
    }
    if (event.state == dp::State::data_exch) exchange = {.state = event.state, .since = now};
}

/// A snapshot may be older than the event, and then of the exchange before; or newer, and then of its end.
/// What is of neither for certain is not known: a short exchange has its start-up among the records.
void Incidents::look_at_exchanges(Instant now)
{
    for (const Station& station : monitor_.view().stations) {
        const auto found = exchanges_.find(station.number);
        if (found == exchanges_.end() || !found->second.set_prm.empty()) continue;
        Exchange& exchange = found->second;
        const bool is_of_it =
            exchange.state == dp::State::data_exch && now - exchange.since >= kOldestSnapshot;
        if (!is_of_it || station.bus.state != dp::State::data_exch) continue;
        exchange.set_prm = hex(station.bus.prm);
        exchange.chk_cfg = hex(station.bus.cfg);
    }
}

void Incidents::look_at_flaws(Instant now)
{
    const auto& flaws = monitor_.view().bus.counters.flaws;
    std::uint64_t all = 0;
    for (const std::uint64_t count : flaws) all += count;
    if (!flaws_.count(all, now)) return;
    std::size_t most = 0;
    for (std::size_t i = 0; i < flaws.size(); ++i)
        if (flaws[i] - flaws_before_[i] > flaws[most] - flaws_before_[most]) most = i;
    flaws_before_ = flaws;
    const std::string reason{fdl::text(static_cast<fdl::Flaw>(most))};
    happened(
        IncidentKind::flaws, std::nullopt, reason,
        fmt::format("{} or more within a second were no telegram, most of them: {}", Burst::kLeast, reason),
        now);
}

void Incidents::look_at_answers(Instant now)
{
    const auto has_left = [this](const auto& one) { return monitor_.find(one.first) == nullptr; };
    if (heard_.size() > monitor_.view().stations.size()) {
        std::erase_if(heard_, has_left);
        std::erase_if(exchanges_, has_left);
    }
    for (const Station& station : monitor_.view().stations) {
        const drive::AnswerCounts& next = station.drive.heard;
        const auto [found, is_new] = heard_.try_emplace(station.number, next);
        const drive::AnswerCounts before = std::exchange(found->second, next);
        if (is_new) continue;
        const auto say = [&](const char* reason, const char* what) {
            happened(IncidentKind::answer, station_of(station), reason,
                     station.config->name + ": an answer of the drive was refused: " + what, now);
        };
        if (next.damaged > before.damaged) say("damaged", "it is damaged");
        if (next.late > before.late) say("late", "it came too late");
        if (next.foreign > before.foreign) say("foreign", "it answers nothing that was asked");
    }
}

void Incidents::happened(IncidentKind kind, std::optional<report::IncidentStation> station,
                         std::string reason, std::string text, Instant now)
{
    Noticed noticed{.key = {kind, station ? station->name : std::string{}, std::move(reason)},
                    .text = std::move(text),
                    .now = now,
                    .unix_ns = io::unix_now().count(),
                    .station = std::move(station)};
    if (is_searched_) return note(noticed);
    if (early_.size() < kMostEarly) early_.push_back(std::move(noticed));
}

void Incidents::note(const Noticed& noticed)
{
    using Verdict = IncidentBook::Verdict;
    const auto verdict = book_.happened(noticed.key, noticed.text, noticed.now, noticed.unix_ns);
    const auto add_station = [&] {
        const auto& station = noticed.station;
        const auto is_it = [&](const report::IncidentStation& one) { return one.name == station->name; };
        if (station && std::none_of(head_->stations.begin(), head_->stations.end(), is_it))
            head_->stations.push_back(*station);
    };
    if (verdict == Verdict::joined && head_ && head_->also.size() < IncidentBook::kMostAlso) {
        head_->also.push_back(part_of(noticed.key, noticed.text));
        add_station();
    }
    if (verdict != Verdict::opened) return;
    head_ = report::IncidentHead{.number = integer(book_.opened()->number),
                                 .what = part_of(noticed.key, noticed.text),
                                 .at_ns = noticed.now.time_since_epoch().count(),
                                 .unix_ns = noticed.unix_ns,
                                 .hold_back_ns = bus_.hold_back_ns.load(std::memory_order_relaxed),
                                 .program = kVersion};
    add_station();
    to_write_.push_back({.head = *head_});
    for (const std::uint64_t number : book_.take_dropped()) to_remove_.push_back(number);
}

void Incidents::on_time(Instant now)
{
    if (!off_because_.empty()) return;
    look_at_exchanges(now);
    look_at_flaws(now);
    look_at_answers(now);
    if (book_.is_complete(now) && head_) {
        to_write_.push_back({.head = *std::exchange(head_, std::nullopt), .is_complete = true});
        // A disk that hangs: what cannot be written while its telegrams are there is given up.
        while (to_write_.size() > kMostWaiting) {
            if (!to_write_.front().is_complete)
                book_.forget(static_cast<std::uint64_t>(to_write_.front().head.number));
            to_write_.pop_front();
            ++failures_;
        }
    }
    counts_wait_ = book_.take_counts_changed() || counts_wait_;
    if (job_.is_idle()) start_next(now);
    end_late_reads(now);
}

void Incidents::end_late_reads(Instant now)
{
    for (; !unanswered_.empty() && unanswered_.front().due <= now; unanswered_.pop_front()) {
        const Asked& late = unanswered_.front();
        late.to.end(
            Error{"IncidentUnreadable", {{"number", late.number}, {"reason", "the disk does not answer"}}});
    }
    std::erase_if(asked_, [](const Asked& one) { return !one.to.is_open(); });
}

/// The most urgent piece of work. False: there is none.
bool Incidents::start_next(Instant now)
{
    if (!is_searched_) return start_search();
    return start_writing() || start_removing() || start_reading() || start_counts(now);
}

bool Incidents::start_search()
{
    return job_.start([this, folder = folder_]() -> SideJob::Then {
        auto found = std::make_shared<FoundIncidents>(find_incidents(folder));
        return [this, found] {
            for (const std::string& fault : found->faults) spdlog::warn("{}", fault);
            book_.restore(std::move(found->kept), found->next_number);
            for (const std::uint64_t number : book_.take_dropped()) to_remove_.push_back(number);
            is_searched_ = true;
            for (const Noticed& noticed : std::exchange(early_, {})) note(noticed);
        };
    });
}

bool Incidents::start_writing()
{
    if (to_write_.empty()) return false;
    const Instant at{std::chrono::nanoseconds{to_write_.front().head.at_ns}};
    const Stretch stretch{.from = at - IncidentBook::kBefore, .at = at, .to = at + IncidentBook::kAfter};
    // The job keeps the rings of lines: a reload may take a line away while it reads.
    std::vector<std::pair<std::string, std::shared_ptr<const LineTrace>>> lines;
    for (const auto& line : lines_)
        if (line->link.trace->ring().is_on()) lines.emplace_back(line->config.name, line->link.trace);
    const bool is_started =
        job_.start([this, folder = folder_, writing = to_write_.front(), stretch, lines]() -> SideJob::Then {
            std::vector<LineRing> rings;
            for (const auto& [name, trace] : lines) rings.push_back({name, &trace->ring()});
            const auto failure = write_incident(folder, writing.head, bus_.trace, rings, stretch);
            return [this, failure, number = static_cast<std::uint64_t>(writing.head.number),
                    is_first = !writing.is_complete] {
                if (is_written(failure) || !is_first) return;
                if (book_.opened() != nullptr && book_.opened()->number == number) head_.reset();
                book_.forget(number);
            };
        });
    if (is_started) to_write_.pop_front();
    return is_started;
}

bool Incidents::start_removing()
{
    if (to_remove_.empty()) return false;
    return job_.start([folder = folder_, numbers = std::exchange(to_remove_, {})]() -> SideJob::Then {
        for (const std::uint64_t number : numbers) remove_incident(folder, number);
        return {};
    });
}

bool Incidents::start_reading()
{
    if (asked_.empty()) return false;
    const Asked asked = asked_.front();
    const bool is_started = job_.start([this, folder = folder_, asked]() -> SideJob::Then {
        auto piece = std::make_shared<const Result<IncidentPiece, std::string>>(
            read_piece(folder, asked.number, asked.offset));
        return [this, piece, asked] {
            if (*piece)
                asked.to.end(Done{
                    json_of(report::GetIncidentReply{to_base64((*piece)->octets), integer((*piece)->size)})});
            else
                asked.to.end(
                    Error{"IncidentUnreadable", {{"number", asked.number}, {"reason", piece->error()}}});
        };
    });
    if (is_started) asked_.pop_front();
    return is_started;
}

bool Incidents::start_counts(Instant now)
{
    if (!counts_wait_ || now < next_counts_) return false;
    next_counts_ = now + kCountsInterval;
    const bool is_started = job_.start([this, folder = folder_, counts = counts()]() -> SideJob::Then {
        const auto failure = write_counts(folder, counts);
        return [this, failure] { counts_wait_ = !is_written(failure) || counts_wait_; };
    });
    if (is_started) counts_wait_ = false;
    return is_started;
}

/// Says once that the disk takes nothing, and once that it does again.
bool Incidents::is_written(const std::optional<std::string>& failure)
{
    if (failure) {
        ++failures_;
        if (!trouble_)
            spdlog::warn("{}: incidents are not kept until the folder can be written again", *failure);
    } else if (trouble_) {
        spdlog::info("{}: incidents are kept again", folder_.string());
    }
    trouble_ = failure;
    return !failure;
}

report::IncidentCounts Incidents::counts() const
{
    report::IncidentCounts counts{.next = integer(book_.next_number())};
    for (const Incident& one : book_.kept())
        counts.counts.push_back({integer(one.number), integer(one.count), one.last_unix_ns});
    return counts;
}

control::Reply Incidents::list() const
{
    if (!off_because_.empty()) return Error{"IncidentsOff", {{"reason", off_because_}}};
    report::ListIncidentsReply reply{.folder = folder_.string(),
                                     .not_kept = integer(book_.not_kept()),
                                     .failures = integer(failures_),
                                     .trouble = trouble_};
    for (const Incident& one : book_.kept()) reply.incidents.push_back(report_of(one));
    return Done{json_of(reply)};
}

control::Reply Incidents::piece(const Json& parameters, const control::Caller& caller)
{
    if (!off_because_.empty()) return Error{"IncidentsOff", {{"reason", off_because_}}};
    const auto number = parameters["number"].get<std::int64_t>();
    const auto offset = std::max<std::int64_t>(parameters.value("offset", std::int64_t{0}), 0);
    if (book_.find(static_cast<std::uint64_t>(number)) == nullptr) {
        Json known = Json::array();
        for (const Incident& one : book_.kept()) known.push_back(one.number);
        return Error{"NoSuchIncident", {{"number", number}, {"known", std::move(known)}}};
    }
    if (asked_.size() == kMostAsked) return Error{"Busy", Json::object()};
    asked_.push_back({.to = caller.reply_to,
                      .number = static_cast<std::uint64_t>(number),
                      .offset = static_cast<std::uint64_t>(offset),
                      .due = io::monotonic_now() + kLongestRead});
    unanswered_.push_back(asked_.back());
    return control::Later{};
}

bool Incidents::end(std::chrono::milliseconds limit)
{
    if (!off_because_.empty()) return true;
    if (head_) to_write_.push_back({.head = *std::exchange(head_, std::nullopt), .is_complete = true});
    counts_wait_ = book_.take_counts_changed() || counts_wait_;
    next_counts_ = {};
    asked_.clear();
    const Instant until = io::monotonic_now() + limit;
    do {
        const auto left = std::chrono::floor<std::chrono::milliseconds>(until - io::monotonic_now());
        if (!job_.wait(left)) return false;
    } while (start_next(io::monotonic_now()));
    return true;
}

} // namespace dpslave::app
