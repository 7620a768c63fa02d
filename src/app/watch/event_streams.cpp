// SPDX-License-Identifier: Apache-2.0
#include "event_streams.hpp"

#include "dpslave/io/clock.hpp"

#include <algorithm>

namespace dpslave::app {

report::GetEventsReply events_report(const EventHistory& history, std::uint64_t after,
                                     const std::string& station, Instant now)
{
    report::GetEventsReply result;
    result.newest = integer(history.newest());
    const auto& all = history.events();
    const std::uint64_t first = all.empty() ? history.newest() + 1 : all.front().number;
    if (first > after + 1) result.lost = integer(first - after - 1);
    for (const EventHistory::Event& one : all) {
        if (one.number <= after || (!station.empty() && one.station != station)) continue;
        report::Event& event = result.events.emplace_back();
        event.number = integer(one.number);
        event.age_ms = std::chrono::duration<double, std::milli>(now - one.at).count();
        if (!one.station.empty()) event.station = one.station;
        event.kind = code(one.kind);
        event.text = one.text;
        event.count = integer(one.count);
    }
    return result;
}

control::Reply EventStreams::add(const control::Json& parameters, const control::Caller& caller)
{
    Follower follower;
    if (parameters.contains("station")) {
        const auto choice = monitor_.choose(parameters, true);
        if (choice.error) return *choice.error;
        follower.station = choice.station->config->name;
    }
    const auto after =
        static_cast<std::uint64_t>(std::max<std::int64_t>(parameters.value("after", std::int64_t{0}), 0));
    control::Json first = json_of(events_report(history_, after, follower.station, io::monotonic_now()));
    if (!caller.more) return control::Done{std::move(first)};
    follower.sent = history_.newest();
    const std::uint64_t number = replies_.next_stream++;
    followers_[number] = std::move(follower);
    return control::Stream{.stream = number, .first = std::move(first)};
}

void EventStreams::push(Instant now)
{
    if (followers_.empty()) return;
    const auto open = replies_.server->streams();
    std::erase_if(followers_, [&open](const auto& one) {
        return !std::binary_search(open.begin(), open.end(), one.first);
    });
    for (auto& [number, follower] : followers_) {
        if (follower.sent == history_.newest()) continue;
        const auto news = events_report(history_, follower.sent, follower.station, now);
        follower.sent = history_.newest();
        if (!news.events.empty() || news.lost > 0) replies_.server->push(number, json_of(news));
    }
}

} // namespace dpslave::app
