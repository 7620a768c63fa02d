// SPDX-License-Identifier: Apache-2.0
/// Decides which output of the present layout of one drive is written next. A changed word is written at
/// once, each output at most once a round. A standing word is written again after the refresh interval; or,
/// where outputs are compared, only when a read shows another word in the drive: its memory bears a limited
/// number of writes. A word whose row says `once` goes out once for each change.
#pragma once

#include "read_plan.hpp"
#include "sent_once.hpp"

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

/// After this number of blocks in a row that were refused or not answered, this drive gets single writes
/// only.
inline constexpr int kMaxFailedBlocks = 3;

class OutputPlan {
public:
    struct Rule {
        std::chrono::nanoseconds refresh = std::chrono::seconds{1};
        bool compare = false;
        std::uint16_t max_written = 1; ///< adjoining tags in one transaction; only where outputs are compared
    };

    /// The next write; valid until the next start().
    struct Write {
        const Tag* row = nullptr; ///< of the first word
        std::span<const std::uint16_t> words;
    };

    explicit OutputPlan(Rule rule) : rule_(rule) {}

    /// Sets the outputs of `parameters`, which outlives this plan of them. Nothing is written before set().
    void reset(ParameterSet& parameters);
    void set(std::span<const std::uint16_t> words, bool may_write);
    /// Exchanges the rows of the same layout. The former ones still exist.
    void exchange(ParameterSet& parameters, std::chrono::nanoseconds refresh);
    void leave_port() { leaves_port_ = true; } ///< nothing is written until port_changed()
    /// The port was opened again and may lead to another drive: every word is written. Call it before
    /// begin_round().
    void port_changed();
    bool leaves_port() const { return leaves_port_; }
    void stop() { stopped_ = true; } ///< the layout has ended: nothing of it is written any more
    bool writes_now() const { return may_write_ && !stopped_ && !leaves_port_; }
    /// Calls `use` with the row of each output that is asked of the drive.
    template <class UseRow>
    void for_each_row(UseRow use) const
    {
        for (const Turn& turn : turns_)
            if (turn.writing().asked) use(turn.parameter->row);
    }

    void begin_round() { ++round_; }
    /// Changed ones first, then those to refresh or to repeat, each with its neighbours that are due as well.
    std::optional<Write> start(Instant now);
    Instant next_due() const; ///< rounds left out of account
    /// Takes the result of the write started last; not for no_answer. A block that was refused says nothing
    /// about its words: they are written one by one.
    void done(AccessError error, Instant now);
    void not_answered(bool drive_lost);
    void defer(); ///< not asked or not proven: once more in the next round
    /// It is repeated, and until then it is not known what the drive holds.
    void hold(AccessError why);
    bool writes_block() const { return batch_.size() > 1; } ///< the write started last

    /// A cyclic read that began at `began` showed `word`.
    void observed(const Tag* row, std::uint16_t word, Instant began);
    /// The drive does not give its word: nothing can be compared.
    void unreadable(const Tag* row);
    void refuse(const Tag* row, AccessError error); ///< it is not written any more

    SentOnce& sent_once() { return sent_once_; }
    const SentOnce& sent_once() const { return sent_once_; }

    void drive_returned(); ///< before begin_round()

private:
    struct Turn {
        DriveParameter* parameter = nullptr;
        Instant attempted_at{};
        std::uint32_t round = 0; ///< in which it was written last
        bool waits = false;      ///< the drive was lost on it: after the return the others go first
        bool alone = false;      ///< not in a block until a single write has worked: that one decides
        unsigned repeats = 0;    ///< answered writes of the same word in a row, none of them held
        std::optional<std::uint16_t> repeated; ///< that word
        Writing& writing() const { return parameter->writing; }
    };

    void use(ParameterSet& parameters);
    Turn* find_asked(const Tag* row);
    Instant due_at(const Turn& turn) const;
    Instant repeat_at(const Turn& turn) const;
    bool joins(const Turn& turn, Instant now) const;
    void join_neighbours(std::size_t index, Instant now);
    void block_failed();

    Rule rule_;
    SentOnce sent_once_;
    std::vector<Turn> turns_;         ///< in the order of the layout
    std::vector<std::size_t> by_tag_; ///< those that are asked, ascending by tag
    std::vector<std::size_t> batch_;  ///< turns of the write started last, in the order of their tags
    std::array<std::uint16_t, kMaxParameters> words_{};
    int failed_blocks_ = 0; ///< in a row
    std::uint32_t round_ = 1;
    bool may_write_ = false;
    bool stopped_ = false;
    bool leaves_port_ = false;
};

} // namespace dpslave::drive
