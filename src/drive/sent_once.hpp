// SPDX-License-Identifier: Apache-2.0
/// Keeps the word sent last to each parameter of one drive of which each write counts (column `once`), in
/// this layout or before, for as long as the daemon runs.
#pragma once

#include "parameter.hpp"

#include "dpslave/drive/tag.hpp"

#include <map>

namespace dpslave::drive {

class SentOnce {
public:
    void note(const Tag& row, std::uint16_t word, AccessError error, Instant now)
    {
        last_.insert_or_assign(row.number, Sent{row, word, error, now});
    }
    void forget(const Tag& row) { last_.erase(row.number); }
    /// False where the row says nothing of it, or now asks something else than then.
    bool was(const Tag& row, std::uint16_t word) const
    {
        const Sent* const sent = find(row);
        return sent != nullptr && sent->word == word;
    }
    /// Shows in `writing` the result of the last word: it is not sent again, so nothing else shows it.
    void show(const Tag& row, Writing& writing) const
    {
        const Sent* const sent = find(row);
        if (sent == nullptr || !writing.asked) return;
        writing.word = sent->word;
        writing.updated_at = sent->at;
        writing.answered(sent->error);
    }

private:
    struct Sent {
        Tag row; ///< as it was then
        std::uint16_t word = 0;
        AccessError error = AccessError::none; ///< or not_known, or a refusal
        Instant at{};
    };
    const Sent* find(const Tag& row) const
    {
        const auto sent = last_.find(row.number);
        const bool is_same = row.once && sent != last_.end() && is_same_value(sent->second.row, row);
        return is_same ? &sent->second : nullptr;
    }

    std::map<std::uint16_t, Sent> last_; ///< by tag
};

} // namespace dpslave::drive
