// SPDX-License-Identifier: Apache-2.0
/// The outputs of one drive: what the master wants written, what the drive has answered, and what is zeroed
/// when the master leaves. Every output is written once on change and again after the refresh interval, at
/// most once a round.
#pragma once

#include "read_plan.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dpslave::drive {

class OutputPlan {
public:
    struct Item {
        std::size_t parameter = 0; ///< its place in the layout
        const Tag* row = nullptr;
        bool asked = true; ///< false: decided without the drive (read only in the table, ...); state says how
        std::uint16_t wanted = 0;
        /// The word that the drive has taken or refused last. None: it is not known what the drive holds -
        /// never written, the answer was lost, or the drive was gone. Then the present word is written.
        std::optional<std::uint16_t> answered;
        WordState state = WordState::untried;
        std::uint16_t written = 0; ///< last word that was taken, for the eye
        Instant attempted_at{};
        Instant updated_at{};
        std::uint32_t round = 0;     ///< in which it was written last
        bool waits = false;          ///< the drive was lost on it: after the return the others go first
        bool not_understood = false; ///< the drive has not taken the word, and may yet
    };

    explicit OutputPlan(std::chrono::nanoseconds refresh) : refresh_(refresh) {}

    // The present layout.
    void reset(std::vector<Item> items);
    void set(std::span<const std::uint16_t> words, bool may_write);
    void stop() { stopped_ = true; } ///< the layout has ended: nothing of it is written any more
    const std::vector<Item>& items() const { return items_; }

    void begin_round() { ++round_; }
    std::optional<std::size_t> next(Instant now) const; ///< changed ones first, then those to refresh
    Instant next_due() const;                           ///< of outputs and zeros; rounds left out of account
    void started(std::size_t index, Instant now);
    void done(std::size_t index, std::uint16_t word, AccessError error, Instant now); ///< not for no_answer
    void lost_on(std::size_t index) { items_[index].waits = true; }
    void drive_lost();
    void drive_returned(); ///< before begin_round()

    // The safe state: tags to be written 0, each until the drive has taken or refused it.
    void zero(const Tag* row);
    /// The tag to be zeroed next. A tag that the present layout writes is dropped: the zero would come after
    /// the master's newer word.
    const Tag* next_zero(Instant now);
    void postpone_zero(const Tag* row, Instant now); ///< not understood: another one goes first
    void zeroed(const Tag* row);
    bool zeros_wait() const { return !zeros_.empty(); }

private:
    /// One tag to be written 0.
    struct Zero {
        const Tag* row = nullptr;
        Instant due = kAtOnce;
    };

    bool writes_now() const { return may_write_ && !stopped_; }
    Instant due_at(const Item& item) const;

    std::chrono::nanoseconds refresh_;
    std::vector<Item> items_;
    std::vector<Zero> zeros_;
    std::uint32_t round_ = 1;
    bool may_write_ = false;
    bool stopped_ = false;
};

} // namespace dpslave::drive
