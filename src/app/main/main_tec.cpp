// SPDX-License-Identifier: Apache-2.0
// GetTec and SetTec: the TEC OPTION function block of the stations that have one.
#include "main_thread.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

namespace {

/// As the function block shows it; empty: there is no such row.
std::string input_value(const DeviceState& device, const std::string& parameter)
{
    for (const tec::Row& row : device.rows())
        if (tec::is_called(row, parameter)) return row.shown;
    return {};
}

} // namespace

Reply MainThread::on_tec(const Json& parameters)
{
    const Choice choice = choose(parameters, false);
    if (choice.error) return *choice.error;
    const bool is_named = parameters.contains("station");
    if (is_named && !posts_[*choice.station].device.has_tec())
        return Error{"NoTecOption", {{"station", config_of(*choice.station).name}}};
    Json all = Json::array();
    for (std::size_t i = 0; i < posts_.size(); ++i)
        if ((!choice.station || *choice.station == i) && posts_[i].device.has_tec())
            all.push_back(tec_json(config_of(i).name, posts_[i].device));
    return Done{{{"stations", std::move(all)}}};
}

Reply MainThread::on_set_tec(const Json& parameters, const control::Caller& who)
{
    const Choice choice = choose(parameters, true);
    if (choice.error) return *choice.error;
    const config::StationConfig& station = config_of(*choice.station);
    DeviceState& device = posts_[*choice.station].device;
    if (!device.has_tec()) return Error{"NoTecOption", {{"station", station.name}}};

    const auto parameter = parameters["parameter"].get<std::string>();
    const auto value = parameters["value"].get<std::string>();
    const auto refused = [&](const std::string& reason) {
        return Error{"BadTecValue", {{"parameter", parameter}, {"value", value}, {"reason", reason}}};
    };
    // Two stations at one address would speak at the same time; only who knows all of them can tell.
    if (const auto address = device.address_after(parameter, value))
        for (std::size_t i = 0; i < posts_.size(); ++i)
            if (i != *choice.station && posts_[i].device.address() == *address)
                return refused(fmt::format("address {} is that of station {}: choose another", *address,
                                           config_of(i).name));
    const bool is_sure =
        parameters.contains("yes") && parameters["yes"].is_boolean() && parameters["yes"].get<bool>();
    const bool exchanges = view_.stations[*choice.station].bus.state == dp::State::data_exch;
    if (const auto fault = device.fault_after(parameter, value);
        exchanges && !is_sure && fault && *fault != OptionFault::none)
        return Error{"WouldSilence",
                     {{"station", station.name},
                      {"parameter", parameter},
                      {"value", value},
                      {"reason", fmt::format("FAULT would be {}", dpslave::text(*fault))}}};
    const std::string before = input_value(device, parameter);
    if (const auto reason = device.set(parameter, value)) return refused(*reason);
    spdlog::info("{}: {} set to {} by {}, before {}", station.name, parameter, input_value(device, parameter),
                 words_of(who), before);
    follow_device(*choice.station);
    Json all = Json::array();
    all.push_back(tec_json(station.name, device));
    return Done{{{"stations", std::move(all)}}};
}

} // namespace dpslave::app
