// SPDX-License-Identifier: Apache-2.0
#include "book.hpp"

#include <algorithm>
#include <array>

namespace dpslave::app {
namespace {

constexpr std::array<std::string_view, 5> kCodes{"left", "refused", "flaws", "drive", "answer"};

/// By CLOCK_REALTIME, which is all that is known of a run before. A clock that was set back ends no storm.
std::uint64_t storm_of(const Incident& one, const Incident* before)
{
    const bool goes_on =
        before != nullptr &&
        std::chrono::nanoseconds{one.first_unix_ns - before->first_unix_ns} < IncidentBook::kCalm;
    return goes_on ? before->storm : one.number;
}

} // namespace

std::string_view code(IncidentKind kind) noexcept
{
    return kCodes[static_cast<std::size_t>(kind)];
}

std::optional<IncidentKind> incident_kind(std::string_view code) noexcept
{
    const auto found = std::find(kCodes.begin(), kCodes.end(), code);
    if (found == kCodes.end()) return std::nullopt;
    return static_cast<IncidentKind>(found - kCodes.begin());
}

IncidentBook::Verdict IncidentBook::happened(const IncidentKey& key, std::string_view text, Instant now,
                                             std::int64_t unix_ns)
{
    if (Incident* const equal = equal_of(key)) {
        ++equal->count;
        equal->last_unix_ns = unix_ns;
        counts_changed_ = true;
        return Verdict::counted;
    }
    const Incident* const open = opened();
    if (open != nullptr && now <= open_until_) {
        auto& also = kept_[static_cast<std::size_t>(open - kept_.data())].also;
        if (also.size() < kMostAlso) also.push_back(key);
        return Verdict::joined;
    }
    if (!may_open(now)) {
        ++not_kept_;
        return Verdict::not_kept;
    }
    Incident one{.number = next_++,
                 .key = key,
                 .text = std::string{text},
                 .first_unix_ns = unix_ns,
                 .last_unix_ns = unix_ns};
    one.storm = storm_of(one, kept_.empty() ? nullptr : &kept_.back());
    kept_.push_back(std::move(one));
    open_ = kept_.back().number;
    open_until_ = now + kAfter;
    drop_surplus();
    return Verdict::opened;
}

Incident* IncidentBook::equal_of(const IncidentKey& key)
{
    for (Incident& one : kept_)
        if (one.key == key || std::find(one.also.begin(), one.also.end(), key) != one.also.end()) return &one;
    return nullptr;
}

bool IncidentBook::may_open(Instant now)
{
    while (credit_ < kInARow && now - credit_from_ >= kPause) {
        ++credit_;
        credit_from_ += kPause;
    }
    if (credit_ == 0) return false;
    if (credit_-- == kInARow) credit_from_ = now;
    return true;
}

void IncidentBook::drop_surplus()
{
    while (kept_.size() > kFirst + kLast) {
        const auto one = surplus();
        dropped_.push_back(one->number);
        kept_.erase(one);
    }
}

/// Of the last: the oldest of the largest storm, but not the one that began it, and not the newest. If each
/// stands for another storm, the oldest.
std::vector<Incident>::iterator IncidentBook::surplus()
{
    const auto last = kept_.begin() + kFirst;
    auto found = last;
    std::ptrdiff_t most = 1;
    for (auto one = last; one + 1 != kept_.end(); ++one) {
        if (one->storm == one->number) continue;
        const auto of_its_storm = std::count_if(
            last, kept_.end(), [&](const Incident& other) { return other.storm == one->storm; });
        if (of_its_storm <= most) continue;
        found = one;
        most = of_its_storm;
    }
    return found;
}

const Incident* IncidentBook::opened() const
{
    return open_ == 0 ? nullptr : find(open_);
}

bool IncidentBook::is_complete(Instant now)
{
    if (open_ == 0 || now <= open_until_) return false;
    open_ = 0;
    return true;
}

void IncidentBook::restore(std::vector<Incident> kept, std::uint64_t next_number)
{
    kept_ = std::move(kept);
    std::sort(kept_.begin(), kept_.end(),
              [](const Incident& one, const Incident& other) { return one.number < other.number; });
    const Incident* before = nullptr;
    for (Incident& one : kept_) {
        one.storm = storm_of(one, before);
        before = &one;
    }
    next_ = std::max(next_, next_number);
    if (!kept_.empty()) next_ = std::max(next_, kept_.back().number + 1);
    drop_surplus();
}

void IncidentBook::forget(std::uint64_t number)
{
    std::erase_if(kept_, [number](const Incident& one) { return one.number == number; });
    if (open_ == number) open_ = 0;
}

std::vector<std::uint64_t> IncidentBook::take_dropped()
{
    return std::exchange(dropped_, {});
}

const Incident* IncidentBook::find(std::uint64_t number) const
{
    for (const Incident& one : kept_)
        if (one.number == number) return &one;
    return nullptr;
}

} // namespace dpslave::app
