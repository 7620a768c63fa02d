// SPDX-License-Identifier: Apache-2.0
/// The cyclic reads of one drive: which tags go into one transaction, and which transaction comes next. A
/// round reads every tag once. A block that the drive refuses is split until only single reads are left: they
/// alone decide.
#pragma once

#include "dpslave/drive/backend.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dpslave::drive {

/// How long a tag that the drive does not have is left alone: long enough to cost nothing, short enough that
/// a corrected drive is noticed.
inline constexpr std::chrono::nanoseconds kInvalidRetry = std::chrono::seconds{10};

/// A deadline that has passed at every moment; unlike Instant::min() it can be subtracted from.
inline constexpr Instant kAtOnce{};

/// What an error of an access means for the parameter. Not for none and no_answer.
WordState state_of(AccessError error);

class ReadPlan {
public:
    struct Item {
        const Tag* row = nullptr;
        bool asked =
            true; ///< false: decided without the drive (STRING, write-only, not in the table); state says how
        std::uint16_t word = 0;
        WordState state = WordState::untried;
        bool tried = false;
        Instant updated_at{}; ///< last success
        Instant retry_at{};   ///< of an excluded item: when the drive is asked again
        bool starts_block = false;
    };
    /// Items `first` to `last` in one transaction.
    struct Block {
        std::size_t first = 0;
        std::size_t last = 0;
    };

    explicit ReadPlan(BlockRule rule) : rule_(rule) {}

    /// `items` ascending by tag, each tag once.
    void reset(std::vector<Item> items);
    std::optional<std::size_t> find(std::uint16_t tag) const;
    const std::vector<Item>& items() const { return items_; }

    bool empty() const { return blocks_.empty(); } ///< nothing is read cyclically
    std::optional<Block> next(Instant now) const;  ///< nothing: the round is over
    void begin_round() { position_ = 0; }
    std::uint16_t count_of(Block block) const; ///< tags, the unasked ones between included
    Instant next_retry() const;                ///< of the excluded items
    bool every_item_tried() const;

    /// What became of `block`; not for no_answer. True: a value or a state changed.
    bool done(Block block, AccessError error, std::span<const std::uint16_t> words, Instant now);
    void skip(Block block); ///< leaves it out in this round
    void drive_lost();
    /// Excluded items are asked again now: it may be another drive. The round goes on where it was.
    void drive_returned(Instant now);

private:
    static bool excluded(const Item& item);
    void rebuild();
    void split(Block block);
    bool good(Block block, std::span<const std::uint16_t> words, Instant now);
    bool bad(std::size_t index, AccessError error, Instant now);

    BlockRule rule_;
    std::vector<Item> items_;
    std::vector<Block> blocks_;
    std::size_t position_ = 0; ///< the first item that this round has not read yet
};

} // namespace dpslave::drive
