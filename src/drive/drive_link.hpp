// SPDX-License-Identifier: Apache-2.0
/// Decides whether a drive answers, by the results of the transactions with it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

namespace dpslave::drive {

class DriveLink {
public:
    bool is_lost() const { return state_ == State::lost; }
    /// Is its next transaction likely to time out?
    bool is_in_doubt() const { return is_lost() || silences_ > 0; }
    /// It answered last.
    bool is_certain() const { return state_ == State::answers && silences_ == 0; }
    /// Returns whether the drive is lost if the present transaction has no answer, with the silences noted
    /// before.
    bool is_last_try(int retries) const { return silences_ + noted_ > retries; }

    /// Returns true if it was lost until now.
    bool answered()
    {
        const bool returns = is_lost();
        state_ = State::answers;
        silences_ = noted_ = 0;
        return returns;
    }
    /// `questions` stayed without an answer; they count with the next transaction that does. `heard`: a valid
    /// frame of the drive has come since the first of them.
    void note_unanswered(unsigned questions, bool heard)
    {
        noted_ = heard ? 1 : noted_ + static_cast<int>(std::max(questions, 1U));
    }
    /// The transaction, and what is noted. Returns true if the drive is now lost.
    bool not_answered(int retries)
    {
        silences_ += std::exchange(noted_, 0);
        if (is_lost() || silences_ <= retries) return false;
        lose();
        return true;
    }
    void lose()
    {
        state_ = State::lost;
        silences_ = noted_ = 0;
    }
    void port_changed() { *this = {}; } ///< it may be another drive

private:
    enum class State : std::uint8_t { unknown, answers, lost };

    State state_ = State::unknown;
    int silences_ = 0; ///< in a row
    int noted_ = 0;    ///< further questions without an answer
};

} // namespace dpslave::drive
