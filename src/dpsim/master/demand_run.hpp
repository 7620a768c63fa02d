// SPDX-License-Identifier: Apache-2.0
/// Does what `demand ...` asks: one order or one block of values through Demand Data, from the command to the
/// answer of the drive. It is pure: words and times go in, lines and an end come out.
#pragma once

#include "condition.hpp"

#include "dpslave/arguments/exit_status.hpp"

namespace dpslave::sim {

class DemandRun {
public:
    explicit DemandRun(Master& master) : master_(master) {}

    /// The result of a command or of a moment. If it is neither done nor failed, call on_time() after the
    /// next turn of the master.
    struct Step {
        std::vector<std::string> lines{};
        bool done = false;
        std::string failure{};     ///< empty = none
        int exit = arguments::kNo; ///< with a failure: the exit status
    };
    /// `words`: the complete command, "demand" first.
    Step begin(const std::vector<std::string>& words, Instant now);
    Step on_time(Instant now);
    Instant deadline() const { return until_; }

private:
    using Words = std::vector<std::string>;
    /// Command 0 goes first: the answer to it separates the old answer from the new one, even with the same
    /// tag.
    enum class Phase : std::uint8_t { none_only, none_first, order, block };
    /// Values that go one by one, as worked example 2 of the 2408f/2404f handbook has it.
    struct Transfer {
        bool down = false;       ///< to the slave
        std::uint16_t first = 0; ///< tag
        std::size_t done = 0, count = 0;
    };

    Step show() const;
    Step raw(const Words& words);
    Step order(const Words& words, Instant now);
    Step transfer(const Words& words, Instant now);
    Step ask(bool is_block, Instant now);
    Step after_none(bool late);
    Step after_value(const DemandWords& answer, Instant now);
    DemandWords next_of_block() const;
    std::string block_line(std::size_t end) const;

    Master& master_;
    Phase phase_ = Phase::none_only;
    Instant until_ = kNever;
    DemandWords order_{};      ///< the order that is meant
    bool is_block_ = false;    ///< it begins a transfer
    std::uint64_t cycles_ = 0; ///< how many there had been
    Transfer transfer_;
    std::vector<std::uint16_t> block_; ///< what was uploaded last, or is being downloaded
};

} // namespace dpslave::sim
