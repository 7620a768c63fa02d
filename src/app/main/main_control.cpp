// SPDX-License-Identifier: Apache-2.0
// The methods of org.dpslaved.Control.
#include "main_thread.hpp"

#include "dpslave/app/version.hpp"
#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

namespace {

/// `value`, as a person writes it, as the word of this tag.
Result<std::uint16_t, Error> word_to_write(const config::StationConfig& station, std::uint16_t tag,
                                           const std::string& value)
{
    const auto refused = [&](std::string reason) {
        return Failure{Error{"BadValue", {{"tag", tag}, {"value", value}, {"reason", std::move(reason)}}}};
    };
    const drive::Tag* row = station.tags->find(tag);
    if (row == nullptr) return refused("its type and decimals are not known; " + row_advice(station, tag));
    const drive::ParsedValue parsed = drive::parse_value(*row, value);
    if (parsed.error != AccessError::none) return refused(bad_value_words(*row, parsed.error));
    return parsed.word;
}

} // namespace

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
             return Done{{{"stations", stations_json(view_, io::monotonic_now())}}};
         }},
        {"GetInfo", each(&MainThread::info_of)},
        {"GetIo", each(&MainThread::io_of)},
        {"GetDiagnosis", each(&MainThread::diagnosis_of)},
        {"GetCounters",
         [this](const Json&, const control::Caller&) -> Reply {
             return Done{counters_json(view_, io::monotonic_now())};
         }},
        {"GetLeds", each(&MainThread::leds_of)},
        {"GetTec", [this](const Json& parameters, const control::Caller&) { return on_tec(parameters); }},
        {"Watch", [this](const Json& parameters, const control::Caller&) { return on_watch(parameters); }},
        {"ProbeDrive",
         [this](const Json& parameters, const control::Caller& who) { return on_probe(parameters, who); }},
        {"ReadTag", [this](const Json& parameters,
                           const control::Caller& who) { return on_tag(parameters, who, false); }},
        {"GetSurveyScope",
         [this](const Json& parameters, const control::Caller&) { return on_survey_scope(parameters); }},
        {"Survey",
         [this](const Json& parameters, const control::Caller& who) { return on_survey(parameters, who); }},
        {"WriteTag", [this](const Json& parameters,
                            const control::Caller& who) { return on_tag(parameters, who, true); }},
        {"SetTec",
         [this](const Json& parameters, const control::Caller& who) { return on_set_tec(parameters, who); }},
        {"Reload", [this](const Json& parameters, const control::Caller&) { return on_reload(parameters); }},
    };
}

Reply MainThread::on_status()
{
    const Instant now = io::monotonic_now();
    return Done{{{"bus", bus_json(view_, now)},
                 {"stations", stations_json(view_, now)},
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

/// Only the file knows what a restart would bring. It is read when it has changed, on this thread's
/// own time: no question makes it read from a disk.
void MainThread::look_at_file(Instant now)
{
    if (now < next_look_) return;
    next_look_ = now + kFileTick;
    std::error_code gone;
    const auto changed = std::filesystem::last_write_time(config_.file, gone);
    if (gone || changed == file_read_) return;
    file_read_ = changed;
    const auto config = config::load_config(config_.file, profiles_);
    remember_file(config ? &*config : nullptr);
}

/// What the file says now. Nothing: it does not pass, and a restart would bring nothing.
void MainThread::remember_file(const config::Config* config)
{
    in_file_.clear();
    if (config == nullptr) return;
    for (const config::StationConfig& one : config->stations) in_file_[one.name] = one.address;
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
    for (const Post& one : posts_) names.push_back(one.station.config->name);
    return names;
}

Error MainThread::no_such_station(const std::string& wanted) const
{
    return Error{"NoSuchStation", {{"station", wanted}, {"known", known_stations()}}};
}

std::optional<std::size_t> MainThread::index_of(const std::string& name) const
{
    for (std::size_t i = 0; i < posts_.size(); ++i)
        if (posts_[i].station.config->name == name) return i;
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
        if (wanted == posts_[i].station.config->name || wanted == std::to_string(view_.stations[i].address))
            return {.station = i, .error = {}};
    return {.station = {}, .error = no_such_station(wanted)};
}

Json MainThread::watch_reply(std::optional<std::size_t> station, Instant now) const
{
    Json stations = Json::array();
    Json words = Json::array();
    for (std::size_t i = 0; i < view_.stations.size(); ++i) {
        if (station && *station != i) continue;
        stations.push_back(station_json(view_.stations[i], now));
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
        all += fmt::format("{}/{}/{}/{}/{}/{}/{}/{}:", one.address, static_cast<int>(one.bus.state),
                           one.bus.master, one.bus.clear, one.drive.known, one.drive.answers, one.line_open,
                           one.drive.ride_ends.has_value());
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
    struct Picture {
        std::string seen;
        Json reply;
    };
    std::map<std::optional<std::size_t>, Picture> pictures; // many watchers cost no more than a few
    for (auto& [number, watcher] : watchers_) {
        const auto station = watcher.station ? index_of(*watcher.station) : std::nullopt;
        if (watcher.station && !station) { // a reload has taken it away
            server_->end_stream(number, no_such_station(*watcher.station));
            continue;
        }
        Picture& picture = pictures[station];
        if (picture.seen.empty()) picture.seen = fingerprint(station);
        if (picture.seen == watcher.seen) continue;
        watcher.seen = picture.seen;
        if (picture.reply.is_null()) picture.reply = watch_reply(station, now);
        server_->push(number, picture.reply);
    }
}

/// Reads and writes that wait for a drive have few places: no user may take them all.
bool MainThread::has_place_for(const control::Caller& who) const
{
    const auto of = [this](auto holds) {
        return static_cast<std::size_t>(std::count_if(
            asked_.begin(), asked_.end(), [&](const auto& one) { return holds(one.second.who); }));
    };
    const std::size_t his = of([&](const control::Caller& one) { return one.uid == who.uid; });
    const std::size_t others = of([](const control::Caller& one) { return !one.operates; });
    if (who.uid != 0 && his >= kMaxAskedByOne) return false;
    return asked_.size() < kMaxAsked && (who.operates || others < kMaxAskedByOthers);
}

/// As the drive line saw it last, of a tag that the master has chosen.
std::optional<std::string> MainThread::known_value(std::size_t station, std::uint16_t tag) const
{
    const StationView& view = view_.stations[station];
    if (!view.drive.answers || view.drive.generation != view.bus.layout.generation) return std::nullopt;
    for (std::size_t k = 0; k < view.bus.layout.count; ++k)
        if (view.bus.layout.parameters[k].tag == tag && view.drive.updated_at[k] != Instant{})
            return shown_value(*view.config->tags, tag, view.drive.words[k]);
    return std::nullopt;
}

Reply MainThread::on_tag(const Json& parameters, const control::Caller& who, bool is_write)
{
    const Choice choice = choose(parameters, true);
    if (choice.error) return *choice.error;
    const auto number = parameters["tag"].get<std::int64_t>();
    if (number < 0 || number > 0xFFFF)
        return Error{"BadValue",
                     {{"tag", number}, {"value", ""}, {"reason", "a tag is a number from 0 to 65535"}}};

    const Post& post = posts_[*choice.station];
    drive::OperateOrder order{.number = next_order_,
                              .unit = 0, // found by the drive thread
                              .is_write = is_write,
                              .tag = static_cast<std::uint16_t>(number),
                              .word = 0};
    if (is_write) {
        const Result<std::uint16_t, Error> word =
            word_to_write(*post.station.config, order.tag, parameters["value"].get<std::string>());
        if (!word) return word.error();
        order.word = *word;
    }
    if (!has_place_for(who) || !post.station.line->link.orders.push({post.station.number, order}))
        return Error{"Busy", Json::object()};
    asked_[order.number] = {.station = post.station.number,
                            .config = post.station.config,
                            .tag = order.tag,
                            .word = order.word,
                            .is_write = is_write,
                            .who = who,
                            .before = known_value(*choice.station, order.tag)};
    return control::Later{.token = next_order_++};
}

/// One line for each write: who, what, and what came of it.
void MainThread::log_write(const Asked& asked, std::string_view outcome)
{
    const config::StationConfig& station = *asked.config;
    const drive::Tag* row = station.tags->find(asked.tag);
    spdlog::info("{}: tag {}{}{} set to {} by {}, before {}: {}", station.name, asked.tag,
                 row != nullptr && !row->name.empty() ? " " : "", row != nullptr ? row->name : "",
                 shown_value(*station.tags, asked.tag, asked.word), words_of(asked.who),
                 asked.before.value_or("not known"), outcome);
}

/// The end has come before the drives have answered.
void MainThread::log_unanswered() const
{
    for (const auto& [number, asked] : asked_)
        if (asked.is_write) log_write(asked, "the program ended before the drive answered");
}

/// What became of a read or a write.
Reply MainThread::answer_of(const Asked& asked, const drive::OperateAnswer& answer) const
{
    const config::StationConfig& station = *asked.config;
    const drive::Tag* row = station.tags->find(asked.tag);
    if (answer.error != AccessError::none) {
        const auto code = dp::demand_code(answer.error);
        std::string reason{text(answer.error)};
        const bool may_be_row =
            row == nullptr ? answer.error != AccessError::no_answer : answer.error == AccessError::no_scale;
        if (may_be_row) reason += "; " + row_advice(station, asked.tag);
        return Error{"DriveRefused",
                     {{"tag", asked.tag},
                      {"reason", std::move(reason)},
                      {"code", code ? Json(*code) : Json(nullptr)}}};
    }
    const std::uint16_t word = asked.is_write ? asked.word : answer.word;
    Json done = {{"station", station.name},
                 {"tag", asked.tag},
                 {"name", row != nullptr ? Json(row->name) : Json(nullptr)},
                 {"raw", word},
                 {"value", shown_value(*station.tags, asked.tag, word)}};
    if (asked.is_write) {
        const auto master = master_that_writes(asked.station, asked.tag);
        done["master"] = master ? Json(*master) : Json(nullptr);
    }
    return Done{std::move(done)};
}

/// The master whose cyclic outputs have this tag; nothing: no master writes it.
std::optional<std::uint8_t> MainThread::master_that_writes(std::uint32_t station, std::uint16_t tag) const
{
    for (const StationView& one : view_.stations) {
        if (one.number != station || one.bus.state != dp::State::data_exch) continue;
        for (std::size_t i = 0; i < one.bus.layout.count; ++i)
            if (one.bus.layout.parameters[i].tag == tag && one.bus.layout.parameters[i].writes)
                return one.bus.master;
    }
    return std::nullopt;
}

void MainThread::answer_asked()
{
    for (const auto& line : plant_.lines()) {
        while (const auto answer = line->link.answers.pop()) {
            const auto found = asked_.find(answer->number);
            if (found == asked_.end()) continue;
            const Asked& asked = found->second;
            if (asked.is_write)
                log_write(asked, answer->error == AccessError::none ? "done" : text(answer->error));
            server_->complete(answer->number,
                              asked.is_survey ? survey_answer_of(asked, *answer) : answer_of(asked, *answer));
            asked_.erase(found);
        }
    }
}

} // namespace dpslave::app
