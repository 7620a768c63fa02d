// SPDX-License-Identifier: Apache-2.0
#include "incident.hpp"

#include "dpctl/cli/words.hpp"
#include "trace_printer.hpp"

#include "dpslave/base/base64.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/fdl/telegram.hpp"
#include "dpslave/trace/incident_file.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>

namespace dpslave::dpctl {
namespace {

using Octets = std::vector<std::uint8_t>;

constexpr std::uint8_t kSetPrm = 61; // its SAP

std::string moment(std::int64_t unix_ns)
{
    using std::chrono::system_clock;
    return date_and_time(system_clock::time_point{
        std::chrono::duration_cast<system_clock::duration>(std::chrono::nanoseconds{unix_ns})});
}

/// The octets of "68 05 0A"; none of what is no such text.
Octets octets_of(std::string_view text)
{
    Octets octets;
    if (text.size() % 3 != 2) return octets;
    for (std::size_t at = 0; at < text.size(); at += 3) {
        std::uint8_t octet = 0;
        const char* const end = text.data() + at + 2;
        const bool is_one = std::from_chars(text.data() + at, end, octet, 16).ptr == end;
        if (!is_one || (at + 2 < text.size() && text[at + 2] != ' ')) return {};
        octets.push_back(octet);
    }
    return octets;
}

/// The whole file, piece by piece. The failure is an exit code; why is printed.
Result<Octets, int> fetch_incident(std::int64_t number, Session& session)
{
    Octets file;
    for (;;) {
        const auto reply = session.ask(
            "GetIncident", {{"number", number}, {"offset", static_cast<std::int64_t>(file.size())}});
        if (!reply) return Failure{reply.error()};
        const auto piece = report::read<report::GetIncidentReply>(*reply);
        const auto octets = from_base64(piece.octets);
        if (!octets || octets->empty() || std::cmp_greater(file.size() + octets->size(), piece.size))
            return file;
        file.insert(file.end(), octets->begin(), octets->end());
        if (std::cmp_equal(file.size(), piece.size)) return file;
    }
}

trace::Entry entry_of(trace::Entry::What what, const fdl::Frame& frame, Baud baud, Instant at)
{
    trace::Entry entry;
    entry.what = what;
    entry.baud = baud;
    entry.at = entry.first = at;
    entry.octets.assign(frame.bytes().begin(), frame.bytes().end());
    entry.last =
        at + duration_of(Tbit{static_cast<std::uint32_t>(entry.octets.size()) * kCharacter.count}, baud);
    return entry;
}

/// The entries of the bus. Ends before the first record that names a drive line.
std::vector<trace::Entry> take_bus(Bytes& rest, std::chrono::nanoseconds hold_back)
{
    trace::Telegrams telegrams{hold_back};
    std::vector<trace::Entry> entries;
    std::uint64_t expected = 0; // number of the next record; 0: not known
    Instant last{};
    Bytes ahead = rest;
    for (auto record = trace::take_record(ahead); record && record->head.kind != trace::Kind::line;
         record = trace::take_record(ahead)) {
        rest = ahead;
        last = record->head.at;
        if (expected != 0 && record->number > expected) telegrams.lost(record->number - expected, last);
        expected = record->number + 1;
        telegrams.add(*record);
    }
    telegrams.pass_time(last + std::chrono::seconds{1});
    while (auto entry = telegrams.take()) entries.push_back(*std::move(entry));
    return entries;
}

/// What the first telegrams of a master to a slave say of what was before them.
struct Before {
    bool is_exchange = false; ///< the first is Data_Exchange and not Set_Prm
    bool next_fcb = false;    ///< of the first that has one
};

Before before(const std::vector<trace::Entry>& entries, std::uint8_t da, std::uint8_t sa)
{
    std::optional<bool> fcb, exchange;
    for (const trace::Entry& entry : entries) {
        if (entry.what != trace::Entry::What::telegram) continue;
        const auto telegram = telegram_of(entry);
        if (!telegram || !telegram->is_request() || telegram->da != da || telegram->sa != sa) continue;
        if (!fcb && telegram->fcv()) fcb = telegram->fcb();
        const bool is_exchange = !telegram->dsap && telegram->delimiter != fdl::kSD1;
        if (is_exchange || telegram->dsap == kSetPrm) exchange = is_exchange;
        if (exchange) break;
    }
    return {exchange.value_or(false), fcb.value_or(false)};
}

/// Set_Prm and Chk_Cfg of the exchange that the telegrams `behind` go on with. Nothing if there was none, or
/// they are not known.
void add_start_up(const report::IncidentStation& station, const std::vector<trace::Entry>& behind,
                  std::vector<fdl::Frame>& to)
{
    constexpr std::uint8_t kChkCfg = 62, kMasterSap = 62;
    constexpr std::uint8_t kSrdHigh = 0x5D, kFcb = 0x20;
    const Octets prm = octets_of(station.set_prm), cfg = octets_of(station.chk_cfg);
    const bool is_known = station.master && *station.master >= 0 && *station.master <= 126 &&
                          station.address >= 0 && station.address <= 126 && !prm.empty() && !cfg.empty() &&
                          prm.size() <= 244 && cfg.size() <= 244;
    if (!is_known || behind.empty() || station.state != "Data_Exch") return;
    const auto da = static_cast<std::uint8_t>(station.address),
               sa = static_cast<std::uint8_t>(*station.master);
    const auto [is_exchange, next_fcb] = before(behind, da, sa);
    if (!is_exchange) return;
    // A slave takes a request with the bit of the one before it for a repeat.
    const auto of_cfg = static_cast<std::uint8_t>(next_fcb ? kSrdHigh : kSrdHigh | kFcb);
    const auto of_prm = static_cast<std::uint8_t>(of_cfg ^ kFcb);
    to.push_back(fdl::encode_sd2(da, sa, of_prm, kSetPrm, kMasterSap, prm));
    to.push_back(fdl::encode_sd2(da, sa, of_cfg, kChkCfg, kMasterSap, cfg));
}

/// The frames of the drive lines. Gives the names of the lines.
std::vector<std::string> take_lines(Bytes rest, std::vector<LineEntry>& frames)
{
    std::vector<std::string> lines;
    std::uint64_t expected = 0; // number of the next record; 0: not known
    while (const auto record = trace::take_record(rest)) {
        if (record->head.kind == trace::Kind::line) {
            const Bytes name = record->octets;
            lines.emplace_back(name.begin(), name.end());
            expected = 0;
            continue;
        }
        const auto entry = lines.empty() ? std::nullopt : line_entry_of(*record, lines.back());
        if (!entry) continue;
        if (expected != 0 && record->number > expected)
            frames.push_back(gap_before(*entry, record->number - expected));
        expected = record->number + 1;
        frames.push_back(*entry);
    }
    return lines;
}

void print_head(const report::IncidentHead& head, Session& session)
{
    if (session.json())
        session.print_line({{"what", "incident"}, {"incident", json_of(head)}});
    else
        session.terminal().out << render_incident(head);
}

} // namespace

std::string render_incidents(const report::ListIncidentsReply& reply, Look look)
{
    Table table({">NUMBER", "FIRST", ">COUNT", "LAST", "WHAT"});
    for (const report::Incident& one : reply.incidents) {
        const std::string more = one.also > 0 ? fmt::format(" (and {} more)", one.also) : std::string{};
        table.add({std::to_string(one.number), moment(one.first_unix_ns), std::to_string(one.count),
                   one.count > 1 ? moment(one.last_unix_ns) : std::string{"-"}, one.text + more});
    }
    std::string out = reply.incidents.empty() ? "no incident\n" : table.str(look);
    if (reply.not_kept > 0)
        out += fmt::format("{} not kept: too many within a short time\n",
                           plural(reply.not_kept, "further one was", "further ones were"));
    if (reply.trouble)
        out += fmt::format("{} could not be written; the last one: {}\n", plural(reply.failures, "file"),
                           *reply.trouble);
    return out;
}

std::string render_incident(const report::IncidentHead& head)
{
    std::string out =
        fmt::format("incident {}, {}: {}\n", head.number, moment(head.unix_ns), printable(head.what.text));
    for (const report::IncidentPart& part : head.also)
        out += fmt::format("  then: {}\n", printable(part.text));
    for (const report::IncidentStation& one : head.stations) {
        out += fmt::format("  {}: address {}, profile {}, {}{}\n", printable(one.name), one.address,
                           printable(one.profile), printable(one.state),
                           one.master ? fmt::format(", master {}", *one.master) : std::string{});
        out += fmt::format("    Set_Prm  {}\n", one.set_prm.empty() ? "-" : printable(one.set_prm));
        out += fmt::format("    Chk_Cfg  {}\n", one.chk_cfg.empty() ? "-" : printable(one.chk_cfg));
    }
    return out;
}

std::vector<trace::Entry> start_up(const std::vector<report::IncidentStation>& stations,
                                   const std::vector<trace::Entry>& behind)
{
    std::vector<fdl::Frame> requests;
    for (const report::IncidentStation& station : stations) add_start_up(station, behind, requests);
    if (requests.empty()) return {};
    constexpr std::chrono::milliseconds kPause{300}; // more than the longest telegram at any rate
    std::vector<trace::Entry> entries;
    Instant at = behind.front().first - kPause * 2 * static_cast<int>(requests.size());
    for (const fdl::Frame& request : requests) {
        entries.push_back(entry_of(trace::Entry::What::telegram, request, behind.front().baud, at));
        entries.push_back(
            entry_of(trace::Entry::What::reply, fdl::encode_sc(), behind.front().baud, at + kPause));
        at += kPause * 2;
    }
    return entries;
}

int list_incidents(Session& session)
{
    return session.show("ListIncidents", Json::object(), [&](const Json& json) {
        return render_incidents(report::read<report::ListIncidentsReply>(json), session.terminal().look());
    });
}

int print_incident(const TraceOptions& options, Session& session, const EntryPrinter& print,
                   std::int64_t& ended_at)
{
    const auto octets = fetch_incident(options.incident, session);
    if (!octets) return octets.error();
    const auto file = trace::read_incident(*octets);
    if (!file) {
        session.terminal().err << "dpctl: incident " << options.incident << ": " << file.error()
                               << ". It may have been replaced while it was read: try again.\n";
        return kNo;
    }
    const Json json = Json::parse(file->head, nullptr, false);
    const auto head = report::read<report::IncidentHead>(json.is_object() ? json : Json::object());
    if (options.file.empty()) print_head(head, session);
    const UnixOffset offset{head.unix_ns - head.at_ns};
    ended_at = head.unix_ns;
    const auto ends = [&](Instant last) { ended_at = std::max(ended_at, unix_ns(last, offset)); };
    Bytes records = file->records;
    const auto telegrams = take_bus(records, std::chrono::nanoseconds{head.hold_back_ns});
    for (const trace::Entry& entry : start_up(head.stations, telegrams))
        print.telegram(entry, offset, kBefore);
    const auto cause = cause_in(head, telegrams);
    for (std::size_t i = 0; i < telegrams.size(); ++i) {
        print.telegram(telegrams[i], offset, cause == i ? kCause : std::string_view{});
        ends(telegrams[i].last);
    }
    std::vector<LineEntry> frames;
    const auto lines = take_lines(records, frames);
    const auto cause_on_line = cause_in(head, frames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        print.frame(frames[i], offset, cause_on_line == i ? kCause : std::string_view{});
        ends(frames[i].last);
    }
    if (options.line.empty() || std::find(lines.begin(), lines.end(), options.line) != lines.end())
        return kFine;
    session.terminal().err << fmt::format("dpctl: incident {} has no drive line '{}'; it has: {}\n",
                                          options.incident, printable(options.line),
                                          printable(joined(lines, ", ")));
    return kUsage;
}

} // namespace dpslave::dpctl
