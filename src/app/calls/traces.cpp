// SPDX-License-Identifier: Apache-2.0
#include "traces.hpp"

#include "dpslave/base/base64.hpp"
#include "dpslave/io/clock.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dpslave::app {

namespace {

/// Octets of records in one reply, and how many of them one tick sends: a bus that is always busy fills 60 kB
/// in a tick.
constexpr std::size_t kPart = 48 * 1024;
constexpr std::size_t kPartsInATick = 8;
/// A caller with more than this to fetch gets nothing further: its loss is counted instead.
constexpr std::size_t kMostUnsent = 4 * kPart;

} // namespace

/// The first source that has something is the next one; `at` comes back to 0 when all have been asked.
report::TraceReply Traces::part(Trace& trace, bool& is_due) const
{
    std::vector<std::uint8_t> records;
    trace::Record record;
    Source& source = trace.sources[trace.at];
    bool is_more = true;
    while (records.size() < kPart && (is_more = source.reader.next(record))) append(record, records);
    if (!is_more) trace.at = (trace.at + 1) % trace.sources.size();
    report::TraceReply reply;
    reply.records = to_base64(records);
    reply.line = source.line;
    reply.lost =
        static_cast<std::int64_t>(source.reader.lost() - std::exchange(source.lost, source.reader.lost()));
    reply.caught_up = !is_more && trace.at == 0;
    reply.hold_back_ns = bus_.hold_back_ns.load(std::memory_order_relaxed);
    reply.now_ns = io::monotonic_now().time_since_epoch().count();
    reply.unix_ns = io::unix_now().count();
    is_due = !records.empty() || (reply.caught_up && !trace.told_caught_up);
    trace.told_caught_up = trace.told_caught_up || reply.caught_up;
    return reply;
}

/// The rings that are wanted, without those that are off.
std::vector<Traces::Source> Traces::sources_of(const control::Json& parameters) const
{
    const auto from = parameters.value("from", "") == "newest" ? From::newest : From::oldest;
    const std::string wanted = parameters.value("line", "");
    const bool all = parameters.value("all", false);
    std::vector<Source> sources;
    if (wanted.empty() && bus_.trace.is_on())
        sources.push_back({.reader = trace::Ring::Reader{bus_.trace, from}, .line = {}, .keeps = {}});
    for (const auto& line : lines_) {
        const auto& trace = line->link.trace;
        if ((all && wanted.empty()) || line->config.name == wanted)
            if (trace->ring().is_on())
                sources.push_back({.reader = trace::Ring::Reader{trace->ring(), from},
                                   .line = line->config.name,
                                   .keeps = trace});
    }
    return sources;
}

/// Nothing: there is this line, or none is wanted.
std::optional<control::Error> Traces::no_such_line(const std::string& wanted) const
{
    std::vector<std::string> known;
    for (const auto& line : lines_) known.push_back(line->config.name);
    if (wanted.empty() || std::find(known.begin(), known.end(), wanted) != known.end()) return std::nullopt;
    return control::Error{"NoSuchLine", {{"line", wanted}, {"known", known}}};
}

control::Reply Traces::add(const control::Json& parameters, const control::Caller& caller)
{
    const std::string wanted = parameters.value("line", "");
    if (auto error = no_such_line(wanted)) return *std::move(error);
    Trace trace{.sources = sources_of(parameters), .line = wanted};
    if (trace.sources.empty()) return control::Error{"TraceOff", control::Json::object()};
    bool is_due = false;
    auto first = json_of(part(trace, is_due));
    if (!caller.more) return control::Done{std::move(first)};
    return traces_.open(caller.reply_to, std::move(trace), std::move(first));
}

void Traces::push()
{
    traces_.each([this](const control::ReplyTo& to, Trace& trace) {
        if (const auto error = no_such_line(trace.line)) { // it left by a reload: nothing more will come
            to.end(*error);
            return;
        }
        const std::size_t parts = kPartsInATick + trace.sources.size();
        for (std::size_t i = 0; i < parts && to.unsent() < kMostUnsent; ++i) {
            bool is_due = false;
            const report::TraceReply reply = part(trace, is_due);
            if (is_due && !to.send(json_of(reply))) break;
            if (!is_due && trace.at == 0) break; // each source has been asked
        }
    });
}

} // namespace dpslave::app
