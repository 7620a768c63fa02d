// SPDX-License-Identifier: Apache-2.0
#include "stalled_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dpslave::app {

std::vector<StalledLines::News> StalledLines::look(const std::vector<Station>& stations)
{
    std::vector<News> news;
    std::vector<std::shared_ptr<DriveLine>> stalled;
    for (const Station& station : stations) {
        const auto& line = station.drive_line;
        if (station.line_stalled.count() == 0 || std::ranges::count(stalled, line) != 0) continue;
        stalled.push_back(line);
        if (std::ranges::count(told_, line) != 0) continue;
        news.push_back({line,
                        fmt::format("{}: its drives count as lost. Look at the adapter and the cable of {}",
                                    stall_words(*line, station.line_stalled), line->config.port),
                        false});
    }
    // When it goes round again it says itself what had stalled.
    for (const auto& line : told_)
        if (std::ranges::count(stalled, line) == 0)
            news.push_back({line, fmt::format("line {} goes round again", line->config.name), true});
    told_ = std::move(stalled);
    return news;
}

LineHappening stall_happening(const std::string& text)
{
    LineHappening happening{.kind = LineHappening::Kind::port_missing, .severity = Severity::error};
    text.copy(happening.text.data(), happening.text.size() - 1);
    return happening;
}

} // namespace dpslave::app
