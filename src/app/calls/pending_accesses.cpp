// SPDX-License-Identifier: Apache-2.0
#include "pending_accesses.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/profile/survey.hpp"
#include "dpslave/report/words.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

namespace {

constexpr std::size_t kMaxPending = 16;         // what the rings of a line can hold
constexpr std::size_t kMaxPendingOfOthers = 12; // of all callers that are no operators
constexpr std::size_t kMaxPendingOfOne = 4;     // of one user id that is not root

/// Longer than a search for a drive, for which the line does nothing else.
constexpr std::chrono::minutes kLongestWait{5};

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

std::optional<std::array<char, 2>> mnemonic_of_tag(const config::StationConfig& station, std::uint16_t tag,
                                                   std::optional<drive::MnemonicRule> rule)
{
    const drive::Tag* row = station.tags->find(tag);
    const drive::MnemonicRule by = rule.value_or(station.profile->mnemonics);
    return row != nullptr ? drive::mnemonic_of(*row, by) : drive::mnemonic_by_rule(tag, by);
}

/// The parameter `rule`; nothing: that of the profile.
Result<std::optional<drive::MnemonicRule>, Error> rule_of(const Json& parameters)
{
    const auto given = parameters.find("rule");
    if (given == parameters.end() || given->is_null()) return std::optional<drive::MnemonicRule>{};
    const auto rule = drive::mnemonic_rule_of(given->get<std::string>());
    if (rule) return std::optional{*rule};
    return Failure{Error{"BadValue",
                         {{"tag", parameters.value("tag", 0)},
                          {"value", *given},
                          {"reason", "a rule is 590plus, ac, pno or none"}}}};
}

/// What is known of an order that is ended without its answer.
std::string_view outcome_of(OrderStates::End end)
{
    return end == OrderStates::End::begun ? "not known whether it was done" : "it was not carried out";
}

} // namespace

/// Few accesses can wait for a drive: no user may take all places.
bool PendingAccesses::has_place_for(const control::Caller& caller) const
{
    const std::size_t own =
        waiting_.count([&](const Waiting::Call& one) { return one.what.caller.uid == caller.uid; });
    const std::size_t others =
        waiting_.count([](const Waiting::Call& one) { return !one.what.caller.operates; });
    if (caller.uid != 0 && own >= kMaxPendingOfOne) return false;
    return waiting_.size() < kMaxPending && (caller.operates || others < kMaxPendingOfOthers);
}

Reply PendingAccesses::order(const Station& station, Access access)
{
    if (station.line_stalled.count() != 0)
        return Error{"DriveRefused",
                     {{"tag", access.tag},
                      {"reason", stall_words(*station.drive_line, station.line_stalled)},
                      {"code", nullptr}}};
    const drive::OperateOrder order{.number = waiting_.next_number(),
                                    .unit = 0, // found by the drive thread
                                    .is_write = access.is_write,
                                    .tag = access.tag,
                                    .word = access.word};
    LineLink& link = station.drive_line->link;
    if (!has_place_for(access.caller) || !link.order_states.add(order.number))
        return Error{"Busy", Json::object()};
    if (!link.orders.push({station.number, order, access.is_survey, access.rule})) {
        link.order_states.take_back(order.number);
        return Error{"Busy", Json::object()};
    }
    access.config = station.config;
    access.line = station.drive_line;
    const control::ReplyTo to = access.caller.reply_to;
    waiting_.add({.to = to,
                  .station = station.number,
                  .due = io::monotonic_now() + kLongestWait,
                  .what = std::move(access)});
    return control::Later{};
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
    const auto is_another = [&](const Waiting::Call& one) {
        return one.what.is_survey && one.station == station.number;
    };
    if (waiting_.count(is_another) != 0) return Error{"Busy", Json::object()};
    const auto rule = rule_of(parameters);
    if (!rule) return rule.error();
    Access access;
    access.tag = *tag;
    access.is_survey = true;
    access.has_text = !is_modbus(station);
    if (access.has_text) access.rule = *rule;
    if (access.rule && !mnemonic_of_tag(*station.config, *tag, access.rule)) {
        report::SurveyReply unnamed{station.config->name, *tag};
        unnamed.outcome = "denied";
        unnamed.reason = "the rule gives it no mnemonic";
        return Done{json_of(unnamed)};
    }
    access.caller = caller;
    return order(station, std::move(access));
}

Reply PendingAccesses::survey_scope(const Station& station, const Json& parameters) const
{
    const auto rule = rule_of(parameters);
    if (!rule) return rule.error();
    const bool modbus = is_modbus(station);
    report::GetSurveyScopeReply result{station.config->name, station.line->protocol,
                                       station.config->tag_file};
    for (std::uint32_t number = 0; number <= 0xFFFF; ++number) {
        const auto tag = static_cast<std::uint16_t>(number);
        if (modbus ? number >= kIeeeArea : !mnemonic_of_tag(*station.config, tag, *rule)) continue;
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
    std::string text =
        fmt::format("{}: tag {}{}{} set to {} by {}, before {}: {}", station.name, access.tag,
                    row != nullptr && !row->name.empty() ? " " : "", row != nullptr ? row->name : "",
                    shown_value(*station.tags, access.tag, access.word), words_of(access.caller),
                    access.before.value_or("not known"), outcome);
    happenings_.tell({.kind = Happened::write, .text = std::move(text), .stations = {station.name}},
                     io::monotonic_now());
}

void PendingAccesses::end()
{
    take_answers();
    waiting_.each([this](std::uint32_t number, const Waiting::Call& call) {
        const OrderStates::End end = call.what.line->link.order_states.end(number);
        if (call.what.is_write)
            log_write(call.what,
                      fmt::format("the program ended before the drive answered: {}", outcome_of(end)));
    });
}

control::LastReply PendingAccesses::reply(const Waiting::Call& call, const drive::OperateAnswer& answer) const
{
    const Access& access = call.what;
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
    return Done{json_of(report::WriteTagReply{station.name, access.tag, name, word, std::move(value),
                                              master_that_writes(monitor_.find(call.station), access.tag)})};
}

/// The silence of a drive that is lost anyway proves nothing about the tag.
control::LastReply PendingAccesses::survey_reply(const Waiting::Call& call,
                                                 const drive::OperateAnswer& answer) const
{
    const Access& access = call.what;
    const config::StationConfig& station = *access.config;
    report::SurveyReply result{station.name, access.tag};
    if (const auto mnemonic = mnemonic_of_tag(station, access.tag, access.rule); mnemonic && access.has_text)
        result.mnemonic.emplace(mnemonic->begin(), mnemonic->end());
    const Station* const present = monitor_.find(call.station);
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

void PendingAccesses::answer(Instant now)
{
    take_answers();
    end_of_stalled_lines();
    end_of_callers_gone();
    waiting_.end_late(now, [this](std::uint32_t number, const Waiting::Call& call) {
        return refuse(number, call,
                      fmt::format("{} within {} minutes", report::kLineDidNotServe, kLongestWait.count()));
    });
}

/// Also those of lines that have left by a reload.
void PendingAccesses::take_answers()
{
    std::set<std::shared_ptr<DriveLine>> lines{lines_.begin(), lines_.end()};
    waiting_.each([&](std::uint32_t, const Waiting::Call& call) { lines.insert(call.what.line); });
    for (const auto& line : lines) {
        while (const auto answer = line->link.answers.pop()) {
            const auto call = waiting_.take(answer->number);
            if (!call) continue;
            if (call->what.is_write)
                log_write(call->what,
                          answer->error == AccessError::none ? "done" : report::text(answer->error));
            call->to.end(call->what.is_survey ? survey_reply(*call, *answer) : reply(*call, *answer));
        }
    }
}

void PendingAccesses::end_of_stalled_lines()
{
    for (const Station& station : monitor_.view().stations)
        if (station.line_stalled.count() != 0) end_of(*station.drive_line);
}

/// Its orders are answered here, and it carries none of them out later. It writes nothing from give_up() on,
/// until it has seen that they have ended.
void PendingAccesses::end_of(DriveLine& line)
{
    const auto is_of_line = [&](const Waiting::Call& call) { return call.what.line.get() == &line; };
    if (waiting_.count(is_of_line) == 0) return;
    const std::string stall = stall_words(line, line.silent_for);
    waiting_.end_where(is_of_line, [&](std::uint32_t number, const Waiting::Call& call) {
        return refuse(number, call, stall);
    });
    line.link.sign->give_up();
}

/// Nobody expects it any more. What has begun goes on: the log says what has become of it.
void PendingAccesses::end_of_callers_gone()
{
    const auto has_gone = [](const Waiting::Call& call) { return !call.to.is_open(); };
    waiting_.end_where(has_gone, [this](std::uint32_t number, const Waiting::Call& call) {
        if (!call.what.line->link.order_states.end_unless_begun(number)) return false;
        if (call.what.is_write)
            log_write(call.what, "its caller has gone before its turn: it was not carried out");
        return true;
    });
}

/// False: it was not refused, for the line has just answered it.
bool PendingAccesses::refuse(std::uint32_t number, const Waiting::Call& call, const std::string& reason) const
{
    const OrderStates::End end = call.what.line->link.order_states.end(number);
    if (end == OrderStates::End::answered) return false;
    const std::string words = fmt::format("{}: {}", reason, outcome_of(end));
    if (call.what.is_write) log_write(call.what, words);
    call.to.end(Error{"DriveRefused", {{"tag", call.what.tag}, {"reason", words}, {"code", nullptr}}});
    return true;
}

void PendingAccesses::refuse(const std::vector<Station>& left)
{
    take_answers();
    waiting_.end_of(left, [this](std::uint32_t number, const Waiting::Call& call) {
        return refuse(
            number, call,
            fmt::format("station {} has just been changed or removed by a reload", call.what.config->name));
    });
}

} // namespace dpslave::app
