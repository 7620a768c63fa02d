// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "incident.hpp"
#include "trace_condition.hpp"
#include "trace_file.hpp"
#include "trace_gaps.hpp"
#include "trace_sources.hpp"

#include "dpslave/base/base64.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/report/replies.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <algorithm>
#include <bitset>

namespace dpslave::dpctl {
namespace {

/// The address of a station, by name or number. The failure is an exit code; why is printed.
Result<std::uint8_t, int> address_of(const std::string& name, const Options& options, Terminal& terminal)
{
    const auto reply = ask(options, terminal, "ListStations", Json::object());
    if (!reply) return Failure{reply.error()};
    for (const report::Station& station : report::read<report::ListStationsReply>(*reply).stations)
        if (station.name == name || std::to_string(station.address) == name)
            return static_cast<std::uint8_t>(station.address);
    const bool is_number =
        !name.empty() && name.size() <= 3 && name.find_first_not_of("0123456789") == std::string::npos;
    if (is_number && std::stoi(name) <= 127) return static_cast<std::uint8_t>(std::stoi(name));
    terminal.err << "dpctl: no station is called " << name
                 << ". Any address from 0 to 127 may be given as a number.\n";
    return Failure{int{kUsage}};
}

/// Of --stop-on; nothing: without it. The failure is an exit code; why is printed.
Result<std::optional<StopCondition>, int> stop_condition_of(const Options& options, Terminal& terminal)
{
    if (options.stop_on.empty()) return std::optional<StopCondition>{};
    auto condition = read_condition(options.stop_on);
    if (!condition) {
        terminal.err << "dpctl: --stop-on: " << condition.error() << '\n';
        return Failure{int{kUsage}};
    }
    if (!condition->station.empty()) {
        const auto address = address_of(condition->station, options, terminal);
        if (!address) return Failure{address.error()};
        condition->filter.address = *address;
    }
    return std::optional{StopCondition{*std::move(condition)}};
}

/// Prints entries as they come, and writes them into a file where one is wanted.
class Printer {
public:
    /// `file` and `decoder`: nullptr = none.
    Printer(TraceFilter filter, std::optional<StopCondition> stop, TraceDecoder* decoder, TraceFile* file,
            const Options& options, Terminal& terminal)
        : filter_(std::move(filter)),
          stop_(std::move(stop)),
          decoder_(decoder),
          file_(file),
          json_(options.json),
          terminal_(terminal)
    {}

    /// The condition of --stop-on has held: nothing more is printed.
    bool has_stopped() const { return has_stopped_; }

    /// What was printed until now reaches who reads it.
    void flush()
    {
        if (file_ != nullptr) file_->flush();
        terminal_.out << std::flush;
    }

    /// The bus is among what is asked for.
    void expect_bus()
    {
        if (file_ != nullptr) file_->add_bus();
    }

    void print(const LineEntry& entry, UnixOffset offset)
    {
        const std::string words = words_of(entry);
        const auto before = std::exchange(before_, entry.last);
        if (!passes(filter_, entry, words)) return;
        if (file_ != nullptr) return file_->add(entry, offset);
        if (json_)
            terminal_.out << printable_json(json_of(entry, words, offset).dump()) << '\n';
        else
            terminal_.out << line_of(entry, words, offset, before) << '\n';
    }

    /// `note`: where it is not an entry of the wire.
    void print(const trace::Entry& entry, UnixOffset offset, std::string_view note = {})
    {
        const TraceWords words = words_of(entry);
        const auto before = std::exchange(before_, entry.last);
        auto decoded = decoder_ != nullptr ? decoder_->decode(entry) : std::nullopt; // it learns from each
        has_stopped_ = stop_ && note.empty() && stop_->holds(entry, words);
        if (!has_stopped_ && !passes(filter_, entry, words)) return;
        if (file_ != nullptr) return file_->add(entry, words, offset, note);
        if (json_) {
            Json json = json_of(entry, words, offset);
            if (!note.empty()) json["note"] = note;
            if (decoder_ != nullptr) json["decoded"] = decoded ? decoded_json(*decoded) : Json(nullptr);
            terminal_.out << printable_json(json.dump()) << '\n';
            return;
        }
        terminal_.out << line_of(entry, words, offset, before);
        if (!note.empty()) terminal_.out << "  (" << note << ')';
        terminal_.out << '\n';
        if (const auto exact = decoder_ != nullptr ? how_exact(entry) : std::nullopt) {
            if (!decoded) decoded.emplace();
            decoded->lines.insert(decoded->lines.begin(), {"time", *exact});
        }
        if (decoded) terminal_.out << render_details(*decoded, kIndent, terminal_.look());
    }

private:
    static constexpr std::size_t kIndent = 4; ///< of what stands beneath a telegram

    TraceFilter filter_;
    std::optional<StopCondition> stop_;
    bool has_stopped_ = false;
    TraceDecoder* decoder_;
    TraceFile* file_;
    bool json_;
    Terminal& terminal_;
    std::optional<Instant> before_;
};

/// Looks which slaves are parameterised or configured in a trace.
class LayoutScan {
public:
    void print(const trace::Entry& entry, UnixOffset /*offset*/)
    {
        if (const auto address = layout_changed_by(entry)) changed_.set(*address);
    }
    void print(const LineEntry& /*entry*/, UnixOffset /*offset*/) {}
    void expect_bus() {}
    void flush() {}
    static bool has_stopped() { return false; }
    const std::bitset<128>& changed() const { return changed_; }

private:
    std::bitset<128> changed_;
};

/// What one reply brings.
struct Part {
    std::vector<trace::Record> records;
    std::vector<std::uint64_t> lost_before; ///< of each record
};
/// Nothing: its records cannot be read.
std::optional<Part> part_of(const report::TraceReply& reply)
{
    const auto octets = from_base64(reply.records);
    if (!octets) return std::nullopt;
    Part part;
    std::vector<std::uint64_t> numbers;
    Bytes rest = *octets;
    while (const auto record = trace::take_record(rest)) {
        numbers.push_back(record->number);
        part.records.push_back(*record);
    }
    if (!rest.empty()) return std::nullopt;
    part.lost_before =
        losses_before(numbers, static_cast<std::uint64_t>(std::max<std::int64_t>(reply.lost, 0)));
    return part;
}

/// What one reply brings of a drive line. False: its records cannot be read.
template <class Taker>
bool take_line(const report::TraceReply& reply, const Part& part, Taker& printer)
{
    const UnixOffset offset{reply.unix_ns - reply.now_ns};
    for (std::size_t i = 0; i < part.records.size(); ++i) {
        const auto entry = line_entry_of(part.records[i], *reply.line);
        if (!entry) return false;
        // The gap has the protocol of what comes behind it: its interface in a capture.
        if (part.lost_before[i] > 0) printer.print(gap_before(*entry, part.lost_before[i]), offset);
        printer.print(*entry, offset);
    }
    return true;
}

template <class Taker>
void print_finished(trace::Telegrams& telegrams, UnixOffset offset, Taker& printer)
{
    while (!printer.has_stopped()) {
        const auto entry = telegrams.take();
        if (!entry) break;
        printer.print(*entry, offset);
    }
}

/// What one reply brings. False: its records cannot be read.
template <class Taker>
bool take(const report::TraceReply& reply, trace::Telegrams& telegrams, Taker& printer)
{
    const auto part = part_of(reply);
    if (!part) return false;
    if (reply.line) return take_line(reply, *part, printer);
    printer.expect_bus();
    const UnixOffset offset{reply.unix_ns - reply.now_ns};
    for (std::size_t i = 0; i < part->records.size(); ++i) {
        const trace::Record& record = part->records[i];
        if (part->lost_before[i] > 0) telegrams.lost(part->lost_before[i], record.head.at);
        telegrams.add(record);
    }
    print_finished(telegrams, offset, printer);
    return true;
}

/// A capture has the drive lines as well, unless it is of some telegrams only. The past of a line is read
/// behind that of the bus, where --stop-on has ended it already.
bool has_all(const Options& options)
{
    const bool is_of_some = !options.drive.empty() || !options.station.empty() || !options.service.empty();
    return !options.file.empty() && !is_of_some && (options.follow || options.stop_on.empty());
}

/// Until all is printed, without an end with --follow. Gives the exit code.
template <class Taker>
int run(const Options& options, Taker& printer, std::int64_t& ended_at, Terminal& terminal)
{
    Json wanted = Json::object();
    if (options.follow) wanted["from"] = "newest";
    if (!options.drive.empty()) wanted["line"] = options.drive;
    if (has_all(options)) wanted["all"] = true;
    std::optional<trace::Telegrams> telegrams;
    bool is_read = true;
    std::int64_t now = 0; // of the last reply, on the clock of the records
    const int code =
        follow_replies(options, terminal, "Trace", wanted, [&](const control::ReplyMessage& reply) {
            const auto part = report::read<report::TraceReply>(reply.parameters);
            if (!telegrams) telegrams.emplace(std::chrono::nanoseconds{part.hold_back_ns});
            is_read = take(part, *telegrams, printer);
            ended_at = part.unix_ns;
            now = part.now_ns;
            printer.flush();
            return !is_read || printer.has_stopped() || (!options.follow && part.caught_up);
        });
    // The last reply may be of a drive line: what is unfinished on the bus is given up behind all of them.
    if (telegrams && !options.follow) {
        telegrams->pass_time(Instant{std::chrono::nanoseconds{now}});
        print_finished(*telegrams, UnixOffset{ended_at - now}, printer);
    }
    if (is_read) return code;
    terminal.err << "dpctl: the records of the daemon cannot be read. Is dpctl of the same version? Compare: "
                    "dpctl version\n";
    return kNo;
}

/// With --decode: what is known beside the telegrams. A trace of the past is read twice, because a layout
/// that is in force now need not be that of its first telegrams. An incident has only the layout of its head.
/// The failure is an exit code; why is printed.
Result<std::optional<TraceSources>, int> sources_of(const Options& options, Terminal& terminal)
{
    if (!options.decode) return std::optional<TraceSources>{};
    auto sources = trace_sources(options, terminal);
    if (!sources) return Failure{sources.error()};
    if (options.incident != 0) return std::optional<TraceSources>{*std::move(sources)};
    LayoutScan scan;
    std::int64_t ended_at = 0;
    if (!options.follow)
        if (const int failed = run(options, scan, ended_at, terminal); failed != kFine)
            return Failure{int{failed}};
    set_layouts(*sources, scan.changed());
    return std::optional<TraceSources>{*std::move(sources)};
}

/// Of --write; nothing: without it. The failure is an exit code; why is printed.
Result<std::optional<TraceFile>, int> file_of(const Options& options, Terminal& terminal)
{
    if (options.file.empty()) return std::optional<TraceFile>{};
    auto made = TraceFile::create(
        options.file, options.link_type == "user0" ? pcapng::LinkType::user0 : pcapng::LinkType::profibus_dl,
        options.follow ? TraceFile::Order::as_they_come : TraceFile::Order::by_time);
    if (made) return std::optional{*std::move(made)};
    terminal.err << "dpctl: " << made.error() << '\n';
    return Failure{int{kNo}};
}

/// What prints an incident: the bus, or the line of --drive, or into a capture both.
IncidentPrinter incident_printer(const Options& options, Printer& printer)
{
    const auto print_telegram = [&](const trace::Entry& entry, UnixOffset offset, std::string_view note) {
        if (!options.drive.empty()) return;
        printer.expect_bus();
        if (!printer.has_stopped()) printer.print(entry, offset, note);
    };
    const auto print_frame = [&](const LineEntry& entry, UnixOffset offset) {
        if (has_all(options) || entry.line == options.drive) printer.print(entry, offset);
    };
    return {.telegram = print_telegram, .frame = print_frame};
}

} // namespace

int do_trace(const Options& options, Terminal& terminal)
{
    if (options.incidents) return list_incidents(options, terminal);
    TraceFilter filter{.address = {}, .service = options.service, .bad = options.bad};
    if (!options.station.empty()) {
        const auto address = address_of(options.station, options, terminal);
        if (!address) return address.error();
        filter.address = *address;
    }
    auto stop = stop_condition_of(options, terminal);
    if (!stop) return stop.error();
    auto sources = sources_of(options, terminal);
    if (!sources) return sources.error();
    auto opened = file_of(options, terminal);
    if (!opened) return opened.error();
    std::optional<TraceFile>& file = *opened;
    std::optional<TraceSources>& known = *sources;
    Printer printer{std::move(filter),       *std::move(stop), known ? &known->decoder : nullptr,
                    file ? &*file : nullptr, options,          terminal};
    std::int64_t ended_at = 0;
    int code = options.incident != 0
                   ? print_incident(options, terminal, incident_printer(options, printer), ended_at)
                   : run(options, printer, ended_at, terminal);
    if (code == kFine && !options.stop_on.empty() && !printer.has_stopped()) code = kNo;
    if (!file) return code;
    if (const auto trouble = file->finish(ended_at)) {
        terminal.err << "dpctl: " << *trouble << '\n';
        return kNo;
    }
    terminal.out << file->packets() << " packets in " << options.file << '\n';
    return code;
}

} // namespace dpslave::dpctl
