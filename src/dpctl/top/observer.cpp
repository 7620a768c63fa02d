// SPDX-License-Identifier: Apache-2.0
#include "observer.hpp"

#include "dpctl/cli/words.hpp"

#include <algorithm>

namespace dpslave::dpctl {

/// With the last ones once more: equal events in a row are counted under the number of the first.
Json Observer::event_parameters() const
{
    constexpr std::int64_t kOnceMore = 8;
    Json parameters = station_parameter(station_);
    if (newest_) parameters["after"] = std::max<std::int64_t>(*newest_, kOnceMore) - kOnceMore;
    return parameters;
}

Result<Observer::Replies, Stopped> Observer::look()
{
    Replies replies;
    replies.all = Json::object();
    // GetIo first: it says whether there is such a station.
    for (const auto& [key, method, parameters] : {std::tuple{"io", "GetIo", station_parameter(station_)},
                                                  {"status", "GetStatus", Json::object()},
                                                  {"events", "GetEvents", event_parameters()},
                                                  {"counters", "GetCounters", Json::object()}}) {
        auto reply = session_.call(method, parameters);
        if (!reply) return Failure{reply.error()};
        replies.all[key] = *std::move(reply);
    }
    replies.at = std::chrono::steady_clock::now().time_since_epoch();
    replies.unix_seconds =
        std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    newest_ = report::read<report::GetEventsReply>(replies.all["events"]).newest;
    return replies;
}

std::pair<Sighting, report::GetEventsReply> read_replies(const Observer::Replies& replies)
{
    const auto of = [&](const char* key) { return printable_texts(replies.all.at(key)); };
    return {Sighting{replies.at, replies.unix_seconds, report::read<report::GetStatusReply>(of("status")),
                     report::read<report::GetCountersReply>(of("counters")),
                     report::read<report::GetIoReply>(of("io"))},
            report::read<report::GetEventsReply>(of("events"))};
}

} // namespace dpslave::dpctl
