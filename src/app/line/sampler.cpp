// SPDX-License-Identifier: Apache-2.0
#include "sampler.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace dpslave::app {

namespace {

/// The oldest records make room, those with the tags too: so many samples at most cannot be read for it.
constexpr unsigned kSamplesForALayout = 64;

/// Generations count through zero.
bool has_ended(Generation layout, Generation ended)
{
    return ended != 0 && static_cast<std::int32_t>(ended - layout) >= 0;
}

} // namespace

void Sampler::set_layout(const Layout& layout)
{
    layout_ = layout;
    const std::span<const LayoutEntry> all = std::span{layout_.parameters}.first(layout_.count);
    reads_ = std::any_of(all.begin(), all.end(), [](const LayoutEntry& one) { return one.reads; });
}

void Sampler::sample(std::uint32_t station, const drive::DriveSnapshot& now, Generation ended,
                     trace::Ring& ring, Instant at)
{
    const std::uint64_t rounds = reads_ ? now.refresh_ms.count() : now.writes;
    const bool was_refreshed = std::exchange(rounds_, rounds) != rounds;
    const bool is_lost = std::exchange(answered_, now.answers) && !now.answers;
    if (layout_.generation == 0 || layout_.generation != now.generation || !ring.is_on()) return;
    const bool is_new = std::exchange(known_, layout_.generation) != layout_.generation;
    const bool ends = has_ended(layout_.generation, ended);
    const bool just_ended = std::exchange(has_ended_, ends) != ends;
    if (is_new || (was_refreshed && until_layout_ == 0)) {
        put_layout(ring, station, layout_, at);
        until_layout_ = kSamplesForALayout;
    }
    if (layout_.count == 0 || is_new || !(was_refreshed || is_lost || just_ended)) return;
    if (until_layout_ > 0) --until_layout_;
    put_values(ring, {station, layout_.generation},
               {std::span{now.words}.first(layout_.count), std::span{now.states}.first(layout_.count), ends},
               at);
}

} // namespace dpslave::app
