// SPDX-License-Identifier: Apache-2.0
/// The cyclic reads of one drive: which tags go into one transaction, and which transaction comes next. A
/// round reads every tag once, whoever wants it. A block that the drive refuses is cut until the hole is
/// found between two neighbours or is a tag itself, which only a single read decides; cuts elsewhere are
/// mended then. A tag with a register of its own is never part of a block.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dpslave::drive {

/// How long a tag that the drive does not have is left alone: long enough to cost nothing, short enough that
/// a corrected drive is noticed.
inline constexpr std::chrono::nanoseconds kInvalidRetry = std::chrono::seconds{10};

/// How long an excluded tag that could not be asked for the sake of an owed answer waits.
inline constexpr std::chrono::nanoseconds kDeferredRetry = std::chrono::milliseconds{100};

/// Rounds in which nothing is read for the master begin this far apart: an idle line stays calm.
inline constexpr std::chrono::nanoseconds kCalmRound = std::chrono::milliseconds{250};

/// So many rounds in a row a block that is not understood is only left out: the drive may be busy. Then it is
/// cut like one that is refused [DEC].
inline constexpr int kBusyRounds = 3;

/// A deadline that has passed at every moment; unlike Instant::min() it can be subtracted from.
inline constexpr Instant kAtOnce{};

/// What an error of an access means for the parameter. Not for none and no_answer.
WordState state_of(AccessError error);

class ReadPlan {
public:
    struct Item {
        const Tag* row = nullptr;
        bool input = false;    ///< an input of the layout
        bool watched = false;  ///< read with or without a layout
        bool compared = false; ///< an output whose word in the drive is looked at, while it is written
        /// An output that only an answer of the drive gives a form: read until it is known.
        bool form = false;
        bool unscaled = false; ///< a number has no scale by the row: asked first, before the others
        /// False: decided without the drive (STRING, write-only, not in the table); state says how.
        bool asked = true;
        std::uint16_t word = 0;
        WordState state = WordState::untried;
        AccessError error = AccessError::none; ///< why; with `state` stale: see UnitSnapshot::errors
        bool tried = false;
        Instant updated_at{};      ///< last success
        Instant retry_at{};        ///< of an excluded item: when the drive is asked again
        bool starts_block = false; ///< cut here on the way to a hole
        bool after_hole = false;   ///< the item before it and this one are refused together
        AnswerText answer{};       ///< behind the errors no_scale and contradicted
        int busy = 0;              ///< rounds in a row in which a block from here on was not understood
        int failures = 0;          ///< refreshes in a row without a good answer
    };
    /// Items `first` to `last` in one transaction.
    struct Block {
        std::size_t first = 0;
        std::size_t last = 0;
    };

    explicit ReadPlan(BlockRule rule) : rule_(rule) {}

    /// `items` ascending by tag, each tag once.
    void reset(std::vector<Item> items);
    /// Other rows for the same layout, and maybe other watched tags: what is known stays where the drive is
    /// asked the same; else the word is held until it has been read anew.
    void exchange(std::vector<Item> items);
    std::optional<std::size_t> find(std::uint16_t tag) const;
    const std::vector<Item>& items() const { return items_; }

    /// The compared outputs are read from now on, or no more.
    void compare(bool outputs);

    std::optional<Block> next(Instant now); ///< nothing: the round is over
    void begin_round(Instant now);          ///< does nothing while a calm round is not due
    Instant next_due() const;
    std::uint16_t count_of(Block block) const; ///< tags, the unasked ones between included
    bool serves_input(Block block) const;      ///< also false: nothing but compared and watched tags
    bool serves_output(Block block) const;
    bool every_input_tried() const; ///< and each output whose form is asked for
    /// One of those has answered with a number of unknown scale.
    bool scale_missing() const;

    /// What became of `block`; not for no_answer. `answer`: see Outcome. True: a value or a state of an input
    /// changed.
    bool done(Block block, AccessError error, std::span<const std::uint16_t> words, Instant now,
              std::string_view answer = {});
    /// It is not asked for any more: 0 from now on.
    void refuse(std::uint16_t tag, AccessError error, std::string_view answer);
    void skip(Block block); ///< leaves it out in this round
    /// It was asked and is no wiser: its words are held from now on, until a good answer.
    void hold(Block block, AccessError why);
    /// The drive has not answered: whatever it was asked, all reads wait for the transaction that is
    /// repeated.
    void hold_all();
    /// It was not asked for the sake of an answer that is still owed: its words are held, and asked for again
    /// in the next round.
    void defer(Block block, Instant now);
    void drive_lost();
    /// Excluded items are asked again now: it may be another drive. The round goes on where it was.
    void drive_returned(Instant now);

private:
    static bool excluded(const Item& item);
    bool is_cyclic(const Item& item) const;
    bool in_use(const Item& item) const;
    void hold(Item& item, AccessError why) const;
    bool is_urgent(const Item& item) const;
    /// A refused block, cut in two: is the hole between its halves?
    struct Cut {
        Block block{};
        std::size_t at = 0; ///< the first item of its second half
        bool first_half_is_good = false;
    };

    bool joins(const Item& item) const;
    void rebuild();
    void mend();
    std::size_t in_use_from(std::size_t index) const;
    void split(Block block);
    bool busy(Block block);
    void look_at_cut(Block good);
    bool good(Block block, std::span<const std::uint16_t> words, Instant now);
    bool bad(std::size_t index, AccessError error, Instant now, std::string_view answer);

    BlockRule rule_;
    std::vector<Item> items_;
    std::vector<Block> blocks_;
    std::optional<Cut> cut_;   ///< the last one
    std::size_t position_ = 0; ///< the first item that this round has not read yet
    bool compares_ = false;
    bool calm_ = true; ///< nothing is read but watched tags
    bool begun_ = false;
    Instant began_at_{}; ///< the round
};

} // namespace dpslave::drive
