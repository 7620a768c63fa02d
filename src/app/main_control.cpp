// SPDX-License-Identifier: Apache-2.0
// The methods of org.dpslaved.Control.
#include "dpslave/app/main_thread.hpp"
#include "dpslave/app/version.hpp"
#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

control::Handlers MainThread::handlers()
{
    const auto each = [this](Json (MainThread::*one)(std::size_t)) {
        return [this, one](const Json& parameters, const control::Caller&) {
            return on_each_station(parameters, one);
        };
    };
    return {
        {"GetVersion",
         [](const Json&, const control::Caller&) -> Reply {
             return Done{
                 {{"program", "dpslaved"}, {"version", kVersion}, {"interface", control::kInterface}}};
         }},
        {"GetStatus", [this](const Json&, const control::Caller&) { return on_status(); }},
        {"ListStations",
         [this](const Json&, const control::Caller&) -> Reply {
             return Done{{{"stations", stations_json(view_)}}};
         }},
        {"GetInfo", [this](const Json& parameters, const control::Caller&) { return on_info(parameters); }},
        {"GetIo", each(&MainThread::io_of)},
        {"GetDiagnosis", each(&MainThread::diagnosis_of)},
        {"GetCounters",
         [this](const Json&, const control::Caller&) -> Reply { return Done{counters_json(view_)}; }},
        {"GetLeds", each(&MainThread::leds_of)},
        {"GetTec", [this](const Json& parameters, const control::Caller&) { return on_tec(parameters); }},
        {"Watch", [this](const Json& parameters, const control::Caller&) { return on_watch(parameters); }},
        {"ReadTag",
         [this](const Json& parameters, const control::Caller&) { return on_tag(parameters, false); }},
        {"WriteTag",
         [this](const Json& parameters, const control::Caller&) { return on_tag(parameters, true); }},
        {"SetTec", [this](const Json& parameters, const control::Caller&) { return on_set_tec(parameters); }},
        {"Reload", [this](const Json&, const control::Caller&) { return on_reload(); }},
    };
}

Reply MainThread::on_status()
{
    const Instant now = io::monotonic_now();
    return Done{{{"bus", bus_json(view_, now)},
                 {"stations", stations_json(view_)},
                 {"uptime_ms", std::chrono::duration_cast<std::chrono::milliseconds>(now - started_).count()},
                 {"pid", ::getpid()}}};
}

Reply MainThread::on_each_station(const Json& parameters, Json (MainThread::*one)(std::size_t))
{
    const Choice choice = choose(parameters, false);
    if (choice.error) return *choice.error;
    Json all = Json::array();
    for (std::size_t i = 0; i < view_.stations.size(); ++i)
        if (!choice.station || *choice.station == i) all.push_back((this->*one)(i));
    return Done{{{"stations", std::move(all)}}};
}

Reply MainThread::on_info(const Json& parameters)
{
    read_file_again();
    return on_each_station(parameters, &MainThread::info_of);
}

/// Only the file knows what a restart would bring. It is read when it has changed, and not for each
/// question.
void MainThread::read_file_again()
{
    std::error_code gone;
    const auto changed = std::filesystem::last_write_time(config_.file, gone);
    if (gone || changed == file_read_) return;
    file_read_ = changed;
    in_file_.clear();
    if (const auto config = load_config(config_.file, profiles_)) // a file that does not pass brings nothing
        for (const StationConfig& one : config->stations) in_file_[one.name] = one.address;
}

Json MainThread::info_of(std::size_t station)
{
    std::optional<std::uint8_t> pending;
    const auto found = in_file_.find(config_of(station).name);
    if (found != in_file_.end() && found->second != view_.stations[station].address) pending = found->second;
    return info_json(view_.stations[station], pending, posts_[station].device.notes());
}

Json MainThread::io_of(std::size_t station)
{
    return io_json(view_.stations[station], io::monotonic_now());
}

Json MainThread::diagnosis_of(std::size_t station)
{
    return diagnosis_json(view_.stations[station]);
}

Json MainThread::leds_of(std::size_t station)
{
    return leds_json(config_of(station), lamps_.condition(station), io::monotonic_now());
}

Json MainThread::known_stations() const
{
    Json names = Json::array();
    for (const Post& one : posts_) names.push_back(one.config->name);
    return names;
}

Error MainThread::no_such_station(const std::string& wanted) const
{
    return Error{"NoSuchStation", {{"station", wanted}, {"known", known_stations()}}};
}

std::optional<std::size_t> MainThread::index_of(const std::string& name) const
{
    for (std::size_t i = 0; i < posts_.size(); ++i)
        if (posts_[i].config->name == name) return i;
    return std::nullopt;
}

MainThread::Choice MainThread::choose(const Json& parameters, bool one_is_needed) const
{
    if (!parameters.contains("station")) {
        if (posts_.size() == 1) return {.station = 0, .error = {}};
        if (!one_is_needed) return {};
        return {.station = {}, .error = Error{"StationRequired", {{"known", known_stations()}}}};
    }
    const std::string wanted = parameters["station"].get<std::string>();
    for (std::size_t i = 0; i < posts_.size(); ++i)
        if (wanted == posts_[i].config->name || wanted == std::to_string(view_.stations[i].address))
            return {.station = i, .error = {}};
    return {.station = {}, .error = no_such_station(wanted)};
}

Json MainThread::watch_reply(std::optional<std::size_t> station, Instant now) const
{
    Json stations = Json::array();
    Json words = Json::array();
    for (std::size_t i = 0; i < view_.stations.size(); ++i) {
        if (station && *station != i) continue;
        stations.push_back(station_json(view_.stations[i]));
        words.push_back({{"name", config_of(i).name}, {"words", words_json(view_.stations[i], now)}});
    }
    return {{"bus", bus_json(view_, now)}, {"stations", std::move(stations)}, {"words", std::move(words)}};
}

/// What counts as a change for a watcher: states, links and values, but no age and no counter.
std::string MainThread::fingerprint(std::optional<std::size_t> station) const
{
    std::string all;
    for (std::size_t i = 0; i < view_.stations.size(); ++i) {
        if (station && *station != i) continue;
        const StationView& one = view_.stations[i];
        all += fmt::format("{}/{}/{}/{}/{}/{}:", one.address, static_cast<int>(one.bus.state), one.bus.master,
                           one.drive.known, one.drive.answers, one.line_open);
        for (std::size_t k = 0; k < one.bus.layout.count; ++k)
            all += fmt::format("{}.{}.{}.{};", one.bus.layout.parameters[k].tag, one.bus.inputs[k],
                               one.bus.outputs[k], static_cast<int>(one.drive.states[k]));
    }
    return all;
}

Reply MainThread::on_watch(const Json& parameters)
{
    const Choice choice = choose(parameters, false);
    if (choice.error) return *choice.error;
    const std::uint64_t number = next_stream_++;
    Watcher& watcher = watchers_[number];
    if (choice.station && parameters.contains("station")) watcher.station = config_of(*choice.station).name;
    watcher.seen = fingerprint(choice.station);
    return control::Stream{.stream = number, .first = watch_reply(choice.station, io::monotonic_now())};
}

void MainThread::push_watchers(Instant now)
{
    const auto open = server_->streams();
    std::erase_if(watchers_, [&open](const auto& one) {
        return !std::binary_search(open.begin(), open.end(), one.first);
    });
    for (auto& [number, watcher] : watchers_) {
        const auto station = watcher.station ? index_of(*watcher.station) : std::nullopt;
        if (watcher.station && !station) { // a reload has taken it away
            server_->end_stream(number, no_such_station(*watcher.station));
            continue;
        }
        std::string present = fingerprint(station);
        if (present == watcher.seen) continue;
        watcher.seen = std::move(present);
        server_->push(number, watch_reply(station, now));
    }
}

Reply MainThread::on_tag(const Json& parameters, bool is_write)
{
    const Choice choice = choose(parameters, true);
    if (choice.error) return *choice.error;
    const auto number = parameters["tag"].get<std::int64_t>();
    if (number < 0 || number > 0xFFFF)
        return Error{"BadValue",
                     {{"tag", number}, {"value", ""}, {"reason", "a tag is a number from 0 to 65535"}}};

    const Post& post = posts_[*choice.station];
    const StationConfig& station = *post.config;
    drive::OperateOrder order{.number = next_order_,
                              .unit = 0, // found by the drive thread
                              .is_write = is_write,
                              .tag = static_cast<std::uint16_t>(number),
                              .word = 0};
    if (is_write) {
        const auto value = parameters["value"].get<std::string>();
        const drive::Tag* row = station.tags->find(order.tag);
        if (row == nullptr)
            return Error{
                "BadValue",
                {{"tag", number},
                 {"value", value},
                 {"reason", fmt::format("tag {} is not in {}: without its type and decimals no value can be "
                                        "written; add a line for it",
                                        number, station.tag_file)}}};
        const drive::ParsedValue parsed = drive::parse_value(*row, value);
        if (parsed.error != AccessError::none)
            return Error{
                "BadValue",
                {{"tag", number}, {"value", value}, {"reason", bad_value_words(*row, parsed.error)}}};
        order.word = parsed.word;
    }
    if (asked_.size() >= kMaxAsked || !post.station.line->link.orders.push({post.station.number, order}))
        return Error{"Busy", Json::object()};
    asked_[order.number] = {.station = post.station.number,
                            .config = post.config,
                            .tag = order.tag,
                            .word = order.word,
                            .is_write = is_write};
    return control::Later{.token = next_order_++};
}

void MainThread::answer_asked()
{
    for (const auto& line : plant_.lines()) {
        while (const auto answer = line->link.answers.pop()) {
            const auto found = asked_.find(answer->number);
            if (found == asked_.end()) continue;
            const Asked& asked = found->second;
            const StationConfig& station = *asked.config;
            const drive::Tag* row = station.tags->find(asked.tag);
            if (answer->error != AccessError::none) {
                const auto code = dp::demand_code(answer->error);
                server_->complete(answer->number, Error{"DriveRefused",
                                                        {{"tag", asked.tag},
                                                         {"reason", text(answer->error)},
                                                         {"code", code ? Json(*code) : Json(nullptr)}}});
            } else {
                const std::uint16_t word = asked.is_write ? asked.word : answer->word;
                server_->complete(answer->number,
                                  Done{{{"station", station.name},
                                        {"tag", asked.tag},
                                        {"name", row != nullptr ? Json(row->name) : Json(nullptr)},
                                        {"raw", word},
                                        {"value", shown_value(*station.tags, asked.tag, word)}}});
            }
            asked_.erase(found);
        }
    }
}

} // namespace dpslave::app
