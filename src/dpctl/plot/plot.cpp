// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/gsd/gsd_files.hpp"
#include "dpctl/live/tag_names.hpp"
#include "render_plot.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/profile/survey.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

using Replies = std::vector<report::GetSamplesReply>;

std::chrono::seconds time_of(const Options& options)
{
    constexpr std::chrono::minutes kUsual{10};
    return profile::parse_duration(options.duration).value_or(kUsual);
}

/// All that the daemon has of a tag, reply by reply; with --json each is printed as it came.
Result<Replies, int> fetch(std::int64_t tag, const Options& options, Terminal& terminal)
{
    Replies all;
    for (std::int64_t after = 0;;) {
        Json parameters = station_parameter(options);
        parameters["tag"] = tag;
        parameters["seconds"] = time_of(options).count();
        parameters["after"] = after;
        const auto json = ask(options, terminal, "GetSamples", parameters);
        if (!json) return Failure{json.error()};
        if (options.json)
            terminal.out << printable_json(json->dump(-1, ' ', false, Json::error_handler_t::replace))
                         << std::endl;
        all.push_back(report::read<report::GetSamplesReply>(*json));
        if (!all.back().more || all.back().newest <= after) return all;
        after = all.back().newest;
    }
}

/// Why there is nothing to draw.
std::string nothing_of(const Series& series, const std::string& station, const Options& options)
{
    const std::string name = series.name.empty() ? std::string{} : ' ' + printable(series.name);
    if (series.direction)
        return fmt::format("dpctl: there is no value of tag {}{} of {} yet: its drive has not answered since "
                           "the master chose the tags; see dpctl io\n",
                           series.tag, name, printable(station));
    return fmt::format(
        "dpctl: tag {}{} of {} is not refreshed: it is not among the inputs and outputs that the "
        "master has chosen (dpctl io shows them)\nRead it with: dpctl read --every 1s {}{}\n",
        series.tag, name, printable(station), series.tag,
        options.station.empty() ? std::string{} : " --station " + printable(options.station));
}

int put_file(const std::string& text, const Options& options, Terminal& terminal)
{
    const auto failed = write_file(options.output, text, true);
    if (!failed) return kFine;
    terminal.err << "dpctl: " << printable(options.output) << ": " << failed->why << '\n';
    return kNo;
}

int put(const Plot& plot, const Options& options, Terminal& terminal)
{
    const bool is_chart = options.output.empty() && !options.csv;
    if (!is_chart)
        for (const std::string& note : plot.notes) terminal.err << "dpctl: " << note << '\n';
    if (!options.output.empty() && options.output != "-")
        return put_file(render_svg(plot), options, terminal);
    terminal.out << (is_chart      ? render_chart(plot, terminal.width, terminal.utf8)
                     : options.csv ? render_csv(plot)
                                   : render_svg(plot))
                 << std::flush;
    return kFine;
}

} // namespace

int do_plot(const Options& options, Terminal& terminal)
{
    if (options.words.empty()) {
        terminal.err << "dpctl: name a tag; dpctl io shows those that have values\n"
                        "Run with --help for more information.\n";
        return kUsage;
    }
    const auto tags = find_tags(options, terminal);
    if (!tags) return tags.error();
    Plot plot;
    Replies firsts;
    for (const std::int64_t tag : *tags) {
        const auto replies = fetch(tag, options, terminal);
        if (!replies) return replies.error();
        firsts.push_back(replies->front());
        plot.series.push_back(series_of(*replies));
        plot.station = replies->front().station;
        plot.time.to_ms = replies->back().now_unix_ms;
    }
    int code = kFine;
    for (const Series& series : plot.series)
        if (!series.has_values()) {
            terminal.err << nothing_of(series, plot.station, options);
            code = kNo;
        }
    if (code != kFine || options.json) return code;
    plot.time.from_ms = plot.time.to_ms - std::chrono::milliseconds{time_of(options)}.count();
    plot.notes = notes_of(plot, firsts);
    return put(plot, options, terminal);
}

} // namespace dpslave::dpctl
