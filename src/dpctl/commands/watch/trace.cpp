// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/decode/decode.hpp"
#include "dpctl/trace/capture.hpp"
#include "dpctl/trace/incident.hpp"
#include "dpctl/trace/recording.hpp"
#include "dpctl/trace/trace_printer.hpp"
#include "dpctl/trace/trace_sources.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/number.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/input/wording.hpp"
#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <limits>

namespace dpslave::dpctl {
namespace {

struct TraceCommand : TraceOptions {};

/// What is wrong with --service: a part of the name of a service.
std::string service_fault(const std::string& text)
{
    constexpr std::array kOthers{"token", "SC", "no telegram", "reply"};
    std::vector<std::string> names = service_names(), shown;
    for (const std::string& name : names)
        if (!name.starts_with("request, ")) shown.push_back(name);
    names.insert(names.end(), kOthers.begin(), kOthers.end());
    const bool is_one = contains_any_case(text, "SAP") ||
                        std::any_of(names.begin(), names.end(),
                                    [&](const std::string& name) { return contains_any_case(name, text); });
    if (is_one) return {};
    return fmt::format("{}: no service has this in its name; there are {}, request, token",
                       input::in_quotes(text), fmt::join(shown, ", "));
}

void add_sources(CLI::App& app, TraceOptions& options)
{
    auto* const follow =
        app.add_flag("-f,--follow", options.follow, "Show what comes from now on, until Ctrl-C");
    auto* const list =
        app.add_flag("--incidents", options.incidents, "List what the daemon has kept of incidents")
            ->excludes(follow);
    auto* const incident =
        add_number(app, "--incident", options.incident, "The telegrams around this incident",
                   {1, std::numeric_limits<std::int64_t>::max()})
            ->excludes(follow)
            ->excludes(list);
    add_text(app, "--read", options.read, "FILE", "A capture (pcapng, pcap) in place of the daemon")
        ->excludes(follow)
        ->excludes(list)
        ->excludes(incident);
    add_text(app, "--line", options.line, "LINE",
             "The frames of this drive line in place of the bus, with the judgement of each answer")
        ->excludes(list);
}

void set_up(CLI::App& app, TraceOptions& options)
{
    add_sources(app, options);
    auto* const line = app.get_option("--line");
    add_station(app, options.station, "Only telegrams from or to this name or address");
    app.get_option("STATION")->excludes(line);
    app.get_option("--station")->excludes(line);
    add_text(app, "--service", options.service, "NAME",
             "Only services whose name has this part, as in \"diag\"", service_fault);
    app.add_flag("--bad", options.bad, "Only damaged or refused telegrams, and requests without a reply");
    add_text(
        app, "--stop-on", options.stop_on, "CONDITION",
        "End after the first telegram for which this holds: bad, unanswered, service=NAME, station=STATION, from=ADDRESS, to=ADDRESS; several with commas")
        ->excludes(line);
    auto* const file = add_output(app, options.file, "Write a capture (pcapng) in place of the text");
    add_choice(app, "--linktype", options.link_type, {"profibus", "user0"},
               "Of the capture: profibus (257, default), or user0 (147) for programs that do not know it")
        ->needs(file);
    auto* const decode =
        app.add_flag("--decode", options.decode,
                     "Below each telegram what it says: parameters, tags by name, values, diagnosis")
            ->excludes(file)
            ->excludes(line);
    add_text(app, "--gsd", options.gsd_folder, "DIR",
             "Folder of GSD files: texts of the diagnosis of other devices")
        ->needs(decode);
    add_text(app, "--profile", options.profile, "NAME",
             "With --read: the device of the slaves whose Set_Prm has its ident")
        ->needs(decode)
        ->needs("--read");
    add_profiles(app, options);
}

/// The address of a station, by name or number. The failure is an exit code; why is printed.
Result<std::uint8_t, int> address_of(const std::string& name, const TraceOptions& options, Session& session)
{
    if (!options.read.empty()) {
        if (const auto address = read_number(name, 0, 127)) return static_cast<std::uint8_t>(*address);
        session.terminal().err << "dpctl: a capture has no names of stations: write the address in place of "
                               << printable(name) << ", 0 to 127\n";
        return Failure{int{kUsage}};
    }
    const auto reply = session.ask("ListStations");
    if (!reply) return Failure{reply.error()};
    for (const report::Station& station : report::read<report::ListStationsReply>(*reply).stations)
        if (station.name == name || read_number(name) == station.address)
            return static_cast<std::uint8_t>(station.address);
    if (const auto address = read_number(name, 0, 127)) return static_cast<std::uint8_t>(*address);
    session.terminal().err << "dpctl: no station is called " << name
                           << ". Any address from 0 to 127 may be given as a number.\n";
    return Failure{int{kUsage}};
}

/// Of --stop-on; nothing: without it. The failure is an exit code; why is printed.
Result<std::optional<StopCondition>, int> stop_condition_of(const TraceOptions& options, Session& session)
{
    if (options.stop_on.empty()) return std::optional<StopCondition>{};
    auto condition = read_condition(options.stop_on);
    if (!condition) {
        session.terminal().err << "dpctl: --stop-on: " << condition.error() << '\n';
        return Failure{int{kUsage}};
    }
    if (!condition->station.empty()) {
        const auto address = address_of(condition->station, options, session);
        if (!address) return Failure{address.error()};
        condition->filter.address = *address;
    }
    return std::optional{StopCondition{*std::move(condition)}};
}

/// Looks which slaves are parameterised or configured in a trace.
class LayoutScan final : public EntryTaker {
public:
    void print(const trace::Entry& entry, UnixOffset /*offset*/, std::string_view /*note*/) override
    {
        if (const auto address = layout_changed_by(entry)) changed_.set(*address);
    }
    void print(const LineEntry& /*entry*/, UnixOffset /*offset*/, std::string_view /*note*/) override {}
    void expect_bus() override {}
    void flush() override {}
    bool has_stopped() const override { return false; }
    const std::bitset<128>& changed() const { return changed_; }

private:
    std::bitset<128> changed_;
};

/// With --decode: what is known beside the telegrams. A trace of the past is read twice, because a layout
/// that is in force now need not be that of its first telegrams. An incident has only the layout of its head.
/// The failure is an exit code; why is printed.
Result<std::optional<TraceSources>, int> sources_of(const TraceOptions& options,
                                                    const pcapng::Capture* capture, Session& session)
{
    if (!options.decode) return std::optional<TraceSources>{};
    if (capture != nullptr) {
        auto known = sources_of_capture(options, idents_in(*capture), session.terminal());
        if (!known) return Failure{known.error()};
        return std::optional<TraceSources>{*std::move(known)};
    }
    auto sources = trace_sources(options, session);
    if (!sources) return Failure{sources.error()};
    if (options.incident != 0) return std::optional<TraceSources>{*std::move(sources)};
    LayoutScan scan;
    std::int64_t ended_at = 0;
    if (!options.follow)
        if (const int failed = read_trace(options, scan, ended_at, session); failed != kFine)
            return Failure{int{failed}};
    set_layouts(*sources, scan.changed());
    return std::optional<TraceSources>{*std::move(sources)};
}

/// Of --output; nothing: without it. The failure is an exit code; why is printed.
Result<std::optional<TraceFile>, int> file_of(const TraceOptions& options, Session& session)
{
    if (options.file.empty()) return std::optional<TraceFile>{};
    auto made = TraceFile::create(
        options.file, options.link_type == "user0" ? pcapng::LinkType::user0 : pcapng::LinkType::profibus_dl,
        options.follow ? TraceFile::Order::as_they_come : TraceFile::Order::by_time);
    if (made) return std::optional{*std::move(made)};
    session.terminal().err << "dpctl: " << made.error() << '\n';
    return Failure{int{kNo}};
}

/// What prints an incident or a capture: the bus, or the line of --line, or into a file both. With --bad the
/// cause is printed in any case.
EntryPrinter entry_printer(const TraceOptions& options, Printer& printer)
{
    const auto print_telegram = [&](const trace::Entry& entry, UnixOffset offset, std::string_view note) {
        if (!options.line.empty()) return;
        printer.expect_bus();
        if (!printer.has_stopped()) printer.print(entry, offset, note);
    };
    const auto print_frame = [&](const LineEntry& entry, UnixOffset offset, std::string_view note) {
        const bool is_cause = options.bad && options.line.empty() && note == kCause;
        if (has_all(options) || entry.line == options.line || is_cause) printer.print(entry, offset, note);
    };
    return {.telegram = print_telegram, .frame = print_frame};
}

/// Of --read; nothing: without it. The failure is an exit code; why is printed.
Result<std::optional<pcapng::Capture>, int> capture_of(const TraceOptions& options, Session& session)
{
    if (options.read.empty()) return std::optional<pcapng::Capture>{};
    auto capture = open_capture(options, session.terminal());
    if (!capture) return Failure{capture.error()};
    return std::optional{*std::move(capture)};
}

int run(const TraceOptions& options, Session& session)
{
    if (options.incidents) return list_incidents(session);
    auto read = capture_of(options, session);
    if (!read) return read.error();
    const pcapng::Capture* const capture = *read ? &**read : nullptr;
    TraceFilter filter{.address = {}, .service = options.service, .bad = options.bad};
    if (!options.station.empty()) {
        const auto address = address_of(options.station, options, session);
        if (!address) return address.error();
        filter.address = *address;
    }
    auto stop = stop_condition_of(options, session);
    if (!stop) return stop.error();
    auto sources = sources_of(options, capture, session);
    if (!sources) return sources.error();
    auto opened = file_of(options, session);
    if (!opened) return opened.error();
    std::optional<TraceFile>& file = *opened;
    std::optional<TraceSources>& known = *sources;
    Printer printer{std::move(filter),       *std::move(stop),     known ? &known->decoder : nullptr,
                    file ? &*file : nullptr, options.read.empty(), session};
    std::int64_t ended_at = 0;
    const EntryPrinter print = entry_printer(options, printer);
    int code = kFine;
    if (capture != nullptr) {
        print_capture(*capture, print);
        if (!capture->packets.empty()) ended_at = capture->packets.back().unix_ns;
    } else {
        code = options.incident != 0 ? print_incident(options, session, print, ended_at)
                                     : read_trace(options, printer, ended_at, session);
    }
    if (code == kFine && !options.stop_on.empty() && !printer.has_stopped()) code = kNo;
    if (!file) return code;
    if (const auto trouble = file->finish(ended_at)) {
        session.terminal().err << "dpctl: " << *trouble << '\n';
        return kNo;
    }
    session.terminal().out << file->packets() << " packets in " << options.file << '\n';
    return code;
}

} // namespace

const Command kTrace{
    "trace",
    kWatch,
    "Shows the telegrams of the bus (root and the operator group)",
    add<TraceCommand>,
    kOwnForm,
    "dpctl trace --bad                      damaged and refused telegrams, and requests without a reply\n"
    "dpctl trace --follow --station 5       from now on, only from and to address 5\n"
    "dpctl trace --decode --service prm     what each Set_Prm says, octet by octet\n"
    "dpctl trace --follow --stop-on unanswered,to=5    until address 5 does not answer a request\n"
    "dpctl trace --line p3                  what the drives of line p3 were asked and answered\n"
    "dpctl trace --output bus.pcapng        into a capture for Wireshark\n"
    "dpctl trace --read bus.pcapng --bad    from a capture, without a daemon\n"
    "dpctl trace --incidents                what went wrong, and what is kept of it\n"
    "dpctl trace --incident 7               the seconds before and after it",
    "1 also if --stop-on was not met"};

} // namespace dpslave::dpctl
