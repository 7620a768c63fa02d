// SPDX-License-Identifier: Apache-2.0
#include "line_probe.hpp"

#include "app/links/probe_report.hpp"

#include <algorithm>

namespace dpslave::app {

std::chrono::milliseconds probe_timeout(const config::LineConfig& line)
{
    return std::clamp(line.timeout, std::chrono::milliseconds{100}, std::chrono::milliseconds{300});
}

drive::LineSearch probe_search(const config::LineConfig& line, const config::StationConfig& station,
                               const std::vector<drive::UnitAddress>& others)
{
    const bool is_modbus = line.protocol == config::kModbusRtu;
    const drive::LineSetting own{is_modbus ? drive::LineProtocol::modbus_rtu : drive::LineProtocol::ei_ascii,
                                 line.baud, line.format};
    std::vector<drive::Tag> tags =
        station.tags ? drive::sample_of(*station.tags, kProbeTags) : std::vector<drive::Tag>{};
    if (tags.empty()) tags = drive::usual_trial_tags();
    return {drive::search_near(own, station.unit, others),
            drive::RuleTrial{std::move(tags), drive::known_rules()}, probe_timeout(line),
            drive::SearchLimits{.units = 16, .trials = 1}};
}

} // namespace dpslave::app
