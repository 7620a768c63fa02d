// SPDX-License-Identifier: Apache-2.0
#include "book.hpp"

#include <algorithm>
#include <array>

namespace dpslave::app {
namespace {

constexpr std::array<std::string_view, 5> kCodes{"left", "refused", "flaws", "drive", "answer"};

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
    kept_.push_back({.number = next_++,
                     .key = key,
                     .text = std::string{text},
                     .first_unix_ns = unix_ns,
                     .last_unix_ns = unix_ns});
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

/// The newest stays, whatever is kept: it is among the last.
void IncidentBook::drop_surplus()
{
    while (kept_.size() > kFirst + kLast) {
        const auto oldest_of_last = kept_.begin() + kFirst;
        dropped_.push_back(oldest_of_last->number);
        kept_.erase(oldest_of_last);
    }
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
