// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/line_search.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::drive {

namespace {

/// A living drive can refuse II. Then these are asked (EI-ASCII reference, section 4): EE, V0, the PNO of the
/// health word of a 590, the value of an instrument.
constexpr std::array<std::array<char, 2>, 5> kPresence{
    {{'I', 'I'}, {'E', 'E'}, {'V', '0'}, {'0', 'F'}, {'P', 'V'}}};
constexpr std::size_t kIdentity = 0, kVersion = 2;

/// Registers of identity and version: of the 2000 series, then of a 650 or 650V.
struct Registers {
    std::uint16_t identity, version;
};
constexpr std::array<Registers, 2> kRegisters{{{122, 107}, {9901, 9902}}};

/// At most this number of questions follows the first answer of a unit: the rest of kPresence, the second
/// question, V0.
constexpr std::uint32_t kFollowing = 6;

bool is_series_2000(const std::string& identity)
{
    return identity.size() == 5 && identity.starts_with(">2") && (identity[2] == '2' || identity[2] == '4') &&
           std::string_view{"3468"}.find(identity[3]) != std::string_view::npos &&
           (identity[4] == '0' || identity[4] == '2');
}

bool is_650(const std::string& identity)
{
    return identity == ">0650" || identity == ">1650" || identity == ">2650";
}

/// Returns the sum of the timeout, the opening of the port, and the characters of question and answer.
std::chrono::nanoseconds longest_of(const LineSetting& setting, std::chrono::milliseconds timeout)
{
    constexpr std::int64_t kCharacters = 40, kBits = 11;
    constexpr std::chrono::milliseconds kOpening{50};
    return timeout + kOpening +
           std::chrono::nanoseconds{kCharacters * kBits * std::int64_t{1'000'000'000} / setting.baud};
}

} // namespace

std::string identity_words(const std::string& identity)
{
    if (identity == ">0650") return "650";
    if (identity == ">1650") return "650V, frames 1 to 3";
    if (identity == ">2650") return "650V, frames C to F";
    if (!is_series_2000(identity)) return {};
    constexpr std::array<std::pair<char, const char*>, 4> kSizes{
        {{'3', "1/32"}, {'4', "1/4"}, {'6', "1/16"}, {'8', "1/8"}}};
    std::string words = std::string{identity[2] == '2' ? "2200" : "2400"} + " series, ";
    for (const auto& [digit, size] : kSizes)
        if (digit == identity[3]) words += size;
    return words + " DIN, " + (identity[4] == '0' ? "PID or on/off" : "valve positioner");
}

LineSearch::LineSearch(std::vector<SearchTry> plan, RuleTrial trial, std::chrono::milliseconds timeout,
                       SearchLimits limits)
    : plan_(std::move(plan)), trial_(std::move(trial)), timeout_(timeout), limits_(limits)
{
    std::erase_if(plan_, [](const SearchTry& one) { return one.units.empty(); });
    measure();
}

void LineSearch::measure()
{
    std::chrono::nanoseconds time{}, rest_time{}, slowest{};
    std::size_t rest = 0, tags = 0;
    for (const SearchTry& one : plan_) {
        const std::chrono::nanoseconds each = longest_of(one.setting, timeout_);
        const auto count = [](const std::vector<UnitAddress>& units) {
            return static_cast<std::int64_t>(units.size());
        };
        most_ += static_cast<std::uint32_t>(one.units.size());
        time += each * count(one.units);
        rest = std::max(rest, one.rest.size());
        rest_time = std::max(rest_time, each * count(one.rest));
        slowest = std::max(slowest, each);
    }
    for (const LineProtocol protocol : {LineProtocol::ei_ascii, LineProtocol::modbus_rtu})
        if (std::any_of(plan_.begin(), plan_.end(),
                        [&](const SearchTry& one) { return one.setting.protocol == protocol; }))
            tags = std::max(tags, trial_.questions(protocol).size());
    const std::size_t behind = limits_.units * kFollowing + limits_.trials * tags;
    most_ += static_cast<std::uint32_t>(rest + behind);
    longest_ = std::chrono::ceil<std::chrono::seconds>(time + rest_time +
                                                       slowest * static_cast<std::int64_t>(behind));
}

bool LineSearch::is_modbus() const
{
    return now().setting.protocol == LineProtocol::modbus_rtu;
}

Look LineSearch::look() const
{
    if (step_ == Step::tags) return tag_questions_[choice_];
    if (is_modbus()) {
        const Registers& registers = kRegisters[choice_];
        return {.mnemonic = {}, .reg = step_ == Step::version ? registers.version : registers.identity};
    }
    return {.mnemonic = kPresence[step_ == Step::version ? kVersion : choice_], .reg = 0};
}

std::optional<SearchQuestion> LineSearch::next() const
{
    if (at_ == plan_.size()) return std::nullopt;
    return SearchQuestion{now().setting, now().units[unit_], look()};
}

void LineSearch::take(const Sight& sight)
{
    ++asked_;
    if (sight.kind == Sight::Kind::damaged) ++damaged_;
    switch (step_) {
        case Step::first: return take_first(sight);
        case Step::again: return take_again(sight);
        case Step::identity: return take_identity(sight);
        case Step::version: return take_version(sight);
        case Step::tags: break;
    }
    found_.back().sights[look()] = sight.kind;
    if (++choice_ == tag_questions_.size()) next_unit();
}

void LineSearch::take_first(const Sight& sight)
{
    const bool is_answer = sight.kind == Sight::Kind::value || sight.kind == Sight::Kind::denied;
    if (!is_answer) {
        if (choice_ > 0) ++unsure_;
        return next_unit();
    }
    if (choice_ == 0 && followed_++ == limits_.units) {
        is_full_ = true;
        return give_up();
    }
    if (sight.kind == Sight::Kind::value || is_modbus())
        step_ = Step::again;
    else if (++choice_ == kPresence.size()) {
        ++unsure_; // an EOT names nobody
        next_unit();
    }
}

void LineSearch::take_again(const Sight& sight)
{
    const bool is_value = sight.kind == Sight::Kind::value;
    if (!is_value && !(is_modbus() && sight.kind == Sight::Kind::denied)) {
        ++unsure_;
        return next_unit();
    }
    found_here_ = true;
    FoundUnit& unit = found_.emplace_back().unit;
    unit.setting = now().setting;
    unit.unit = now().units[unit_];
    const bool is_known =
        !is_modbus() || is_series_2000(sight.text); // else the register is not that of an identity
    if (choice_ == kIdentity && is_value && is_known) unit.identity = sight.text;
    if (!is_known) {
        choice_ = 1;
        step_ = Step::identity;
    } else if (!is_modbus() && choice_ == kVersion) {
        unit.version = sight.text;
        begin_tags();
    } else {
        step_ = Step::version;
    }
}

/// This is Modbus only: the second place of the identity. In another device that register holds no identity.
void LineSearch::take_identity(const Sight& sight)
{
    if (sight.kind != Sight::Kind::value || !is_650(sight.text)) return begin_tags();
    found_.back().unit.identity = sight.text;
    step_ = Step::version;
}

void LineSearch::take_version(const Sight& sight)
{
    if (sight.kind == Sight::Kind::value) found_.back().unit.version = sight.text;
    begin_tags();
}

void LineSearch::begin_tags()
{
    choice_ = 0;
    tag_questions_ = trial_.questions(now().setting.protocol);
    if (found_.size() > limits_.trials || tag_questions_.empty()) return next_unit();
    found_.back().unit.tags_asked = true;
    step_ = Step::tags;
}

void LineSearch::next_unit()
{
    step_ = Step::first;
    choice_ = 0;
    SearchTry& here = plan_[at_];
    if (++unit_ < here.units.size()) return;
    unit_ = 0;
    if (found_here_ && here.rest.empty()) return give_up(); // what answers at one rate answers at no other
    if (found_here_)
        here.units = std::exchange(here.rest, {});
    else
        ++at_;
}

void LineSearch::give_up()
{
    at_ = plan_.size();
}

std::vector<FoundUnit> LineSearch::found() const
{
    std::vector<FoundUnit> all;
    for (const Unit& one : found_) {
        all.push_back(one.unit);
        if (one.unit.tags_asked) all.back().rules = trial_.tally(one.unit.setting.protocol, one.sights);
    }
    return all;
}

} // namespace dpslave::drive
