// SPDX-License-Identifier: Apache-2.0
#include "limited_log.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace dpslave::app {
namespace {

void write(const RepeatedLines::Line& line)
{
    using Level = LimitedLog::Level;
    switch (static_cast<Level>(line.level)) {
        case Level::info: spdlog::info("{}", line.text); break;
        case Level::warning: spdlog::warn("{}", line.text); break;
        case Level::error: spdlog::error("{}", line.text); break;
    }
}

} // namespace

void LimitedLog::say(Level level, std::string_view key, std::string text, Instant now)
{
    on_time(now); // first: what is due is older
    if (const auto line = lines_.on_line(key, {static_cast<int>(level), std::move(text)}, now)) write(*line);
}

void LimitedLog::say(Level level, std::string text, Instant now)
{
    const std::string key = text;
    say(level, key, std::move(text), now);
}

void LimitedLog::on_time(Instant now)
{
    for (const RepeatedLines::Line& line : lines_.on_time(now)) write(line);
}

} // namespace dpslave::app
