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

    /// Sets another layout; the result of a transaction of the former one is dropped.
    void reset(ParameterSet parameters, bool drive_is_lost);
    /// Exchanges the rows of the same layout. The former ones still exist.
    void exchange(ParameterSet parameters, std::chrono::nanoseconds refresh, bool drive_is_lost);

    OutputPlan& outputs() { return outputs_; }
    const OutputPlan& outputs() const { return outputs_; }
    const ParameterSet& parameters() const { return parameters_; }
    /// The compared outputs are read from now on, or no more.
    void compare(bool outputs) { reads_.compare(outputs); }

    /// Outputs before inputs. An output is written once a round at most, so one that changes all the time
    /// takes no more than its own share of the cycle. nullopt means that the round is over.
    std::optional<Transaction> next(Instant now);
    std::optional<Transaction> next_read(Instant now);
    /// Returns how long the round before took; nullopt if nothing was read for the master.
    std::optional<std::chrono::nanoseconds> begin_round(Instant now);
    Instant next_due() const { return std::min(outputs_.next_due(), reads_.next_due()); }

    /// The parameters of the read given last have a word of this layout, and need no new one since the drive
    /// was lost.
    bool was_read() const;

    struct Tries {
        int retries = 0;
        bool is_last = false; ///< without an answer the drive is lost
    };
    /// Takes the result of the transaction given last. `compares`: reads show whether the outputs were
    /// accepted. Returns true if a value or a state of an input changed.
    bool done(const Transaction& transaction, const Outcome& outcome, Tries tries, bool compares,
              Instant now);
    /// The transaction given last was not asked, or its answer is not proven: once more in a later round.
    void defer(const Transaction& transaction, Instant now);
    /// The row is contradicted by `answer`: it is neither read nor written any more.
    void contradict(const Tag* row, std::string_view answer);
    void hold_reads() { reads_.hold_all(); } ///< the drive has not answered, whatever it was asked
    void drive_lost();
    /// Sets whether each input counts as tried when the drive is lost; else it is to be read after its
    /// return.
    void loss_is_a_result(bool is_result) { loss_is_a_result_ = is_result; }
    void drive_returned(Instant now);
    void port_changed(); ///< it may be another drive

private:
    /// The purpose of the transaction under way.
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
    bool loss_is_a_result_ = true;
    ParameterSet parameters_;
    ReadPlan reads_;
    OutputPlan outputs_;
    RetryAfterGarble retry_reads_;
    RetryAfterGarble retry_outputs_;
    Job job_;
    bool in_round_ = false; ///< something was read for the master since the round began
    std::optional<Instant> round_began_;
};

} // namespace dpslave::drive
