// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/carry_out.hpp"

namespace dpslave::drive {

Outcome carry_out(const Transaction& transaction, Backend& backend, const UnitAddress& drive,
                  std::span<std::uint16_t> words)
{
    using Kind = Transaction::Kind;
    Outcome outcome;
    switch (transaction.kind) {
        case Kind::read:
            outcome.words = words.first(transaction.count);
            outcome.error = backend.read(drive, *transaction.tag, words.first(transaction.count));
            outcome.answer = backend.last_answer();
            outcome.may_be_older = backend.may_be_older();
            break;
        case Kind::write:
            outcome.error = transaction.once
                                ? backend.write_once(drive, *transaction.tag, transaction.words.first<1>())
                                : backend.write(drive, *transaction.tag, transaction.words);
            outcome.sent = backend.has_sent();
            break;
        case Kind::probe: outcome.error = backend.probe(drive); break;
    }
    outcome.questions = backend.questions();
    return outcome;
}

} // namespace dpslave::drive
