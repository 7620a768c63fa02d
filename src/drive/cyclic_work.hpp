// SPDX-License-Identifier: Apache-2.0
/// The reads and writes of one layout of a drive, and its watched tags: what goes on round after round.
#pragma once

#include "output_plan.hpp"
#include "parameter_set.hpp"
#include "read_plan.hpp"
#include "transactions.hpp"

#include <chrono>
#include <optional>
#include <string_view>

namespace dpslave::drive {

class CyclicWork {
public:
    CyclicWork(ParameterSet parameters, BlockRule rule, OutputPlan::Rule outputs);

    /// Another layout. What becomes of a transaction for the one before is dropped.
    void reset(ParameterSet parameters, bool drive_is_lost);
    /// The same layout with other rows. Those of before are still there.
    void exchange(ParameterSet parameters, std::chrono::nanoseconds refresh, bool drive_is_lost);

    OutputPlan& outputs() { return outputs_; }
    const OutputPlan& outputs() const { return outputs_; }
    const ParameterSet& parameters() const { return parameters_; }
    /// The compared outputs are read from now on, or no more.
    void compare(bool outputs) { reads_.compare(outputs); }

    /// Outputs before inputs. As an output is written once a round at most, one that changes all the time
    /// takes no more than its own share of the cycle. Nothing: the round is over.
    std::optional<Transaction> next(Instant now);
    std::optional<Transaction> next_read(Instant now);
    /// How long the round before took; nothing where nothing was read for the master.
    std::optional<std::chrono::nanoseconds> begin_round(Instant now);
    Instant next_due() const { return std::min(outputs_.next_due(), reads_.next_due()); }

    struct Tries {
        int retries = 0;
        bool is_last = false; ///< without an answer the drive is lost
    };
    /// What became of the transaction given last. `compares`: a read shows what became of the outputs. True:
    /// a value or a state of an input changed.
    bool done(const Transaction& transaction, const Outcome& outcome, Tries tries, bool compares,
              Instant now);
    /// The transaction given last was not asked, or its answer is not proven: once more in a later round.
    void defer(const Transaction& transaction, Instant now);
    /// The row is contradicted by `answer`: it is neither read nor written any more.
    void contradict(const Tag* row, std::string_view answer);
    void hold_reads() { reads_.hold_all(); } ///< the drive has not answered, whatever it was asked
    void drive_lost();
    void drive_returned(Instant now);
    void port_changed(); ///< it may be another drive

private:
    /// What the transaction under way is for.
    struct Job {
        std::uint32_t layout = 0; ///< serial_ when it was given
        ReadPlan::Block block{};
        Instant began{};
    };

    void begin(Instant now);
    bool done_read(const Outcome& outcome, Tries tries, bool compares, Instant now);
    void done_write(AccessError error, Tries tries, Instant now);
    void compare(const Outcome& outcome);

    std::uint32_t serial_ = 0; ///< counts layouts
    ParameterSet parameters_;
    ReadPlan reads_;
    OutputPlan outputs_;
    NotUnderstood reads_not_understood_;
    NotUnderstood outputs_not_understood_;
    Job job_;
    bool in_round_ = false; ///< something was read for the master since the round began
    std::optional<Instant> round_began_;
};

} // namespace dpslave::drive
