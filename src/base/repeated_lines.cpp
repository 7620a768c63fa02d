// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/repeated_lines.hpp"

#include <algorithm>
#include <utility>

namespace dpslave {
namespace {

constexpr std::string_view kOthers = ""; ///< the key of lines beyond kMostKeys

std::string counted(std::string_view key, const std::string& text, std::uint64_t held)
{
    const std::string count = std::to_string(held);
    const std::string seconds = std::to_string(RepeatedLines::kQuiet.count()) + " s)";
    if (key == kOthers) return text + " (the newest of " + count + " different messages in " + seconds;
    return text + " (" + count + (held == 1 ? " more time in " : " more times in ") + seconds;
}

} // namespace

std::optional<RepeatedLines::Line> RepeatedLines::on_line(std::string_view key, Line line, Instant now)
{
    auto found = known_.find(key);
    if (found == known_.end() && known_.size() >= kMostKeys) found = known_.find(key = kOthers);
    ++lines_;
    if (found == known_.end()) {
        known_[std::string{key}] = {.newest = line, .quiet_until = now + kQuiet, .held = 0, .order = lines_};
        return line;
    }
    Known& known = found->second;
    known.newest = std::move(line);
    known.order = lines_;
    if (now < known.quiet_until || known.held > 0) {
        ++known.held; // those that are due are said by on_time()
        return std::nullopt;
    }
    known.quiet_until = now + kQuiet;
    return known.newest;
}

std::vector<RepeatedLines::Line> RepeatedLines::on_time(Instant now)
{
    std::vector<std::pair<std::uint64_t, Line>> due;
    for (auto it = known_.begin(); it != known_.end();) {
        Known& known = it->second;
        if (now < known.quiet_until) {
            ++it;
        } else if (known.held == 0) {
            it = known_.erase(it);
        } else {
            due.push_back(
                {known.order, {known.newest.level, counted(it->first, known.newest.text, known.held)}});
            known.held = 0;
            known.quiet_until = now + kQuiet;
            ++it;
        }
    }
    std::sort(due.begin(), due.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Line> lines;
    lines.reserve(due.size());
    for (auto& [order, line] : due) lines.push_back(std::move(line));
    return lines;
}

} // namespace dpslave
