// SPDX-License-Identifier: Apache-2.0
/// What dpctl plot draws: values of tags over time, and the times of which nothing is known. Pure: replies of
/// GetSamples in. A value stands until the next sample, as the master sees it.
#pragma once

#include "dpslave/report/replies.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// How a value is drawn. Later ones win where several share a place.
enum class Mark : std::uint8_t {
    none,   ///< there is no value: it is a gap
    good,   ///< read, or written and taken
    held,   ///< the drive has not answered: the last value stands (state stale)
    failed, ///< the drive or the tag table refuses it (the other states)
};
Mark mark_of(std::string_view state);

struct Point {
    std::int64_t unix_ms = 0;
    Mark mark = Mark::none;
    double scaled = 0;
    std::int64_t raw = 0;
    std::string value, state; ///< as Sample has them; state "lost": what came then could not be fetched
};

struct Series {
    std::int64_t tag = 0;
    std::string name;
    std::optional<std::string> direction; ///< nothing: it is not in the present layout
    std::vector<Point> points;            ///< in their order

    std::string title() const; ///< "tag 7 SPEED FEEDBACK, in"
    bool has_values() const;
};

/// A time without a value; or, as standing() gives it, with one.
struct Span {
    std::int64_t from_ms = 0, to_ms = 0;
};

/// A picture of one station.
struct Plot {
    std::string station;
    Span time{}; ///< never empty
    std::vector<Series> series;
    std::vector<std::string> notes; ///< what is not in it, each a sentence
};

/// The replies to one tag, one after the other, as one series. `replies` is not empty.
Series series_of(const std::vector<report::GetSamplesReply>& replies);

/// Each value with the part of `time` in which it stands, in their order; gaps too, with Mark::none.
void for_each_standing(const Series& series, Span time, const std::function<void(const Point&, Span)>& take);

/// The lowest and the highest value within `time`.
struct Extent {
    double lowest = 0, highest = 0;
};
Extent extent_of(const Series& series, Span time);

/// Whether such a mark is anywhere in the picture.
bool has(const Plot& plot, Mark mark);

/// What is missing: older samples that did not fit, as `first_replies` (one for each series) say, and gaps.
std::vector<std::string> notes_of(const Plot& plot,
                                  const std::vector<report::GetSamplesReply>& first_replies);

} // namespace dpslave::dpctl
