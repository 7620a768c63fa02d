// SPDX-License-Identifier: Apache-2.0
#include "watched_tags.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::app {

void WatchedTags::watch(const std::vector<std::uint16_t>& tags)
{
    std::vector<Seen> next;
    for (const std::uint16_t tag : tags) {
        const Seen* const known = find(tag);
        next.push_back(known != nullptr ? *known : Seen{.tag = tag});
    }
    seen_ = std::move(next);
}

void WatchedTags::update(const drive::DriveSnapshot& drive)
{
    for (std::size_t i = 0; i < seen_.size() && i < drive.watched.size(); ++i) {
        const drive::Watched& now = drive.watched[i];
        if (now.tag != seen_[i].tag) continue; // of the drive side before a reload that watches others
        seen_[i].is_current = (now.state == WordState::good || now.repeated) && drive.answers;
        if (now.state != WordState::good && now.state != WordState::stale) continue;
        seen_[i].word = now.word;
        seen_[i].was_read = true;
    }
}

const WatchedTags::Seen* WatchedTags::find(std::uint16_t tag) const
{
    const auto found =
        std::find_if(seen_.begin(), seen_.end(), [tag](const Seen& one) { return one.tag == tag; });
    return found != seen_.end() ? &*found : nullptr;
}

std::uint16_t WatchedTags::word_of(std::uint16_t tag) const
{
    const Seen* const one = find(tag);
    return one != nullptr ? one->word : std::uint16_t{0};
}

} // namespace dpslave::app
