// SPDX-License-Identifier: Apache-2.0
// Keeps what a survey saw of a tag, and says which tag is asked next, and how long it takes.
#include "dpslave/profile/survey.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

namespace dpslave::profile {
namespace {

constexpr std::uint32_t kAsksOfSilent = 3; ///< a silence may be the line
constexpr std::size_t kMaxDigits = 12;     ///< what is longer is no number of a drive

std::string_view without_blanks(std::string_view text)
{
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
    return text;
}

/// Reads "-12.50", "30."; returns nullopt if it is no decimal number.
std::optional<SeenNumber> decimal_of(std::string_view text)
{
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    SeenNumber number;
    std::size_t digits = 0;
    bool point = false;
    for (const char c : text) {
        if (c == '.' && !point) {
            point = true;
            continue;
        }
        if (c < '0' || c > '9' || ++digits > kMaxDigits) return std::nullopt;
        number.counts = number.counts * 10 + (c - '0');
        if (point) ++number.decimals;
    }
    if (digits == 0) return std::nullopt;
    if (negative) number.counts = -number.counts;
    return number;
}

/// Reads ">1B0B": one to four digits after the sign.
std::optional<SeenNumber> hexadecimal_of(std::string_view text)
{
    if (!text.starts_with('>') || text.size() < 2 || text.size() > 5) return std::nullopt;
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return SeenNumber{static_cast<std::int64_t>(value), 0};
}

bool is_less(SeenNumber a, SeenNumber b)
{
    for (; a.decimals < b.decimals; ++a.decimals) a.counts *= 10;
    for (; b.decimals < a.decimals; ++b.decimals) b.counts *= 10;
    return a.counts < b.counts;
}

} // namespace

std::string_view text(SurveyForm form) noexcept
{
    switch (form) {
        case SurveyForm::none: return "none";
        case SurveyForm::number: return "number";
        case SurveyForm::hexadecimal: return "hexadecimal";
        case SurveyForm::other: return "text";
        case SurveyForm::mixed: return "mixed";
        case SurveyForm::word: return "word";
    }
    return "?";
}

std::string text(SeenNumber number)
{
    std::string digits = std::to_string(number.counts < 0 ? -number.counts : number.counts);
    if (digits.size() <= number.decimals) digits.insert(0, number.decimals + 1 - digits.size(), '0');
    if (number.decimals > 0) digits.insert(digits.size() - number.decimals, ".");
    return (number.counts < 0 ? "-" : "") + digits;
}

void Sighting::add(const SurveyAnswer& answer)
{
    if (answer.kind == SurveyAnswer::Kind::silence) {
        ++silences;
        return;
    }
    if (answer.kind == SurveyAnswer::Kind::denied) {
        ++denials;
        denied = answer.text;
        return;
    }
    ++answers;
    SurveyForm now = SurveyForm::word;
    std::optional<SeenNumber> number = SeenNumber{answer.word, 0};
    last = std::to_string(answer.word);
    if (answer.kind == SurveyAnswer::Kind::text) {
        last = without_blanks(answer.text);
        now = SurveyForm::hexadecimal;
        number = hexadecimal_of(last);
        if (!number) {
            number = decimal_of(last);
            now = number ? SurveyForm::number : SurveyForm::other;
        }
    }
    const bool is_first = form == SurveyForm::none;
    form = is_first || form == now ? now : SurveyForm::mixed;
    if (!number || form == SurveyForm::mixed) return;
    if (form == SurveyForm::hexadecimal)
        digits = std::max<unsigned>(digits, static_cast<unsigned>(last.size()) - 1);
    decimals = std::max(decimals, number->decimals);
    if (is_first || is_less(*number, lowest)) lowest = *number;
    if (is_first || is_less(highest, *number)) highest = *number;
}

// ---- which tag is next

bool SurveyPlan::is_wanted(const Sighting& one) const
{
    if (one.answers > 0) return passes_ == 0 || one.asked() < passes_;
    return one.denials == 0 && one.silences < kAsksOfSilent;
}

std::optional<std::uint16_t> SurveyPlan::next(const Survey& seen)
{
    if (at_ == round_.size()) {
        at_ = 0;
        round_.clear();
        std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
        for (const TagSpan span : spans_) {
            for (std::uint32_t tag = span.first; tag <= span.last; ++tag) {
                const auto found = seen.find(static_cast<std::uint16_t>(tag));
                if (found != seen.end() && !is_wanted(found->second)) continue;
                const std::uint32_t asked = found == seen.end() ? 0 : found->second.asked();
                if (asked > least) continue;
                if (asked < least) round_.clear();
                least = asked;
                round_.push_back(static_cast<std::uint16_t>(tag));
            }
        }
    }
    if (round_.empty()) return std::nullopt;
    return round_[at_++];
}

std::size_t SurveyPlan::left(const Survey& seen) const
{
    std::size_t fresh = 0, visited = 0, answering = 0, more = 0;
    for (const TagSpan span : spans_) {
        for (std::uint32_t tag = span.first; tag <= span.last; ++tag) {
            const auto found = seen.find(static_cast<std::uint16_t>(tag));
            if (found == seen.end()) {
                ++fresh;
                continue;
            }
            ++visited;
            const Sighting& one = found->second;
            if (one.answers > 0) ++answering;
            if (is_wanted(one)) more += (one.answers > 0 ? passes_ : kAsksOfSilent) - one.asked();
        }
    }
    const std::size_t further = visited > 0 && passes_ > 1 ? fresh * (passes_ - 1) * answering / visited : 0;
    return fresh + further + more;
}

std::size_t SurveyPlan::tags() const
{
    return std::accumulate(spans_.begin(), spans_.end(), std::size_t{0}, [](std::size_t sum, TagSpan span) {
        return sum + static_cast<std::size_t>(span.last - span.first) + 1;
    });
}

// ---- how long it takes

void SurveyPace::took(std::chrono::nanoseconds one)
{
    window_[count_++ % kWindow] = one;
}

std::optional<std::chrono::seconds> SurveyPace::time_for(std::size_t reads) const
{
    if (count_ < kEnough) return std::nullopt;
    const std::size_t known = std::min(count_, kWindow);
    const auto sum = std::accumulate(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(known),
                                     std::chrono::nanoseconds{0});
    const double seconds = std::chrono::duration<double>(sum).count() / static_cast<double>(known);
    return std::chrono::seconds{std::llround(std::ceil(seconds * static_cast<double>(reads)))};
}

SurveyPatience::Verdict SurveyPatience::waits(bool for_drive, std::chrono::nanoseconds now)
{
    if (!since_) since_ = now;
    if (is_time_over(now)) return for_drive ? Verdict::no_drive : Verdict::time_is_over;
    if (now < *since_ + kLongest || (time_ && for_drive)) return Verdict::wait;
    return for_drive ? Verdict::no_drive : Verdict::other_survey;
}

} // namespace dpslave::profile
