// SPDX-License-Identifier: Apache-2.0
/// The cyclic reads of one drive: which tags go into one transaction, and which transaction comes next. A
/// round reads every tag once, whatever it is for. A block that the drive refuses is cut until the hole is
/// found between two neighbours or is a tag itself, which only a single read decides; cuts elsewhere are
/// removed then. A tag with a register of its own is never part of a block.
#pragma once

#include "parameter_set.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dpslave::drive {

/// A tag that the drive does not have is not asked for this time: long enough to cost nothing, short enough
/// that a corrected drive is noticed.
inline constexpr std::chrono::nanoseconds kInvalidRetry = std::chrono::seconds{10};

/// An excluded tag that could not be asked because of an owed answer waits for this time.
inline constexpr std::chrono::nanoseconds kDeferredRetry = std::chrono::milliseconds{100};

/// Rounds in which nothing is read for the master begin this far apart: an idle line stays calm.
inline constexpr std::chrono::nanoseconds kCalmRound = std::chrono::milliseconds{250};

/// A block that is not understood is only left out for this number of rounds in a row: the drive may be busy.
/// Then it is cut like one that is refused [DEC].
inline constexpr int kBusyRounds = 3;

/// A deadline that has passed at every moment; unlike Instant::min() it can be subtracted from.
inline constexpr Instant kAtOnce{};

class ReadPlan {
public:
    /// The turns `first` to `last`, read in one transaction.
    struct Block {
        std::size_t first = 0;
        std::size_t last = 0;
    };

    explicit ReadPlan(BlockRule rule) : rule_(rule) {}

    /// Sets the reads of `parameters`, which outlives this plan of it.
    void reset(ParameterSet& parameters);
    /// Exchanges the rows of the same layout, and maybe the watched tags. The former ones still exist.
    void exchange(ParameterSet& parameters);

    /// The compared outputs are read from now on, or no more.
    void compare(bool outputs);

    std::optional<Block> next(Instant now); ///< nullopt: the round is over
    void begin_round(Instant now);          ///< does nothing while a calm round is not due
    Instant next_due() const;
    std::uint16_t count_of(Block block) const; ///< tags, the unasked ones between included
    Purpose purpose_of(Block block) const;
    const DriveParameter& parameter(std::size_t turn) const { return *turns_[turn].parameter; }

    /// Takes the result of `block`; not for no_answer. Returns true if a value or a state of an input
    /// changed.
    bool done(Block block, const Outcome& outcome, Instant now);
    /// It is not asked for any more: 0 from now on.
    void refuse(DriveParameter& parameter, AccessError error, std::string_view answer);
    void skip(Block block); ///< leaves it out in this round
    /// It was asked without a result: its words are held from now on, until a good answer.
    void hold(Block block, AccessError why);
    /// The drive has not answered: whatever it was asked, all reads wait for the transaction that is
    /// repeated.
    void hold_all();
    /// The block was not asked because an answer is still owed: its words are held, and asked for again in
    /// the next round.
    void defer(Block block, Instant now);
    /// Excluded parameters are asked again now: it may be another drive. The round goes on where it was.
    void drive_returned(Instant now);

private:
    /// The places where a block ends.
    enum class Cut : std::uint8_t {
        none,
        search,     ///< before this turn, on the way to a hole
        after_hole, ///< the turn before it and this one are refused together
    };
    struct Turn {
        DriveParameter* parameter = nullptr;
        Instant retry_at{}; ///< of an excluded parameter: when the drive is asked again
        Cut cut = Cut::none;
        int busy = 0; ///< rounds in a row in which a block from here on was not understood
        Reading& reading() const { return parameter->reading; }
        const Tag& row() const { return *parameter->row; }
    };
    /// A refused block, cut in two: is the hole between its halves?
    struct Halves {
        Block block{};
        std::size_t second = 0; ///< the first turn of its second half
        bool first_is_good = false;
    };

    std::uint8_t uses_now(const Turn& turn) const;
    bool in_use(const Turn& turn) const { return uses_now(turn) != 0; }
    bool waits_for_retry(const Turn& turn) const;
    bool is_urgent(const Turn& turn) const;
    void hold(const Turn& turn, AccessError why) const;
    bool joins(const Turn& turn) const;
    void rebuild();
    void remove_search_cuts();
    std::size_t in_use_from(std::size_t index) const;
    void split(Block block);
    bool busy(Block block);
    void find_hole(Block good);
    bool good(Block block, std::span<const std::uint16_t> words, Instant now);
    bool bad(std::size_t index, const Outcome& outcome, Instant now);

    BlockRule rule_;
    std::vector<Turn> turns_; ///< ascending by tag, each tag once
    std::vector<Block> blocks_;
    std::optional<Halves> halves_;      ///< of the block cut last
    std::size_t position_ = 0;          ///< the first turn that this round has not had yet
    std::uint8_t cyclic_ = kReadAlways; ///< the uses that are read again and again
    bool calm_ = true;                  ///< nothing is read but watched tags
    std::optional<Instant> began_at_;   ///< the round
};

} // namespace dpslave::drive
