// SPDX-License-Identifier: Apache-2.0
#include "limited_log.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace dpslave::app {
namespace {

void write(const RepeatedLines::Line& line)
{
    write_line(static_cast<Severity>(line.level), line.text);
}

} // namespace

void write_line(Severity severity, std::string_view text)
{
    switch (severity) {
        case Severity::info: spdlog::info("{}", text); break;
        case Severity::warning: spdlog::warn("{}", text); break;
        case Severity::error: spdlog::error("{}", text); break;
    }
}

void LimitedLog::say(Severity severity, std::string_view key, std::string text, Instant now)
{
    on_time(now); // first: what is due is older
    if (const auto line = lines_.on_line(key, {static_cast<int>(severity), std::move(text)}, now))
        write(*line);
}

void LimitedLog::on_time(Instant now)
{
    for (const RepeatedLines::Line& line : lines_.on_time(now)) write(line);
}

} // namespace dpslave::app
