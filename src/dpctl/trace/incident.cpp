// SPDX-License-Identifier: Apache-2.0
#include "incident.hpp"

#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/words.hpp"

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
    for (std::size_t at = 0; at + 2 <= text.size(); at += 3) {
        std::uint8_t octet = 0;
        const char* const end = text.data() + at + 2;
        if (std::from_chars(text.data() + at, end, octet, 16).ptr != end) return {};
        octets.push_back(octet);
    }
    return octets;
}

/// The whole file, piece by piece. The failure is an exit code; why is printed.
Result<Octets, int> fetch(const Options& options, Terminal& terminal)
{
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return Failure{print_error(client.error(), terminal)};
    Octets file;
    for (;;) {
        const auto reply = client->call("GetIncident", {{"number", options.incident},
                                                        {"offset", static_cast<std::int64_t>(file.size())}});
        if (!reply) return Failure{print_error(reply.error(), terminal)};
        if (!reply->error.empty()) return Failure{print_error(*reply, options, terminal)};
        const auto piece = report::read<report::GetIncidentReply>(reply->parameters);
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

/// The entries of the wire, each after `begin` was called with the rate and time of the first record.
void print_records(Bytes rest, std::chrono::nanoseconds hold_back,
                   const std::function<void(Baud, Instant)>& begin,
                   const std::function<void(const trace::Entry&)>& print)
{
    trace::Telegrams telegrams{hold_back};
    std::optional<std::uint64_t> expected;
    Instant last{};
    for (auto record = trace::take_record(rest); record; record = trace::take_record(rest)) {
        last = record->head.at;
        if (!expected)
            begin(kBauds[record->head.rate], last);
        else if (record->number > *expected)
            telegrams.lost(record->number - *expected, last);
        expected = record->number + 1;
        telegrams.add(*record);
        while (const auto entry = telegrams.take()) print(*entry);
    }
    telegrams.pass_time(last + std::chrono::seconds{1});
    while (const auto entry = telegrams.take()) print(*entry);
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

std::vector<trace::Entry> start_up(const report::IncidentStation& station, Baud baud, Instant before)
{
    constexpr std::uint8_t kSetPrm = 61, kChkCfg = 62, kMasterSap = 62;
    constexpr std::uint8_t kSrdHigh = 0x5D, kSrdHighNext = 0x7D; // the frame count bit alternates
    const Octets prm = octets_of(station.set_prm), cfg = octets_of(station.chk_cfg);
    const bool is_known = station.master && *station.master >= 0 && *station.master <= 126 &&
                          station.address >= 0 && station.address <= 126 && !prm.empty() && !cfg.empty() &&
                          prm.size() <= 244 && cfg.size() <= 244;
    if (!is_known || station.state != "Data_Exch") return {};
    const auto da = static_cast<std::uint8_t>(station.address),
               sa = static_cast<std::uint8_t>(*station.master);
    using What = trace::Entry::What;
    constexpr std::chrono::milliseconds kPause{300}; // more than the longest telegram at any rate
    const std::pair<What, fdl::Frame> all[] = {
        {What::telegram, fdl::encode_sd2(da, sa, kSrdHigh, kSetPrm, kMasterSap, prm)},
        {What::reply, fdl::encode_sc()},
        {What::telegram, fdl::encode_sd2(da, sa, kSrdHighNext, kChkCfg, kMasterSap, cfg)},
        {What::reply, fdl::encode_sc()}};
    std::vector<trace::Entry> entries;
    Instant at = before - kPause * std::size(all);
    for (const auto& [what, frame] : all) {
        entries.push_back(entry_of(what, frame, baud, at));
        at += kPause;
    }
    return entries;
}

int list_incidents(const Options& options, Terminal& terminal)
{
    return show(options, terminal, "ListIncidents", Json::object(), [&](const Json& json) {
        return render_incidents(report::read<report::ListIncidentsReply>(json), terminal.look());
    });
}

int print_incident(const Options& options, Terminal& terminal, const PrintEntry& print,
                   std::int64_t& ended_at)
{
    const auto octets = fetch(options, terminal);
    if (!octets) return octets.error();
    const auto file = trace::read_incident(*octets);
    if (!file) {
        terminal.err << "dpctl: incident " << options.incident << ": " << file.error()
                     << ". It may have been replaced while it was read: try again.\n";
        return kNo;
    }
    const Json json = Json::parse(file->head, nullptr, false);
    const auto head = report::read<report::IncidentHead>(json.is_object() ? json : Json::object());
    if (options.file.empty() && options.json)
        terminal.out << printable_json(Json{{"what", "incident"}, {"incident", json_of(head)}}.dump(
                            -1, ' ', false, Json::error_handler_t::replace))
                     << '\n';
    if (options.file.empty() && !options.json) terminal.out << render_incident(head);
    const UnixOffset offset{head.unix_ns - head.at_ns};
    ended_at = head.unix_ns;
    print_records(
        file->records, std::chrono::nanoseconds{head.hold_back_ns},
        [&](Baud baud, Instant first) {
            if (head.stations.empty()) return;
            for (const trace::Entry& entry : start_up(head.stations.front(), baud, first))
                print(entry, offset, "from the head of the incident: it was before");
        },
        [&](const trace::Entry& entry) {
            print(entry, offset, {});
            ended_at = (entry.last.time_since_epoch() + offset).count();
        });
    return kFine;
}

} // namespace dpslave::dpctl
