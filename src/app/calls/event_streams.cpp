// SPDX-License-Identifier: Apache-2.0
#include "event_streams.hpp"

#include "dpslave/io/clock.hpp"

#include <algorithm>

namespace dpslave::app {

report::GetEventsReply events_report(const RecentEvents& history, std::uint64_t after,
                                     const std::string& station, Instant now)
{
    report::GetEventsReply result;
    result.newest = integer(history.newest());
    const auto& all = history.events();
    const std::uint64_t first = all.empty() ? history.newest() + 1 : all.front().number;
    if (first > after + 1) result.lost = integer(first - after - 1);
    for (const RecentEvents::Event& one : all) {
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
    return followers_.open(caller.reply_to, std::move(follower), std::move(first));
}

void EventStreams::push(Instant now)
{
    followers_.each([&](const control::ReplyTo& to, Follower& follower) {
        if (follower.sent == history_.newest()) return;
        const auto news = events_report(history_, follower.sent, follower.station, now);
        follower.sent = history_.newest();
        if (!news.events.empty() || news.lost > 0) to.send(json_of(news));
    });
}

} // namespace dpslave::app
