// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/explain.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/live/tag_names.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace dpslave::dpctl {
namespace {

struct ReadOptions {
    std::string station;
    std::vector<std::string> tags;                 ///< numbers or names
    std::optional<std::chrono::nanoseconds> every; ///< nothing: once
    bool names = false;                            ///< the names of the tags
};

void set_up(CLI::App& app, ReadOptions& options)
{
    add_tags(app, options.tags);
    auto* every = add_time(app, "--every", options.every, "Read again and again, until Ctrl-C", kIntervals);
    app.add_flag("--names", options.names, "Print the tags and their names; with TAG only those that fit")
        ->excludes(every);
    add_station_option(app, options.station);
}

/// Why the drive gives no value: with --every the next round may have one.
bool passes(const Stopped& stopped)
{
    return stopped.refused && (stopped.refused->error == "org.dpslaved.Control.DriveRefused" ||
                               stopped.refused->error == "org.dpslaved.Control.Busy");
}

/// `is_repeated`: with the time of day in front.
void print_tag(const Result<Json, Stopped>& reply, bool is_repeated, Session& session)
{
    Terminal& terminal = session.terminal();
    const control::ReplyMessage error = reply ? control::ReplyMessage{} : *reply.error().refused;
    if (session.json())
        session.print_line(reply ? *reply
                                 : Json::object({{"error", error.error}, {"parameters", error.parameters}}));
    else if (!reply)
        terminal.err << "dpctl: "
                     << explain({printable_texts(error.parameters), printable(error.error), false})
                     << std::endl;
    else
        terminal.out << (is_repeated ? time_of_day(std::chrono::system_clock::now()) + " " : std::string{})
                     << render_tag(printable_texts(*reply), "is");
    terminal.out << std::flush;
}

/// One tag after the other: at most one read of ours waits in the daemon at any time. `every`: the time from
/// the beginning of a round to that of the next one; none: one round. Gives the exit status.
int read_all(const std::vector<std::int64_t>& tags, std::optional<std::chrono::nanoseconds> every,
             const std::string& station, Session& session)
{
    session.catch_signals();
    int failed = kFine; // what the first refusal demands
    const auto pause =
        std::chrono::ceil<std::chrono::milliseconds>(every.value_or(std::chrono::nanoseconds{0}));
    for (Pace pace{pause}; session.terminal().out;) {
        for (const std::int64_t tag : tags) {
            Json parameters = station_parameter(station);
            parameters["tag"] = tag;
            const auto reply = session.call("ReadTag", parameters);
            if (!reply && !passes(reply.error())) return session.print_stopped(reply.error());
            if (failed == kFine && !reply) failed = exit_of(*reply.error().refused);
            print_tag(reply, every.has_value(), session);
        }
        if (!every) return failed;
        if (session.pause_until(pace.next())) return kFine;
    }
    return kNo; // what we print is not taken any more
}

/// The tags with their names, or those that options.tags fit.
int list_tags(const ReadOptions& options, Session& session)
{
    Json parameters = station_parameter(options.station);
    if (!options.tags.empty()) parameters["name"] = joined(options.tags, " ");
    return session.show("FindTags", parameters, [&](const Json& reply) {
        const auto found = report::read<report::FindTagsReply>(reply);
        if (found.tags.empty()) return fmt::format("no tag of {} has such a name\n", found.station);
        return tag_lines(found.tags, found.tags.size(), session.terminal().look());
    });
}

int run(const ReadOptions& options, Session& session)
{
    if (options.names) return list_tags(options, session);
    if (options.tags.empty()) {
        session.terminal().err << "dpctl: name a tag; dpctl read --names prints the names\n"
                                  "Run with --help for more information.\n";
        return kUsage;
    }
    const auto tags = find_tags(options.tags, options.station, session);
    if (!tags) return tags.error();
    if (tags->size() > 1 || options.every) return read_all(*tags, options.every, options.station, session);
    Json parameters = station_parameter(options.station);
    parameters["tag"] = tags->front();
    return session.show("ReadTag", parameters, [](const Json& reply) { return render_tag(reply, "is"); });
}

} // namespace

const Command kRead{
    "read",
    kLook,
    "Reads tags from the drive now, by number or by name",
    add<ReadOptions>,
    "ReadTag, with several tags or --every one a line; with --names that of FindTags",
    "dpctl read 55 --station unwinder\n"
    "dpctl read \"speed feedback\"         a name, or the part of one that fits no other tag\n"
    "dpctl read 55-57,60                  several, also as 55 56 57 60\n"
    "dpctl read --every 1s 55 56          until Ctrl-C\n"
    "dpctl read --names speed             tags with this in their names"};

} // namespace dpslave::dpctl
