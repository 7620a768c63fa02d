// SPDX-License-Identifier: Apache-2.0
/// Keeps the first 8 and the last 24 incidents; in a storm, its own incidents are dropped before older ones.
/// Equal ones are counted on the one that is kept, and what happens within the time that an incident covers
/// belongs to it. Pure; main thread only. The telegrams are in files (folder.hpp), not here.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dpslave::app {

enum class IncidentKind : std::uint8_t {
    left,    ///< a station left Data_Exch
    refused, ///< a Set_Prm or Chk_Cfg was refused
    flaws,   ///< a burst of what is no telegram
    drive,   ///< a drive was lost, or the port of its line
    answer,  ///< an answer of a drive was refused
};
std::string_view code(IncidentKind kind) noexcept; ///< "left", "refused" ...
/// Nothing: there is no such kind.
std::optional<IncidentKind> incident_kind(std::string_view code) noexcept;

/// What makes incidents equal.
struct IncidentKey {
    IncidentKind kind = IncidentKind::left;
    std::string station; ///< its name; empty: the bus
    std::string reason;  ///< a code
    friend bool operator==(const IncidentKey&, const IncidentKey&) = default;
};

struct Incident {
    std::uint64_t number = 0; ///< the first is 1
    IncidentKey key;
    std::string text;                ///< a sentence
    std::int64_t first_unix_ns = 0;  ///< ns since 1970
    std::int64_t last_unix_ns = 0;   ///< of the newest equal one
    std::uint64_t count = 1;         ///< with those that were equal
    std::vector<IncidentKey> also{}; ///< what else happened within its time; kMostAlso at most
    std::uint64_t storm = 0;         ///< number of the incident that began the storm it belongs to
};

class IncidentBook {
public:
    static constexpr std::size_t kFirst = 8, kLast = 24;
    static constexpr std::size_t kMostAlso = 16;
    /// What an incident covers, around its first moment.
    static constexpr std::chrono::seconds kBefore{3}, kAfter{2};
    /// A storm ends when so long none was opened. An incident that begins one is kept for 23 times as long at
    /// least: only what begins a later storm, and the newest, can push it out.
    static constexpr std::chrono::hours kCalm{1};
    /// So many in a row, then one in each kPause: files are written, and a flash memory wears out.
    static constexpr unsigned kInARow = 8;
    static constexpr std::chrono::seconds kPause{60};

    enum class Verdict : std::uint8_t {
        opened,   ///< it is a new one: opened() has it
        joined,   ///< it belongs to the one that is open
        counted,  ///< it is equal to one that is kept
        not_kept, ///< there were too many within a short time
    };
    Verdict happened(const IncidentKey& key, std::string_view text, Instant now, std::int64_t unix_ns);

    /// The one whose time is not over yet; null: there is none. Valid until the next call that changes
    /// anything.
    const Incident* opened() const;
    /// True once, when the time of the open one is over: opened() is null from now on.
    bool is_complete(Instant now);

    /// What a folder has, from a run before. In any order.
    void restore(std::vector<Incident> kept, std::uint64_t next_number);
    /// Its file could not be written: an equal one is tried again.
    void forget(std::uint64_t number);
    /// Numbers that are not kept any more, each once: their files can go.
    std::vector<std::uint64_t> take_dropped();

    const std::vector<Incident>& kept() const { return kept_; } ///< by number
    const Incident* find(std::uint64_t number) const;
    std::uint64_t next_number() const { return next_; }
    std::uint64_t not_kept() const { return not_kept_; }
    /// True once, when a count has changed since the last call.
    bool take_counts_changed() { return std::exchange(counts_changed_, false); }

private:
    Incident* equal_of(const IncidentKey& key);
    bool may_open(Instant now);
    void drop_surplus();
    std::vector<Incident>::iterator surplus();

    std::vector<Incident> kept_;
    std::vector<std::uint64_t> dropped_;
    std::uint64_t next_ = 1, open_ = 0, not_kept_ = 0; ///< open_: a number; 0: none
    Instant open_until_{};
    unsigned credit_ = kInARow;
    Instant credit_from_{}; ///< since when the next one is gained
    bool counts_changed_ = false;
};

} // namespace dpslave::app
