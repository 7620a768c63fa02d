// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/words.hpp"
#include "survey.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace dpslave::dpctl {
namespace {

using profile::Survey;

std::vector<std::uint16_t> silent_tags(const Survey& seen)
{
    std::vector<std::uint16_t> tags;
    for (const auto& [tag, one] : seen)
        if (one.answers == 0 && one.denials == 0) tags.push_back(tag);
    return tags;
}

std::map<std::string, std::vector<std::uint16_t>> denied_tags(const Survey& seen)
{
    std::map<std::string, std::vector<std::uint16_t>> tags;
    for (const auto& [tag, one] : seen)
        if (one.denials > 0 && one.answers == 0) tags[one.denied].push_back(tag);
    return tags;
}

std::size_t answering(const Survey& seen)
{
    return static_cast<std::size_t>(
        std::count_if(seen.begin(), seen.end(), [](const auto& one) { return one.second.answers > 0; }));
}

/// Not more exact than it is: above a minute in steps of ten seconds, above ten minutes in whole ones.
std::string about(std::chrono::seconds time)
{
    std::int64_t s = time.count();
    if (s >= 600) {
        const std::int64_t minutes = (s + 59) / 60;
        return fmt::format("{}", age(static_cast<double>(minutes) * 60'000));
    }
    if (s < 60) return fmt::format("{} s", s);
    s = (s + 9) / 10 * 10;
    return s % 60 == 0 ? fmt::format("{} min", s / 60) : fmt::format("{} min {} s", s / 60, s % 60);
}

std::string count(std::size_t number, const char* one)
{
    return plural(static_cast<std::int64_t>(number), one);
}

} // namespace

std::string progress_line(const SurveyProgress& p)
{
    const std::string left = p.waits_for_drive ? std::string{"the drive does not answer, waiting for it"}
                             : p.left
                                 ? fmt::format("{}{} left", p.is_time_given ? "" : "about ", about(*p.left))
                                 : std::string{"the speed is not measured yet"};
    return fmt::format("{} of {} asked: {} answer, {} denied, {} silent; {}", p.visited, count(p.tags, "tag"),
                       p.answering, p.denied, p.silent, left);
}

std::string progress_bar(const SurveyProgress& progress)
{
    constexpr std::size_t width = 20;
    const auto full = static_cast<std::size_t>(std::clamp(progress.share, 0.0, 1.0) * width);
    return '[' + std::string(full, '#') + std::string(width - full, '-') + "] " + progress_line(progress);
}

Json survey_json(const SurveyReport& report)
{
    Json denied = Json::array();
    for (const auto& [reason, tags] : denied_tags(report.seen))
        denied.push_back({{"reason", reason}, {"tags", tags}});
    return {{"station", report.station},
            {"table", report.table},
            {"record", report.record},
            {"complete", report.complete},
            {"tags", report.tags},
            {"asked", report.seen.size()},
            {"answering", answering(report.seen)},
            {"denied", std::move(denied)},
            {"silent", silent_tags(report.seen)},
            {"added", report.joined.added},
            {"waiting", report.joined.waiting},
            {"contradictions", report.joined.contradictions}};
}

std::string render_survey(const SurveyReport& report)
{
    const auto denied = denied_tags(report.seen);
    const auto silent = silent_tags(report.seen);
    std::size_t denials = 0;
    for (const auto& [reason, tags] : denied) denials += tags.size();
    std::string out = fmt::format("{}: {} of {} asked: {} answer, {} denied, {} silent\n", report.station,
                                  report.seen.size(), count(report.tags, "tag"), answering(report.seen),
                                  denials, silent.size());
    // Most numbers of a family belong to no parameter of this drive; the record names them.
    for (const auto& [reason, tags] : denied)
        out += tags.size() > 20
                   ? fmt::format("denied ({}): {}, in {}\n", printable(reason), count(tags.size(), "tag"),
                                 report.record)
                   : fmt::format("denied ({}): {}\n", printable(reason), profile::spans_text(tags));
    if (!silent.empty()) out += fmt::format("silent: {}\n", profile::spans_text(silent));
    out += fmt::format("{}: {} for confirmation, {} of them new\n", report.table,
                       report.joined.waiting.size() == 1
                           ? "1 row waits"
                           : fmt::format("{} rows wait", report.joined.waiting.size()),
                       report.joined.added.size());
    if (!report.joined.contradictions.empty()) {
        out += "The drive contradicts:\n";
        for (const std::string& one : report.joined.contradictions) out += "  " + printable(one) + '\n';
    }
    if (!report.joined.waiting.empty())
        out +=
            "Next: compare these rows with the drive's manual, above all the decimals, and set confirmed to yes.\n";
    return out;
}

} // namespace dpslave::dpctl
