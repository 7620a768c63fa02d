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

std::string words_of_hanging(const DriveLine& line, std::span<const Station> stations, Instant now)
{
    std::string outputs;
    for (const Station& station : stations) {
        if (station.drive_line.get() != &line) continue;
        const Layout& layout = station.bus.layout;
        std::string tags;
        for (std::size_t i = 0; i < layout.count; ++i)
            if (layout.parameters[i].writes)
                tags += (tags.empty() ? "" : ", ") + std::to_string(layout.parameters[i].tag);
        if (!tags.empty())
            outputs += fmt::format("{}tag {} of {}", outputs.empty() ? "" : "; ", tags, station.config->name);
    }
    const std::string stall = stall_words(line, now - line.link.sign->last());
    if (outputs.empty()) return stall;
    return fmt::format("{}, and it is not known whether these outputs have their safe state: {}", stall,
                       outputs);
}

LineHappening stall_happening(const std::string& text)
{
    LineHappening happening{.kind = LineHappening::Kind::port_missing, .severity = Severity::error};
    text.copy(happening.text.data(), happening.text.size() - 1);
    return happening;
}

} // namespace dpslave::app
