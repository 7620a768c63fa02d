// SPDX-License-Identifier: Apache-2.0
/// Measures what the lamps show, with a simulated clock.
#pragma once

#include "dpslave/led/pattern.hpp"

#include <ostream>

namespace dpslave::led {

constexpr Instant at(std::chrono::nanoseconds time)
{
    return Instant{time};
}

/// What an observer with a stop watch sees in the window of two seconds that begins at `from`.
struct Seen {
    int flashes = 0; ///< times that the lamp went on
    int lit_ms = 0;  ///< of the 2000 ms
    friend bool operator==(const Seen&, const Seen&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Seen& seen)
    {
        return out << seen.flashes << " flashes, lit " << seen.lit_ms << " ms";
    }
};
inline constexpr Seen kDark{0, 0};
inline constexpr Seen kSteady{0, 2000};
inline constexpr Seen k1Hz{2, 1000};
inline constexpr Seen k2Hz{4, 1000};

inline Seen watch(const Pattern& pattern, std::chrono::nanoseconds from)
{
    Seen seen;
    bool before = lit(pattern, at(from - std::chrono::milliseconds{1}));
    for (int ms = 0; ms < 2000; ++ms) {
        const bool now = lit(pattern, at(from + std::chrono::milliseconds{ms}));
        if (now && !before) ++seen.flashes;
        if (now) ++seen.lit_ms;
        before = now;
    }
    return seen;
}

/// Does the meaning of the lamps contain `words`?
inline bool says(Language language, const Condition& condition, std::string_view words)
{
    return meaning(language, condition).find(words) != std::string_view::npos;
}

} // namespace dpslave::led
