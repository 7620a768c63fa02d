// SPDX-License-Identifier: Apache-2.0
#include "transaction_log.hpp"

#include "dpslave/report/words.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace dpslave::app {

void log_transaction(const std::string& line, const DriveUnit& unit, const drive::Transaction& transaction,
                     const drive::Outcome& outcome)
{
    if (!spdlog::should_log(spdlog::level::debug)) return;
    using Kind = drive::Transaction::Kind;
    const char* const kind = transaction.kind == Kind::read    ? "read"
                             : transaction.kind == Kind::write ? "write"
                                                               : "look for the drive";
    std::string what = transaction.tag == nullptr ? std::string{}
                       : transaction.count == 1
                           ? fmt::format(" tag {}", transaction.tag->number)
                           : fmt::format(" {} tags from {}", transaction.count, transaction.tag->number);
    const auto words = transaction.kind == Kind::write ? transaction.words : outcome.words;
    if (outcome.error == AccessError::none || transaction.kind == Kind::write)
        for (const std::uint16_t word : words) what += fmt::format(" {:04X}", word);
    spdlog::debug("line {}, {}: {}{}: {}", line, unit.config->name, kind, what,
                  outcome.error == AccessError::none ? "done" : report::text(outcome.error));
}

} // namespace dpslave::app
