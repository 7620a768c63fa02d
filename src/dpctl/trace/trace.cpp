// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "incident.hpp"
#include "trace_file.hpp"

#include "dpslave/base/base64.hpp"
#include "dpslave/report/replies.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <algorithm>

namespace dpslave::dpctl {
namespace {

/// Whose address, by name or number. The failure is an exit code; why is printed.
Result<std::uint8_t, int> address_of(const Options& options, Terminal& terminal)
{
    const auto reply = ask(options, terminal, "ListStations", Json::object());
    if (!reply) return Failure{reply.error()};
    for (const report::Station& station : report::read<report::ListStationsReply>(*reply).stations)
        if (station.name == options.station || std::to_string(station.address) == options.station)
            return static_cast<std::uint8_t>(station.address);
    const bool is_number = !options.station.empty() && options.station.size() <= 3 &&
                           options.station.find_first_not_of("0123456789") == std::string::npos;
    if (is_number && std::stoi(options.station) <= 127)
        return static_cast<std::uint8_t>(std::stoi(options.station));
    terminal.err << "dpctl: no station is called " << options.station
                 << ". Any address from 0 to 127 may be given as a number.\n";
    return Failure{int{kUsage}};
}

/// Prints entries as they come, and writes them into a file where one is wanted.
class Printer {
public:
    Printer(TraceFilter filter, TraceFile* file, const Options& options, Terminal& terminal)
        : filter_(std::move(filter)), file_(file), json_(options.json), terminal_(terminal)
    {}

    /// `note`: where it is not an entry of the wire.
    void print(const trace::Entry& entry, UnixOffset offset, std::string_view note = {})
    {
        const TraceWords words = words_of(entry);
        const auto before = std::exchange(before_, entry.last);
        if (!passes(filter_, entry, words)) return;
        if (file_ != nullptr) return file_->add(entry, words, offset, note);
        if (json_) {
            Json json = json_of(entry, words, offset);
            if (!note.empty()) json["note"] = note;
            terminal_.out << json.dump() << '\n';
            return;
        }
        terminal_.out << line_of(entry, words, offset, before);
        if (!note.empty()) terminal_.out << "  (" << note << ')';
        terminal_.out << '\n';
    }

private:
    TraceFilter filter_;
    TraceFile* file_;
    bool json_;
    Terminal& terminal_;
    std::optional<Instant> before_;
};

/// What one reply brings. False: its records cannot be read.
bool take(const report::TraceReply& reply, trace::Telegrams& telegrams, Printer& printer)
{
    const UnixOffset offset{reply.unix_ns - reply.now_ns};
    const Instant now{std::chrono::nanoseconds{reply.now_ns}};
    const auto octets = from_base64(reply.records);
    if (!octets) return false;
    Bytes rest = *octets;
    auto record = trace::take_record(rest);
    if (reply.lost > 0)
        telegrams.lost(static_cast<std::uint64_t>(reply.lost), record ? record->head.at : now);
    for (; record; record = trace::take_record(rest)) telegrams.add(*record);
    if (reply.caught_up) telegrams.pass_time(now);
    while (const auto entry = telegrams.take()) printer.print(*entry, offset);
    return rest.empty();
}

/// Until all is printed, without an end with --follow. Gives the exit code.
int run(const Options& options, Printer& printer, std::int64_t& ended_at, Terminal& terminal)
{
    const Json from = options.follow ? Json{{"from", "newest"}} : Json::object();
    std::optional<trace::Telegrams> telegrams;
    bool is_read = true;
    const int code =
        follow_replies(options, terminal, "Trace", from, [&](const control::ReplyMessage& reply) {
            const auto part = report::read<report::TraceReply>(reply.parameters);
            if (!telegrams) telegrams.emplace(std::chrono::nanoseconds{part.hold_back_ns});
            is_read = take(part, *telegrams, printer);
            ended_at = part.unix_ns;
            terminal.out << std::flush;
            return !is_read || (!options.follow && part.caught_up);
        });
    if (is_read) return code;
    terminal.err << "dpctl: the records of the daemon cannot be read. Is dpctl of the same version? Compare: "
                    "dpctl version\n";
    return kNo;
}

} // namespace

int do_trace(const Options& options, Terminal& terminal)
{
    if (options.incidents) return list_incidents(options, terminal);
    TraceFilter filter{.address = {}, .service = options.service, .bad = options.bad};
    if (!options.station.empty()) {
        const auto address = address_of(options, terminal);
        if (!address) return address.error();
        filter.address = *address;
    }
    std::optional<TraceFile> file;
    if (!options.file.empty()) {
        auto made =
            TraceFile::create(options.file, options.link_type == "user0" ? pcapng::LinkType::user0
                                                                         : pcapng::LinkType::profibus_dl);
        if (!made) {
            terminal.err << "dpctl: " << made.error() << '\n';
            return kNo;
        }
        file.emplace(*std::move(made));
    }
    Printer printer{std::move(filter), file ? &*file : nullptr, options, terminal};
    std::int64_t ended_at = 0;
    const auto print = [&](const trace::Entry& entry, UnixOffset offset, std::string_view note) {
        printer.print(entry, offset, note);
    };
    const int code = options.incident != 0 ? print_incident(options, terminal, print, ended_at)
                                           : run(options, printer, ended_at, terminal);
    if (!file) return code;
    if (const auto trouble = file->finish(ended_at)) {
        terminal.err << "dpctl: " << *trouble << '\n';
        return kNo;
    }
    terminal.out << file->packets() << " packets in " << options.file << '\n';
    return code;
}

} // namespace dpslave::dpctl
