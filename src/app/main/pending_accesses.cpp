// SPDX-License-Identifier: Apache-2.0
#include "pending_accesses.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/profile/survey.hpp"
#include "dpslave/report/words.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

namespace {

constexpr std::size_t kMaxPending = 16;         // what the rings of a line can hold
constexpr std::size_t kMaxPendingOfOthers = 12; // of all callers that are no operators
constexpr std::size_t kMaxPendingOfOne = 4;     // of one user id that is not root

/// The first register of the IEEE area, which has each number once more.
constexpr std::uint32_t kIeeeArea = 0x8000;

/// The parameter `tag`.
Result<std::uint16_t, Error> tag_of(const Json& parameters)
{
    const auto number = parameters["tag"].get<std::int64_t>();
    if (number < 0 || number > 0xFFFF)
        return Failure{Error{
            "BadValue", {{"tag", number}, {"value", ""}, {"reason", "a tag is a number from 0 to 65535"}}}};
    return static_cast<std::uint16_t>(number);
}

/// `value`, as it is displayed, as the word of this tag: within the limits of its row, and within those of
/// [station.write_limits], which are never wider.
Result<std::uint16_t, Error> word_to_write(const config::StationConfig& station, std::uint16_t tag,
                                           const std::string& value)
{
    const auto refused = [&](std::string reason) {
        return Failure{Error{"BadValue", {{"tag", tag}, {"value", value}, {"reason", std::move(reason)}}}};
    };
    const drive::Tag* row = station.tags->find(tag);
    if (row == nullptr) return refused("its type and decimals are not known; " + row_advice(station, tag));
    drive::Tag limited = *row;
    const auto limits = station.write_limits.find(tag);
    if (limits != station.write_limits.end()) {
        limited.min = limits->second.min;
        limited.max = limits->second.max;
    }
    const drive::ParsedValue parsed = drive::parse_value(limited, value);
    if (parsed.error != AccessError::none)
        return refused(bad_value_words(limited, parsed.error) +
                       (limits != station.write_limits.end() ? ", as [station.write_limits] says" : ""));
    return parsed.word;
}

/// As the drive line saw it last, of a tag that the master has chosen or that is read for the diagnosis.
std::optional<std::string> known_value(const Station& station, std::uint16_t tag)
{
    if (!station.drive.answers) return std::nullopt;
    const auto shown = [&](std::uint16_t word) { return shown_value(*station.config->tags, tag, word); };
    const Layout& layout = station.bus.layout;
    if (station.drive.generation == layout.generation)
        for (std::size_t k = 0; k < layout.count; ++k)
            if (layout.parameters[k].tag == tag && station.drive.updated_at[k] != Instant{})
                return shown(station.drive.words[k]);
    for (const drive::Watched& one : station.drive.watched)
        if (one.tag == tag && one.state == WordState::good) return shown(one.word);
    return std::nullopt;
}

/// The master whose cyclic outputs have this tag; nothing: no master writes it.
std::optional<std::uint8_t> master_that_writes(const Station* station, std::uint16_t tag)
{
    if (station == nullptr || station->bus.state != dp::State::data_exch) return std::nullopt;
    const Layout& layout = station->bus.layout;
    for (std::size_t i = 0; i < layout.count; ++i)
        if (layout.parameters[i].tag == tag && layout.parameters[i].writes) return station->bus.master;
    return std::nullopt;
}

bool is_modbus(const Station& station)
{
    return station.line->protocol == config::kModbusRtu;
}

std::optional<std::array<char, 2>> mnemonic_of_tag(const config::StationConfig& station, std::uint16_t tag)
{
    const drive::Tag* row = station.tags->find(tag);
    return row != nullptr ? drive::mnemonic_of(*row, station.profile->mnemonics)
                          : drive::mnemonic_by_rule(tag, station.profile->mnemonics);
}

} // namespace

/// Few accesses can wait for a drive: no user may take all places.
bool PendingAccesses::has_place_for(const control::Caller& caller) const
{
    const auto count = [this](auto holds) {
        return static_cast<std::size_t>(std::count_if(
            pending_.begin(), pending_.end(), [&](const auto& one) { return holds(one.second.caller); }));
    };
    const std::size_t own = count([&](const control::Caller& one) { return one.uid == caller.uid; });
    const std::size_t others = count([](const control::Caller& one) { return !one.operates; });
    if (caller.uid != 0 && own >= kMaxPendingOfOne) return false;
    return pending_.size() < kMaxPending && (caller.operates || others < kMaxPendingOfOthers);
}

Reply PendingAccesses::order(const Station& station, Access access)
{
    const drive::OperateOrder order{.number = replies_.next_token,
                                    .unit = 0, // found by the drive thread
                                    .is_write = access.is_write,
                                    .tag = access.tag,
                                    .word = access.word};
    if (!has_place_for(access.caller) ||
        !station.drive_line->link.orders.push({station.number, order, access.is_survey}))
        return Error{"Busy", Json::object()};
    access.station = station.number;
    access.config = station.config;
    pending_[order.number] = std::move(access);
    return control::Later{.token = replies_.next_token++};
}

Reply PendingAccesses::read(const Station& station, const Json& parameters, const control::Caller& caller)
{
    const auto tag = tag_of(parameters);
    if (!tag) return tag.error();
    Access access;
    access.tag = *tag;
    access.caller = caller;
    return order(station, std::move(access));
}

Reply PendingAccesses::write(const Station& station, const Json& parameters, const control::Caller& caller)
{
    if (monitor_.config().control.read_only) return Error{"ReadOnly", Json::object()};
    const auto tag = tag_of(parameters);
    if (!tag) return tag.error();
    const auto word = word_to_write(*station.config, *tag, parameters["value"].get<std::string>());
    if (!word) return word.error();
    Access access;
    access.tag = *tag;
    access.word = *word;
    access.is_write = true;
    access.caller = caller;
    access.before = known_value(station, *tag);
    return order(station, std::move(access));
}

Reply PendingAccesses::survey(const Station& station, const Json& parameters, const control::Caller& caller)
{
    const auto tag = tag_of(parameters);
    if (!tag) return tag.error();
    const bool another = std::any_of(pending_.begin(), pending_.end(), [&](const auto& one) {
        return one.second.is_survey && one.second.station == station.number;
    });
    if (another) return Error{"Busy", Json::object()};
    Access access;
    access.tag = *tag;
    access.is_survey = true;
    access.has_text = !is_modbus(station);
    access.caller = caller;
    return order(station, std::move(access));
}

Reply PendingAccesses::survey_scope(const Station& station) const
{
    const bool modbus = is_modbus(station);
    report::GetSurveyScopeReply result{station.config->name, station.line->protocol,
                                       station.config->tag_file};
    for (std::uint32_t number = 0; number <= 0xFFFF; ++number) {
        const auto tag = static_cast<std::uint16_t>(number);
        if (modbus ? number >= kIeeeArea : !mnemonic_of_tag(*station.config, tag)) continue;
        if (!result.tags.empty() && result.tags.back().last + 1 == tag)
            result.tags.back().last = tag;
        else
            result.tags.push_back({tag, tag});
    }
    return Done{json_of(result)};
}

/// One line for each write: caller, value and outcome.
void PendingAccesses::log_write(const Access& access, std::string_view outcome) const
{
    const config::StationConfig& station = *access.config;
    const drive::Tag* row = station.tags->find(access.tag);
    const std::string text =
        fmt::format("{}: tag {}{}{} set to {} by {}, before {}: {}", station.name, access.tag,
                    row != nullptr && !row->name.empty() ? " " : "", row != nullptr ? row->name : "",
                    shown_value(*station.tags, access.tag, access.word), words_of(access.caller),
                    access.before.value_or("not known"), outcome);
    spdlog::info("{}", text);
    events_.add(Happened::write, station.name, text, io::monotonic_now());
}

void PendingAccesses::log_unanswered() const
{
    for (const auto& [number, access] : pending_)
        if (access.is_write) log_write(access, "the program ended before the drive answered");
}

Reply PendingAccesses::reply(const Access& access, const drive::OperateAnswer& answer) const
{
    const config::StationConfig& station = *access.config;
    const drive::Tag* row = station.tags->find(access.tag);
    if (answer.error != AccessError::none) {
        const auto code = dp::demand_code(answer.error);
        std::string reason{report::text(answer.error)};
        const bool may_be_row =
            row == nullptr ? answer.error != AccessError::no_answer : answer.error == AccessError::no_scale;
        if (may_be_row) reason += "; " + row_advice(station, access.tag);
        return Error{"DriveRefused",
                     {{"tag", access.tag},
                      {"reason", std::move(reason)},
                      {"code", code ? Json(*code) : Json(nullptr)}}};
    }
    const std::uint16_t word = access.is_write ? access.word : answer.word;
    const auto name = row != nullptr ? std::optional{row->name} : std::nullopt;
    std::string value = shown_value(*station.tags, access.tag, word);
    if (!access.is_write)
        return Done{json_of(report::ReadTagReply{station.name, access.tag, name, word, std::move(value)})};
    return Done{
        json_of(report::WriteTagReply{station.name, access.tag, name, word, std::move(value),
                                      master_that_writes(monitor_.find(access.station), access.tag)})};
}

/// The silence of a drive that is lost anyway proves nothing about the tag.
Reply PendingAccesses::survey_reply(const Access& access, const drive::OperateAnswer& answer) const
{
    const config::StationConfig& station = *access.config;
    report::SurveyReply result{station.name, access.tag};
    if (const auto mnemonic = mnemonic_of_tag(station, access.tag); mnemonic && access.has_text)
        result.mnemonic.emplace(mnemonic->begin(), mnemonic->end());
    const Station* const present = monitor_.find(access.station);
    const std::string text_of_drive{answer.said.data()};
    switch (answer.error) {
        case AccessError::none:
            result.outcome = "value";
            if (access.has_text)
                result.text = text_of_drive;
            else
                result.raw = answer.word;
            break;
        case AccessError::no_answer:
        case AccessError::deferred:
        case AccessError::not_understood:
            result.outcome = present != nullptr && present->drive.answers ? "silence" : "lost";
            break;
        default:
            result.outcome = "denied";
            result.reason = answer.error == AccessError::invalid_tag || text_of_drive.empty()
                                ? std::string{report::text(answer.error)}
                                : text_of_drive;
    }
    return Done{json_of(result)};
}

void PendingAccesses::answer()
{
    for (const auto& line : runtime_.lines()) {
        while (const auto answer = line->link.answers.pop()) {
            const auto found = pending_.find(answer->number);
            if (found == pending_.end()) continue;
            const Access& access = found->second;
            if (access.is_write)
                log_write(access, answer->error == AccessError::none ? "done" : report::text(answer->error));
            replies_.server->complete(answer->number, access.is_survey ? survey_reply(access, *answer)
                                                                       : reply(access, *answer));
            pending_.erase(found);
        }
    }
}

void PendingAccesses::refuse(const std::vector<Station>& left)
{
    for (const Station& station : left) {
        for (auto one = pending_.begin(); one != pending_.end();) {
            const auto& [token, access] = *one;
            if (access.station != station.number) {
                ++one;
                continue;
            }
            if (access.is_write) log_write(access, "the station was changed or removed by a reload");
            replies_.server->complete(
                token,
                Error{"DriveRefused",
                      {{"tag", access.tag},
                       {"reason", fmt::format("station {} has just been changed or removed by a reload",
                                              station.config->name)},
                       {"code", nullptr}}});
            one = pending_.erase(one);
        }
    }
}

} // namespace dpslave::app
