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
constexpr int kPartsInATick = 8;
/// A caller with more than this to fetch gets nothing further: its loss is counted instead.
constexpr std::size_t kMostUnsent = 4 * kPart;

} // namespace

report::TraceReply Traces::part(Trace& trace, bool& is_due) const
{
    std::vector<std::uint8_t> records;
    trace::Record record;
    bool is_more = true;
    while (records.size() < kPart && (is_more = trace.reader.next(record))) append(record, records);
    report::TraceReply reply;
    reply.records = to_base64(records);
    reply.lost =
        static_cast<std::int64_t>(trace.reader.lost() - std::exchange(trace.lost, trace.reader.lost()));
    reply.caught_up = !is_more;
    reply.hold_back_ns = bus_.hold_back_ns.load(std::memory_order_relaxed);
    reply.now_ns = io::monotonic_now().time_since_epoch().count();
    reply.unix_ns = io::unix_now().count();
    is_due = !records.empty() || (reply.caught_up && !trace.told_caught_up);
    trace.told_caught_up = trace.told_caught_up || reply.caught_up;
    return reply;
}

control::Reply Traces::add(const control::Json& parameters, const control::Caller& caller)
{
    if (!bus_.trace.is_on()) return control::Error{"TraceOff", control::Json::object()};
    using From = trace::Ring::Reader::From;
    const auto from = parameters.value("from", "") == "newest" ? From::newest : From::oldest;
    Trace trace{.reader = trace::Ring::Reader{bus_.trace, from}};
    bool is_due = false;
    auto first = json_of(part(trace, is_due));
    const std::uint64_t number = replies_.next_stream++;
    if (caller.more) traces_.emplace(number, trace);
    return control::Stream{.stream = number, .first = std::move(first)};
}

void Traces::push()
{
    std::erase_if(traces_, [this](const auto& one) {
        const auto open = replies_.server->streams();
        return !std::binary_search(open.begin(), open.end(), one.first);
    });
    for (auto& [number, trace] : traces_)
        for (int i = 0; i < kPartsInATick && replies_.server->unsent(number) < kMostUnsent; ++i) {
            bool is_due = false;
            const report::TraceReply reply = part(trace, is_due);
            if (!is_due || !replies_.server->push(number, json_of(reply))) break;
        }
}

} // namespace dpslave::app
