// SPDX-License-Identifier: Apache-2.0
/// The outputs of the present layout of one drive: what the master wants written and what the drive has
/// answered. A changed word is written at once, each output at most once a round. A standing word is written
/// again after the refresh interval; or, where outputs are compared, only when a read shows another word in
/// the drive: its memory bears a limited number of writes.
#pragma once

#include "read_plan.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dpslave::drive {

/// A read that began so soon after a write proves that the word is there, but not that it is missing: the
/// drive may acknowledge a word before its parameter shows it [DEC].
inline constexpr std::chrono::nanoseconds kSettling = std::chrono::milliseconds{250};

/// Compared outputs: a word that the drive refuses is tried again after 1 s, 2 s, 4 s ... and then every 10 s
/// (kInvalidRetry); one that it accepts and does not keep is written again at once and then after 2 s, 4 s
/// ... and every minute, because that may cost its memory [DEC].
inline constexpr std::chrono::nanoseconds kFirstRepeat = std::chrono::seconds{1};
inline constexpr std::chrono::nanoseconds kRepeatNotKept = std::chrono::minutes{1};

/// So many blocks in a row that were refused or not answered, and this drive gets single writes only.
inline constexpr int kMaxFailedBlocks = 3;

class OutputPlan {
public:
    struct Rule {
        std::chrono::nanoseconds refresh = std::chrono::seconds{1};
        bool compare = false;
        std::uint16_t max_written = 1; ///< adjoining tags in one transaction; only where outputs are compared
    };

    struct Item {
        std::size_t parameter = 0; ///< its place in the layout
        const Tag* row = nullptr;
        bool asked = true; ///< false: decided without the drive (read only in the table, ...); state says how
        bool readable = false; ///< compared: the cyclic read shows what the drive holds
        std::uint16_t wanted = 0;
        /// The word that the drive has taken or refused last. None: it is not known what the drive holds -
        /// never written, the answer was lost, or the drive was gone. Then the present word is written.
        std::optional<std::uint16_t> answered;
        WordState state = WordState::untried;
        AccessError error = AccessError::none; ///< why, of the last write
        int failures = 0;                      ///< writes in a row of which it is not known what became
        std::uint16_t written = 0;             ///< last word that was taken, for the eye
        Instant attempted_at{};
        Instant answered_at{};
        Instant updated_at{};
        std::uint32_t round = 0; ///< in which it was written last
        bool waits = false;      ///< the drive was lost on it: after the return the others go first
        bool refused = false;    ///< `answered` was refused
        // What the reads of a compared output show since its last write:
        bool held = false;     ///< the wanted word
        bool differs = false;  ///< another one
        bool unproven = false; ///< nothing yet, and its answer was no proof, being that of a block
        bool supposed =
            false; ///< nothing yet, and there was no answer: the layout is new, or the drive was away
        bool alone = false;   ///< not in a block until a single write has worked: that one decides
        unsigned repeats = 0; ///< answered writes of the same word in a row, none of them held
        std::optional<std::uint16_t> repeated; ///< that word
    };

    /// What is written next; valid until the next start().
    struct Write {
        const Tag* row = nullptr; ///< of the first word
        std::span<const std::uint16_t> words;
    };

    explicit OutputPlan(Rule rule) : rule_(rule) {}

    void reset(std::vector<Item> items);
    void set(std::span<const std::uint16_t> words, bool may_write);
    /// Other rows for the same layout: what is known stays where the drive is asked the same; else the word
    /// is written anew.
    void exchange(std::vector<Item> items, std::chrono::nanoseconds refresh);
    void pause(bool paused) { paused_ = paused; } ///< nothing is written for the time being
    /// It may be another drive: every word is written. Before begin_round().
    void forget();
    void stop() { stopped_ = true; } ///< the layout has ended: nothing of it is written any more
    bool writes_now() const { return may_write_ && !stopped_ && !paused_; }
    const std::vector<Item>& items() const { return items_; }

    void begin_round() { ++round_; }
    /// Changed ones first, then those to refresh or to repeat, each with its neighbours that are due as well.
    std::optional<Write> start(Instant now);
    Instant next_due() const; ///< rounds left out of account
    /// What became of the write started last; not for no_answer. A block that was refused says nothing about
    /// its words: they are written one by one.
    void done(AccessError error, Instant now);
    void not_answered(bool drive_lost);
    void defer(); ///< not asked or not proven: once more in the next round
    /// It is repeated, and until then nobody knows what the drive holds.
    void hold(AccessError why);
    bool writes_block() const { return batch_.size() > 1; } ///< the write started last

    /// A cyclic read that began at `began` showed `word`.
    void observed(const Tag* row, std::uint16_t word, Instant began);
    /// The drive does not give its word: nothing can be compared.
    void unreadable(const Tag* row);

    /// It is not written any more.
    void refuse(const Tag* row, AccessError error);

    void drive_lost();
    void drive_returned(); ///< before begin_round()

private:
    static bool is_dropped(const Item& item);
    static void hold(Item& item, AccessError why);
    void sort_by_tag();
    Instant due_at(const Item& item) const;
    Instant repeat_at(const Item& item) const;
    bool joins(const Item& item, Instant now) const;
    void join_neighbours(std::size_t index, Instant now);
    void answered(Item& item, std::uint16_t word, AccessError error, Instant now);
    void block_failed();

    Rule rule_;
    std::vector<Item> items_;
    std::vector<std::size_t> by_tag_; ///< the items that are asked, ascending by tag
    std::vector<std::size_t> batch_;  ///< items of the write started last, in the order of their tags
    std::array<std::uint16_t, kMaxParameters> words_{};
    int failed_blocks_ = 0; ///< in a row
    std::uint32_t round_ = 1;
    bool may_write_ = false;
    bool stopped_ = false;
    bool paused_ = false;
};

} // namespace dpslave::drive
