// SPDX-License-Identifier: Apache-2.0
#include "recording.hpp"

#include "trace_gaps.hpp"

#include "dpslave/base/base64.hpp"
#include "dpslave/report/replies.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace dpslave::dpctl {
namespace {

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
bool take_line(const report::TraceReply& reply, const Part& part, EntryTaker& printer)
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

void print_finished(trace::Telegrams& telegrams, UnixOffset offset, EntryTaker& printer)
{
    while (!printer.has_stopped()) {
        const auto entry = telegrams.take();
        if (!entry) break;
        printer.print(*entry, offset);
    }
}

/// What one reply brings. False: its records cannot be read.
bool take(const report::TraceReply& reply, trace::Telegrams& telegrams, EntryTaker& printer)
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

} // namespace

bool has_all(const TraceOptions& options)
{
    const bool is_of_some = !options.line.empty() || !options.station.empty() || !options.service.empty();
    return !options.file.empty() && !is_of_some && (options.follow || options.stop_on.empty());
}

int read_trace(const TraceOptions& options, EntryTaker& printer, std::int64_t& ended_at, Session& session)
{
    Json wanted = Json::object();
    if (options.follow) wanted["from"] = "newest";
    if (!options.line.empty()) wanted["line"] = options.line;
    if (has_all(options)) wanted["all"] = true;
    std::optional<trace::Telegrams> telegrams;
    bool is_read = true;
    std::int64_t now = 0; // of the last reply, on the clock of the records
    const int code = session.follow("Trace", wanted, [&](const Json& reply) {
        const auto part = report::read<report::TraceReply>(reply);
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
    session.terminal().err
        << "dpctl: the records of the daemon cannot be read. Is dpctl of the same version? Compare: dpctl version\n";
    return kNo;
}

} // namespace dpslave::dpctl
