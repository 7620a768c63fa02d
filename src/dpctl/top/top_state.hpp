// SPDX-License-Identifier: Apache-2.0
/// What `dpctl top` shows, and what the keys change in it. Pure.
#pragma once

#include "figures.hpp"
#include "keys.hpp"

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// An event with its time, which does not grow older as its age does.
struct PastEvent {
    std::int64_t number = 0;
    double unix_seconds = 0;
    std::string text;
};

class TopState {
public:
    static constexpr std::size_t kMostEvents = 50;
    static constexpr std::size_t kLongestFilter = 60; ///< octets

    /// The daemon was looked at again. `events`: the new ones, and those of before that may have another
    /// count now.
    void add(Sighting sighting, const report::GetEventsReply& events);
    /// A key was typed. False: the end is wanted.
    bool on_key(const Key& key);

    bool is_empty() const { return !has_now_; } ///< add() was not called yet
    /// The last one. Precondition here and below: not is_empty().
    const Sighting& now() const { return now_; }
    /// The one before; null: there was none.
    const Sighting* before() const { return has_before_ ? &before_ : nullptr; }
    std::chrono::nanoseconds passed() const { return now_.at - before_.at; } ///< between both
    const RecentTurnaround& turnaround() const { return turnaround_; }
    const std::deque<PastEvent>& events() const { return events_; } ///< the newest last

    /// Those that the filter lets through: of their own, or for one of their words.
    std::vector<const report::Station*> stations() const;
    /// The place of the selected one in stations(); 0 without any.
    std::size_t selected() const;
    /// The words of a station that the filter lets through; all of them if it lets the station through.
    std::vector<const report::Word*> words(std::string_view station) const;
    /// How many words of the selected station are above the first one that is shown.
    std::size_t first_word() const;

    const std::string& filter() const { return filter_; }
    bool types_filter() const { return types_filter_; }

    /// Whether it is new, or not what it was at the time before.
    bool has_changed(const report::Station& station) const;
    bool has_changed(std::string_view station, const report::Word& word) const;

private:
    void on_filter_key(const Key& key);
    void select(std::ptrdiff_t further);

    Sighting now_, before_;
    bool has_now_ = false, has_before_ = false;
    RecentTurnaround turnaround_;
    std::deque<PastEvent> events_;
    std::string selected_; ///< a name, for stations may come and go; empty: the first
    std::size_t first_word_ = 0;
    std::string filter_;
    bool types_filter_ = false;
};

} // namespace dpslave::dpctl
