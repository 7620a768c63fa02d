// SPDX-License-Identifier: Apache-2.0
// The methods of org.dpslaved.Control by which dpctl makes a tag table of a drive.
#include "main_thread.hpp"

#include "dpslave/profile/survey.hpp"

#include <algorithm>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

namespace {

/// The first register of the IEEE area, which has each number once more.
constexpr std::uint32_t kIeeeArea = 0x8000;

bool is_modbus(const View& view, const config::StationConfig& station)
{
    return view.config->lines[station.line].protocol == config::kModbusRtu;
}

std::optional<std::array<char, 2>> mnemonic_of_tag(const config::StationConfig& station, std::uint16_t tag)
{
    const drive::Tag* row = station.tags->find(tag);
    return row != nullptr ? drive::mnemonic_of(*row, station.profile->mnemonics)
                          : drive::mnemonic_by_rule(tag, station.profile->mnemonics);
}

Json mnemonic_json(const config::StationConfig& station, std::uint16_t tag)
{
    const auto mnemonic = mnemonic_of_tag(station, tag);
    return mnemonic ? Json(std::string(mnemonic->begin(), mnemonic->end())) : Json(nullptr);
}

} // namespace

Reply MainThread::on_survey_scope(const Json& parameters)
{
    const Choice choice = choose(parameters, true);
    if (choice.error) return *choice.error;
    const config::StationConfig& station = config_of(*choice.station);
    const bool modbus = is_modbus(view_, station);
    std::vector<profile::TagSpan> spans;
    for (std::uint32_t number = 0; number <= 0xFFFF; ++number) {
        const auto tag = static_cast<std::uint16_t>(number);
        if (modbus ? number >= kIeeeArea : !mnemonic_of_tag(station, tag)) continue;
        if (!spans.empty() && spans.back().last + 1 == tag)
            spans.back().last = tag;
        else
            spans.push_back({tag, tag});
    }
    Json tags = Json::array();
    for (const profile::TagSpan span : spans) tags.push_back({{"first", span.first}, {"last", span.last}});
    return Done{{{"station", station.name},
                 {"protocol", view_.config->lines[station.line].protocol},
                 {"tag_table", station.tag_file},
                 {"tags", std::move(tags)}}};
}

Reply MainThread::on_survey(const Json& parameters, const control::Caller& who)
{
    const Choice choice = choose(parameters, true);
    if (choice.error) return *choice.error;
    const auto number = parameters["tag"].get<std::int64_t>();
    if (number < 0 || number > 0xFFFF)
        return Error{"BadValue",
                     {{"tag", number}, {"value", ""}, {"reason", "a tag is a number from 0 to 65535"}}};
    const Post& post = posts_[*choice.station];
    const bool another = std::any_of(asked_.begin(), asked_.end(), [&](const auto& one) {
        return one.second.is_survey && one.second.station == post.station.number;
    });
    const auto tag = static_cast<std::uint16_t>(number);
    const drive::OperateOrder order{
        .number = next_order_, .unit = 0, .is_write = false, .tag = tag, .word = 0};
    if (another || !has_place_for(who) ||
        !post.station.line->link.orders.push({post.station.number, order, true}))
        return Error{"Busy", Json::object()};
    asked_[order.number] = {.station = post.station.number,
                            .config = post.station.config,
                            .tag = tag,
                            .word = 0,
                            .is_write = false,
                            .is_survey = true,
                            .has_text = !is_modbus(view_, config_of(*choice.station)),
                            .who = who,
                            .before = {}};
    return control::Later{.token = next_order_++};
}

/// A silence of a drive that is lost anyway says nothing of the tag.
Reply MainThread::survey_answer_of(const Asked& asked, const drive::OperateAnswer& answer) const
{
    const config::StationConfig& station = *asked.config;
    Json reply = {{"station", station.name},
                  {"tag", asked.tag},
                  {"mnemonic", asked.has_text ? mnemonic_json(station, asked.tag) : Json(nullptr)},
                  {"text", nullptr},
                  {"raw", nullptr},
                  {"reason", nullptr}};
    const auto post = std::find_if(posts_.begin(), posts_.end(),
                                   [&](const Post& one) { return one.station.number == asked.station; });
    const bool answers =
        post != posts_.end() && view_.stations[static_cast<std::size_t>(post - posts_.begin())].drive.answers;
    const std::string said{answer.said.data()};
    switch (answer.error) {
        case AccessError::none:
            reply["outcome"] = "value";
            (asked.has_text ? reply["text"] = said : reply["raw"] = answer.word);
            break;
        case AccessError::no_answer:
        case AccessError::deferred:
        case AccessError::not_understood: reply["outcome"] = answers ? "silence" : "lost"; break;
        default:
            reply["outcome"] = "denied";
            reply["reason"] = answer.error == AccessError::invalid_tag || said.empty()
                                  ? std::string{text(answer.error)}
                                  : said;
    }
    return Done{std::move(reply)};
}

} // namespace dpslave::app
