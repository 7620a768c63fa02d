// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/whole_file.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/live/tag_names.hpp"
#include "dpctl/plot/render_plot.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

using SampleReplies = std::vector<report::GetSamplesReply>;

struct PlotOptions {
    std::string station;
    std::vector<std::string> tags; ///< numbers or names
    std::chrono::nanoseconds last = std::chrono::minutes{10};
    std::string output; ///< a file; empty = in the terminal
    bool csv = false;   ///< a table
};

void set_up(CLI::App& app, PlotOptions& options)
{
    add_tags(app, options.tags);
    add_time(app, "--last", options.last, "How far back",
             {std::chrono::seconds{1}, std::chrono::hours{30 * 24}});
    add_output(app, options.output,
               "Write a picture (SVG) to FILE, or with --csv the table; - is standard output");
    app.add_flag("--csv", options.csv, "Print a table, one row for each sample");
    add_station_option(app, options.station);
}

std::chrono::seconds time_of(const PlotOptions& options)
{
    return std::chrono::ceil<std::chrono::seconds>(options.last);
}

/// All that the daemon has of a tag, reply by reply; with --json each is printed as it came.
Result<SampleReplies, int> fetch_samples(std::int64_t tag, const PlotOptions& options, Session& session)
{
    SampleReplies all;
    for (std::int64_t after = 0;;) {
        Json parameters = station_parameter(options.station);
        parameters["tag"] = tag;
        parameters["seconds"] = time_of(options).count();
        parameters["after"] = after;
        const auto json = session.ask("GetSamples", parameters);
        if (!json) return Failure{json.error()};
        if (session.json()) session.print_line(*json);
        all.push_back(report::read<report::GetSamplesReply>(*json));
        if (!all.back().more || all.back().newest <= after) return all;
        after = all.back().newest;
    }
}

/// Why there is nothing to draw.
std::string nothing_of(const Series& series, const std::string& station, const PlotOptions& options)
{
    const std::string name = series.name.empty() ? std::string{} : ' ' + printable(series.name);
    if (series.direction)
        return fmt::format(
            "dpctl: there is no value of tag {}{} of {} yet: its drive has not answered since the master chose the tags; see dpctl io\n",
            series.tag, name, printable(station));
    return fmt::format(
        "dpctl: tag {}{} of {} is not refreshed: it is not among the inputs and outputs that the master has chosen (dpctl io shows them)\nRead it with: dpctl read --every 1s {}{}\n",
        series.tag, name, printable(station), series.tag,
        options.station.empty() ? std::string{} : " --station " + printable(options.station));
}

int put_file(const std::string& text, const PlotOptions& options, Terminal& terminal)
{
    const auto failed = write_file(options.output, text, true);
    if (!failed) return kFine;
    terminal.err << "dpctl: " << printable(options.output) << ": " << failed->why << '\n';
    return kNo;
}

int put(const Plot& plot, const PlotOptions& options, Terminal& terminal)
{
    const bool is_chart = options.output.empty() && !options.csv;
    if (!is_chart)
        for (const std::string& note : plot.notes) terminal.err << "dpctl: " << note << '\n';
    if (!options.output.empty() && options.output != "-")
        return put_file(options.csv ? render_csv(plot) : render_svg(plot), options, terminal);
    terminal.out << (is_chart      ? render_chart(plot, terminal.width, terminal.utf8)
                     : options.csv ? render_csv(plot)
                                   : render_svg(plot))
                 << std::flush;
    return kFine;
}

int run(const PlotOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    if (options.tags.empty()) {
        terminal.err << "dpctl: name a tag; dpctl io shows those that have values\n"
                        "Run with --help for more information.\n";
        return kUsage;
    }
    const auto tags = find_tags(options.tags, options.station, session);
    if (!tags) return tags.error();
    Plot plot;
    SampleReplies firsts;
    for (const std::int64_t tag : *tags) {
        const auto replies = fetch_samples(tag, options, session);
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
    if (code != kFine || session.json()) return code;
    plot.time.from_ms = plot.time.to_ms - std::chrono::milliseconds{time_of(options)}.count();
    plot.notes = notes_of(plot, firsts);
    return put(plot, options, terminal);
}

} // namespace

const Command kPlot{"plot",
                    kWatch,
                    "Draws the values of a station over time, in the terminal or as SVG",
                    add<PlotOptions>,
                    "GetSamples, one a line",
                    "dpctl plot 55                                   the last ten minutes\n"
                    "dpctl plot \"speed feedback\" 56 --last 2m       names as for dpctl read\n"
                    "dpctl plot 55 --output speed.svg --station unwinder\n"
                    "dpctl plot 55 56 --csv -o speed.csv",
                    "1 there are no values of a tag"};

} // namespace dpslave::dpctl
