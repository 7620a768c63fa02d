// SPDX-License-Identifier: Apache-2.0
/// A transaction of the poller on a client, as the drive thread carries it out.
#pragma once

#include "dpslave/drive/poller.hpp"

namespace dpslave::drive::test {

/// `word`: room for what is read, which the outcome refers to.
inline Outcome carry_out(Backend& client, UnitAddress address, const Transaction& transaction,
                         std::span<std::uint16_t, 1> word)
{
    Outcome outcome;
    switch (transaction.kind) {
        case Transaction::Kind::read:
            outcome.error = client.read(address, *transaction.tag, word);
            outcome.words = word;
            outcome.answer = client.last_answer();
            break;
        case Transaction::Kind::write:
            outcome.error = client.write(address, *transaction.tag, transaction.words);
            break;
        case Transaction::Kind::probe: outcome.error = client.probe(address); break;
    }
    return outcome;
}

} // namespace dpslave::drive::test
