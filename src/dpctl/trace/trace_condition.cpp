// SPDX-License-Identifier: Apache-2.0
#include "trace_condition.hpp"

#include "dpslave/base/number.hpp"

#include <fmt/format.h>

#include <utility>

namespace dpslave::dpctl {
namespace {

using What = trace::Entry::What;

constexpr std::string_view kLegal =
    "Write one of these, or several with commas, which then must all hold: bad, unanswered, service=NAME, station=STATION, from=ADDRESS, to=ADDRESS";

std::optional<std::uint8_t> address_in(std::string_view text)
{
    constexpr std::int64_t kHighest = 127;
    const auto number = read_number(text, 0, kHighest);
    return number ? std::optional{static_cast<std::uint8_t>(*number)} : std::nullopt;
}

/// What is wrong with the word; nothing: it is in `into` now.
std::optional<std::string> read_word(std::string_view word, TraceCondition& into)
{
    const std::size_t equal = word.find('=');
    const std::string_view name = word.substr(0, equal);
    const bool has_value = equal != std::string_view::npos;
    const std::string_view value = has_value ? word.substr(equal + 1) : std::string_view{};
    if (name == "bad" && !has_value) {
        into.filter.bad = true;
    } else if (name == "unanswered" && !has_value) {
        into.unanswered = true;
    } else if (name == "service" && !value.empty()) {
        into.filter.service = value;
    } else if (name == "station" && !value.empty()) {
        into.station = value;
    } else if (name == "from" || name == "to") {
        const auto address = address_in(value);
        if (!address) return fmt::format("'{}' needs an address from 0 to 127. {}", word, kLegal);
        (name == "from" ? into.from : into.to) = address;
    } else {
        return fmt::format("'{}' is no condition. {}", word, kLegal);
    }
    return std::nullopt;
}

/// A telegram that a station has to answer.
bool asks_for_an_answer(const trace::Entry& entry)
{
    if (entry.what != What::telegram) return false;
    const auto telegram = telegram_of(entry);
    if (!telegram || !telegram->has_fc() || !telegram->is_request() || telegram->da == fdl::kBroadcast)
        return false;
    using fdl::Function;
    const Function function = telegram->function();
    return function != Function::sdn_low && function != Function::sdn_high &&
           function != Function::time_event;
}

} // namespace

Result<TraceCondition, std::string> read_condition(std::string_view text)
{
    TraceCondition condition;
    for (bool is_more = true; is_more;) {
        const std::size_t comma = text.find(',');
        if (auto wrong = read_word(text.substr(0, comma), condition)) return Failure{*std::move(wrong)};
        is_more = comma != std::string_view::npos;
        if (is_more) text.remove_prefix(comma + 1);
    }
    return condition;
}

bool StopCondition::is_met(const trace::Entry& entry, const TraceWords& words) const
{
    if (entry.what == What::lost || entry.what == What::rate) return false;
    if (condition_.from && words.from != condition_.from) return false;
    if (condition_.to && words.to != condition_.to) return false;
    return passes(condition_.filter, entry, words);
}

/// Whether `entry` shows that the open request gets no answer: one of our stations says so, or something else
/// follows.
bool StopCondition::is_left_open(const trace::Entry& entry, const TraceWords& words) const
{
    if (!open_) return false;
    if (entry.what == What::unanswered) return entry.address == open_->words.to;
    if (entry.what != What::telegram && entry.what != What::reply) return false;
    const bool is_short = !words.from && words.service == "SC";
    const bool is_answer = words.from == open_->words.to && words.to == open_->words.from;
    return !is_short && !is_answer;
}

bool StopCondition::holds(const trace::Entry& entry, const TraceWords& words)
{
    if (!condition_.unanswered) return is_met(entry, words);
    const bool is_own = entry.what == What::unanswered && !open_; // its request was not seen
    const bool holds =
        is_own ? is_met(entry, words) : is_left_open(entry, words) && is_met(open_->entry, open_->words);
    if (entry.what != What::piece) open_.reset();
    if (asks_for_an_answer(entry)) open_ = Request{entry, words};
    return holds;
}

} // namespace dpslave::dpctl
