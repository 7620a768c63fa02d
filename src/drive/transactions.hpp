// SPDX-License-Identifier: Apache-2.0
/// Tells what a transaction asks, and what its answer says of a single word: whether it was read or written,
/// and whether a read after a write proves it.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <optional>

namespace dpslave::drive {

inline Transaction read_of(Purpose purpose, const Tag* row)
{
    Transaction transaction;
    transaction.kind = Transaction::Kind::read;
    transaction.purpose = purpose;
    transaction.tag = row;
    return transaction;
}

/// `words` is valid until the transaction is done.
inline Transaction write_of(Purpose purpose, const Tag* row, std::span<const std::uint16_t> words)
{
    Transaction transaction = read_of(purpose, row);
    transaction.kind = Transaction::Kind::write;
    transaction.count = static_cast<std::uint16_t>(words.size());
    transaction.words = words;
    transaction.once = row->once && words.size() == 1;
    return transaction;
}

inline bool is_cyclic(Purpose purpose)
{
    return purpose == Purpose::input || purpose == Purpose::output || purpose == Purpose::watch;
}

inline bool is_write(const Transaction& transaction)
{
    return transaction.kind == Transaction::Kind::write;
}

/// The word that was read or written.
inline std::uint16_t word_of(const Transaction& transaction, const Outcome& outcome)
{
    if (is_write(transaction)) return transaction.words.front();
    return outcome.error == AccessError::none ? outcome.words.front() : std::uint16_t{0};
}

/// Returns the result of a write that counts: if its answer is missing, the result of a sent write is
/// unknown; a write that was not sent is made later.
inline AccessError end_of_once(const Outcome& outcome)
{
    const bool is_open = outcome.error == AccessError::no_answer || outcome.error == AccessError::deferred ||
                         outcome.error == AccessError::not_understood;
    if (!is_open) return outcome.error;
    if (outcome.sent) return AccessError::not_known;
    return outcome.error == AccessError::no_answer ? outcome.error : AccessError::deferred;
}

/// Returns what the read after a write says of it; nullopt if the drive holds another word. A tag that the
/// drive accepts but does not give (EE 04) cannot be proven.
inline std::optional<AccessError> proof_of(std::uint16_t written, const Outcome& outcome)
{
    if (outcome.error == AccessError::unsupported_type) return AccessError::none;
    if (outcome.error == AccessError::none && outcome.words.front() != written) return std::nullopt;
    return outcome.error;
}

/// A transaction that the drive did not understand is repeated like one without an answer. If that does not
/// help it is postponed: the drive is there, and the others go on.
class RetryAfterGarble {
public:
    /// Returns true if this transaction is repeated now.
    bool is_repeated(AccessError error, int retries)
    {
        in_a_row_ = error == AccessError::not_understood ? in_a_row_ + 1 : 0;
        if (in_a_row_ <= retries) return in_a_row_ > 0;
        in_a_row_ = 0;
        return false;
    }
    void reset() { in_a_row_ = 0; }

private:
    int in_a_row_ = 0;
};

} // namespace dpslave::drive
