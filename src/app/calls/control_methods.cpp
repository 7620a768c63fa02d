// SPDX-License-Identifier: Apache-2.0
#include "control_methods.hpp"

#include "app/state/emulated_device.hpp"
#include "samples.hpp"
#include "tag_names.hpp"

#include "dpslave/app/version.hpp"
#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <utility>

namespace dpslave::app {

using control::Caller;
using control::Done;
using control::Error;
using control::Json;
using control::Reply;
using control::Right;

namespace {

/// As the function block shows it; empty: there is no such row.
std::string input_value(const TecOption& tec, const std::string& parameter)
{
    for (const tec::Row& row : tec.rows())
        if (tec::is_called(row, parameter)) return row.shown;
    return {};
}

constexpr std::size_t kMostFoundTags = 2000;
constexpr std::int64_t kUsualDebug_s = 600, kLongestDebug_s = 86'400;

report::FindTagsReply found_tags(const Station& station, const std::string& name)
{
    report::FindTagsReply result{station.config->name, {}};
    for (const drive::Tag* tag : tags_called(*station.config->tags, name))
        if (result.tags.size() < kMostFoundTags) result.tags.push_back({tag->number, tag->name});
    return result;
}

} // namespace

/// At level debug each call is a line of the log.
control::Methods ControlMethods::methods()
{
    control::Methods all = all_methods();
    for (auto& [name, method] : all)
        method.answer = [name = name, inner = std::move(method.answer)](const Json& parameters,
                                                                        const Caller& caller) {
            if (spdlog::should_log(spdlog::level::debug))
                spdlog::debug("control socket: {} of {}", name, words_of(caller));
            return inner(parameters, caller);
        };
    return all;
}

control::Methods ControlMethods::all_methods()
{
    const auto with = [](auto method) {
        return [method](const Json&, const Caller&) -> Reply { return Done{json_of(method())}; };
    };
    const auto each = [this](auto one) {
        return [this, one](const Json& parameters, const Caller&) -> Reply {
            const View& view = parts_.monitor.view();
            const auto choice = parts_.monitor.choose(parameters, false);
            if (choice.error) return *choice.error;
            Json all = Json::array();
            for (const Station& station : view.stations)
                if (choice.station == nullptr || choice.station == &station)
                    all.push_back(json_of(one(station)));
            return Done{{{"stations", std::move(all)}}};
        };
    };
    const auto one = [this](auto method) {
        return [this, method](const Json& parameters, const Caller& caller) -> Reply {
            const auto choice = parts_.monitor.choose(parameters, true);
            if (choice.error) return *choice.error;
            return method(*choice.station, parameters, caller);
        };
    };
    const auto now = [] { return io::monotonic_now(); };
    const Monitor& monitor = parts_.monitor;
    return {
        {"GetVersion", {Right::look, with([] {
                            return report::GetVersionReply{"dpslaved", std::string{kVersion},
                                                           std::string{control::kInterface}};
                        })}},
        {"GetStatus", {Right::look, with([this] { return status(); })}},
        {"ListStations", {Right::look, with([&monitor, now] {
                              return report::ListStationsReply{stations_report(monitor.view(), now())};
                          })}},
        {"GetInfo", {Right::look, each([this](const Station& station) { return info(station); })}},
        {"GetIo", {Right::look, each([now](const Station& station) { return io_report(station, now()); })}},
        {"GetDiagnosis",
         {Right::look, each([](const Station& station) { return diagnosis_report(station); })}},
        {"GetCounters",
         {Right::look, with([&monitor, now] { return counters_report(monitor.view(), now()); })}},
        {"GetBus", {Right::look, with([&monitor, now] { return members_report(monitor.view(), now()); })}},
        {"GetLeds", {Right::look, each([this](const Station& station) { return leds(station); })}},
        {"GetTec", {Right::look, [this](const Json& parameters, const Caller&) { return tec(parameters); }}},
        {"Watch",
         {Right::look,
          [this](const Json& parameters, const Caller& caller) { return watch(parameters, caller); }}},
        {"ProbeDrive",
         {Right::operate, one([this](const Station& station, const Json& parameters, const Caller& caller) {
              return parts_.probes.start(station, parameters, caller);
          })}},
        {"GetEvents",
         {Right::look,
          [this](const Json& parameters, const Caller& caller) {
              return parts_.event_streams.add(parameters, caller);
          }}},
        {"FindTags",
         {Right::look, one([](const Station& station, const Json& parameters, const Caller&) -> Reply {
              return Done{json_of(found_tags(station, parameters.value("name", std::string{})))};
          })}},
        {"GetSamples", {Right::look, one([](const Station& station, const Json& parameters, const Caller&) {
                            return get_samples(station, parameters);
                        })}},
        {"SetLogLevel",
         {Right::operate, [this](const Json& parameters,
                                 const Caller& caller) { return set_log_level(parameters, caller); }}},
        {"ReadTag",
         {Right::look, one([this](const Station& station, const Json& parameters, const Caller& caller) {
              return parts_.accesses.read(station, parameters, caller);
          })}},
        {"GetSurveyScope",
         {Right::look, one([this](const Station& station, const Json& parameters, const Caller&) {
              return parts_.accesses.survey_scope(station, parameters);
          })}},
        {"Survey",
         {Right::operate, one([this](const Station& station, const Json& parameters, const Caller& caller) {
              return parts_.accesses.survey(station, parameters, caller);
          })}},
        {"WriteTag",
         {Right::write, one([this](const Station& station, const Json& parameters, const Caller& caller) {
              return parts_.accesses.write(station, parameters, caller);
          })}},
        {"SetTec",
         {Right::write, one([this](const Station& station, const Json& parameters, const Caller& caller) {
              return set_tec(station, parameters, caller);
          })}},
        {"Trace",
         {Right::operate, [this](const Json& parameters,
                                 const Caller& caller) { return parts_.traces.add(parameters, caller); }}},
        {"ListIncidents",
         {Right::operate, [this](const Json&, const Caller&) { return parts_.incidents.list(); }}},
        {"GetIncident",
         {Right::operate,
          [this](const Json& parameters, const Caller& caller) {
              return parts_.incidents.piece(parameters, caller);
          }}},
        {"Reload",
         {Right::operate,
          [this](const Json& parameters, const Caller& caller) {
              return parts_.reload.request(parameters.value("dry_run", false), caller);
          }}},
    };
}

report::GetStatusReply ControlMethods::status() const
{
    const Instant now = io::monotonic_now();
    const View& view = parts_.monitor.view();
    return {bus_report(view, now), stations_report(view, now),
            std::chrono::duration_cast<std::chrono::milliseconds>(now - started_).count(), ::getpid(),
            log(now)};
}

report::Log ControlMethods::log(Instant now) const
{
    const auto ends = parts_.log_level.ends();
    if (!ends) return {"info", std::nullopt};
    return {"debug", std::chrono::duration<double, std::milli>(*ends - now).count()};
}

Reply ControlMethods::set_log_level(const Json& parameters, const Caller& caller)
{
    const auto level = parameters["level"].get<std::string>();
    const std::int64_t seconds = parameters.value("seconds", kUsualDebug_s);
    const auto refused = [&level](const char* reason) {
        return Error{"BadLogLevel", {{"level", level}, {"reason", reason}}};
    };
    const bool is_debug = level == "debug";
    if (!is_debug && level != "info") return refused("it is debug or info");
    if (is_debug && (seconds < 1 || seconds > kLongestDebug_s)) return refused("for 1 s to 24 h");
    const Instant now = io::monotonic_now();
    if (is_debug)
        parts_.log_level.set_debug(now + std::chrono::seconds{seconds});
    else
        parts_.log_level.set_info();
    spdlog::default_logger()->set_level(is_debug ? spdlog::level::debug : spdlog::level::info);
    std::string text =
        fmt::format("level of the log set to {}{} by {}", level,
                    is_debug ? fmt::format(" for {} s", seconds) : std::string{}, words_of(caller));
    parts_.happenings.tell({.kind = Happened::setting, .text = std::move(text)}, now);
    return Done{json_of(report::SetLogLevelReply{log(now)})};
}

report::Info ControlMethods::info(const Station& station) const
{
    auto pending = parts_.file.address_of(station.config->name);
    if (pending == station.address) pending.reset();
    return info_report(station, pending, station.device->notes());
}

report::StationLeds ControlMethods::leds(const Station& station) const
{
    const auto index = static_cast<std::size_t>(&station - parts_.monitor.view().stations.data());
    report::StationLeds result =
        leds_report(*station.config, parts_.lamps.condition(index), io::monotonic_now());
    for (report::Led& led : result.leds) {
        led.trouble = parts_.lamps.trouble(index, led.name, io::monotonic_now());
        led.lit = led.lit && !led.trouble;
    }
    return result;
}

Reply ControlMethods::watch(const Json& parameters, const Caller& caller)
{
    const auto choice = parts_.monitor.choose(parameters, false);
    if (choice.error) return *choice.error;
    return parts_.watchers.add(parameters.contains("station") ? choice.station : nullptr, caller);
}

Reply ControlMethods::tec(const Json& parameters) const
{
    const View& view = parts_.monitor.view();
    const auto choice = parts_.monitor.choose(parameters, false);
    if (choice.error) return *choice.error;
    if (parameters.contains("station") && choice.station->device->tec() == nullptr)
        return Error{"NoTecOption", {{"station", choice.station->config->name}}};
    report::GetTecReply result;
    for (const Station& station : view.stations)
        if ((choice.station == nullptr || choice.station == &station) && station.device->tec() != nullptr)
            result.stations.push_back(tec_report(station.config->name, *station.device));
    return Done{json_of(result)};
}

Reply ControlMethods::set_tec(const Station& station, const Json& parameters, const Caller& caller)
{
    const std::string& name = station.config->name;
    TecOption* const tec = station.device->tec();
    if (tec == nullptr) return Error{"NoTecOption", {{"station", name}}};

    const auto parameter = parameters["parameter"].get<std::string>();
    const auto value = parameters["value"].get<std::string>();
    const auto refused = [&](const std::string& reason) {
        return Error{"BadTecValue", {{"parameter", parameter}, {"value", value}, {"reason", reason}}};
    };
    // Two stations at one address would answer at the same time.
    if (const auto address = tec->address_after(parameter, value))
        for (const Station& other : parts_.monitor.view().stations)
            if (&other != &station && other.address == *address)
                return refused(fmt::format("address {} is that of station {}: choose another", *address,
                                           other.config->name));
    const bool exchanges = station.bus.state == dp::State::data_exch;
    if (const auto fault = tec->fault_after(parameter, value);
        exchanges && !parameters.value("yes", false) && fault && *fault != OptionFault::none)
        return Error{"WouldSilence",
                     {{"station", name},
                      {"parameter", parameter},
                      {"value", value},
                      {"reason", fmt::format("FAULT would be {}", dpslave::text(*fault))}}};
    const std::string before = input_value(*tec, parameter);
    if (const auto reason = tec->set(parameter, value)) return refused(*reason);
    std::string text = fmt::format("{}: {} set to {} by {}, before {}", name, parameter,
                                   input_value(*tec, parameter), words_of(caller), before);
    parts_.happenings.tell({.kind = Happened::setting, .text = std::move(text), .stations = {name}},
                           io::monotonic_now());
    parts_.monitor.update_device(station);
    return Done{json_of(report::SetTecReply{{tec_report(name, *station.device)}})};
}

} // namespace dpslave::app
