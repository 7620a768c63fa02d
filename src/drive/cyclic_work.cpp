// SPDX-License-Identifier: Apache-2.0
#include "cyclic_work.hpp"

#include <utility>

namespace dpslave::drive {

CyclicWork::CyclicWork(ParameterSet parameters, BlockRule rule, OutputPlan::Rule outputs)
    : parameters_(std::move(parameters)), reads_(rule), outputs_(outputs)
{
    reads_.reset(parameters_);
}

void CyclicWork::reset(ParameterSet parameters, bool drive_is_lost)
{
    ++serial_;
    parameters_ = std::move(parameters);
    reads_.reset(parameters_);
    outputs_.reset(parameters_);
    if (drive_is_lost) drive_lost();
    retry_reads_.reset();
    retry_outputs_.reset();
    in_round_ = false;
    round_began_.reset();
}

void CyclicWork::exchange(ParameterSet parameters, std::chrono::nanoseconds refresh, bool drive_is_lost)
{
    parameters.take_over(parameters_);
    reads_.exchange(parameters);
    outputs_.exchange(parameters, refresh);
    parameters_ = std::move(parameters); // the records stay where they are
    if (drive_is_lost) parameters_.readings_lost(loss_is_a_result_);
}

std::optional<Transaction> CyclicWork::next(Instant now)
{
    if (!round_began_) round_began_ = now;
    const auto output = outputs_.start(now);
    if (!output) return next_read(now);
    begin(now);
    return write_of(Purpose::output, output->row, output->words);
}

std::optional<Transaction> CyclicWork::next_read(Instant now)
{
    const auto block = reads_.next(now);
    if (!block) return std::nullopt;
    begin(now);
    job_.block = *block;
    const Purpose purpose = reads_.purpose_of(*block);
    in_round_ = in_round_ || purpose != Purpose::watch;
    Transaction transaction = read_of(purpose, reads_.parameter(block->first).row);
    transaction.count = reads_.count_of(*block);
    return transaction;
}

void CyclicWork::begin(Instant now)
{
    if (!round_began_) round_began_ = now;
    job_.layout = serial_;
    job_.began = now;
}

std::optional<std::chrono::nanoseconds> CyclicWork::begin_round(Instant now)
{
    std::optional<std::chrono::nanoseconds> took;
    if (in_round_ && round_began_) took = now - *round_began_;
    round_began_ = now;
    in_round_ = false;
    reads_.begin_round(now);
    outputs_.begin_round();
    return took;
}

bool CyclicWork::done(const Transaction& transaction, const Outcome& outcome, Tries tries, bool compares,
                      Instant now)
{
    if (job_.layout != serial_) return false; // of a layout that is gone
    if (!is_write(transaction)) return done_read(outcome, tries, compares, now);
    done_write(outcome.error, tries, now);
    return false;
}

bool CyclicWork::was_read() const
{
    if (job_.layout != serial_) return false;
    for (std::size_t i = job_.block.first; i <= job_.block.last; ++i) {
        const Reading& one = reads_.parameter(i).reading;
        if (!one.was_read() || !one.tried) return false;
    }
    return true;
}

bool CyclicWork::done_read(const Outcome& outcome, Tries tries, bool compares, Instant now)
{
    if (outcome.error == AccessError::no_answer) {
        if (tries.is_last) reads_.skip(job_.block); // lost on it: after the return another one goes first
        return false;
    }
    if (retry_reads_.is_repeated(outcome.error, tries.retries)) {
        reads_.hold(job_.block, outcome.error);
        return false;
    }
    const bool changed = reads_.done(job_.block, outcome, now);
    if (compares) compare(outcome);
    return changed;
}

/// The outputs with what the drive was found to hold.
void CyclicWork::compare(const Outcome& outcome)
{
    const std::uint16_t from = reads_.parameter(job_.block.first).row->number;
    for (std::size_t i = job_.block.first; i <= job_.block.last; ++i) {
        const DriveParameter& one = reads_.parameter(i);
        if (!one.reading.serves(kCompared)) continue;
        if (outcome.error == AccessError::none)
            outputs_.observed(one.row, outcome.words[static_cast<std::size_t>(one.row->number - from)],
                              job_.began);
        else if (job_.block.first == job_.block.last)
            outputs_.unreadable(one.row);
    }
}

/// A block is not repeated as such: single writes show what is wrong with which word.
void CyclicWork::done_write(AccessError error, Tries tries, Instant now)
{
    if (error == AccessError::no_answer) return outputs_.not_answered(tries.is_last);
    if (!outputs_.writes_block() && retry_outputs_.is_repeated(error, tries.retries))
        return outputs_.hold(error);
    outputs_.done(error, now);
}

void CyclicWork::defer(const Transaction& transaction, Instant now)
{
    if (job_.layout != serial_) return;
    if (is_write(transaction))
        outputs_.defer();
    else
        reads_.defer(job_.block, now);
}

void CyclicWork::contradict(const Tag* row, std::string_view answer)
{
    if (DriveParameter* const read = parameters_.find_read(row->number))
        reads_.refuse(*read, AccessError::contradicted, answer);
    outputs_.refuse(row, AccessError::contradicted);
}

void CyclicWork::drive_lost()
{
    in_round_ = false;
    parameters_.readings_lost(loss_is_a_result_);
    parameters_.writings_lost();
}

/// The outputs go before the rest of the reads.
void CyclicWork::drive_returned(Instant now)
{
    reads_.drive_returned(now);
    outputs_.drive_returned();
    outputs_.begin_round();
    round_began_.reset();
}

void CyclicWork::port_changed()
{
    reads_.drive_returned(kAtOnce);
    outputs_.port_changed();
    outputs_.begin_round();
    round_began_.reset();
}

} // namespace dpslave::drive
