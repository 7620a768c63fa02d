// SPDX-License-Identifier: Apache-2.0
/// Whether a drive answers, by what became of the transactions with it.
#pragma once

#include <cstdint>

namespace dpslave::drive {

class DriveLink {
public:
    bool is_lost() const { return state_ == State::lost; }
    /// Is its next transaction likely to time out?
    bool is_in_doubt() const { return is_lost() || silences_ > 0; }
    /// It answered last.
    bool is_certain() const { return state_ == State::answers && silences_ == 0; }
    /// The next transaction without an answer is the loss of the drive.
    bool is_last_try(int retries) const { return silences_ >= retries; }

    /// True: it was lost until now.
    bool answered()
    {
        const bool returns = is_lost();
        state_ = State::answers;
        silences_ = 0;
        return returns;
    }
    /// True: now it is lost.
    bool not_answered(int retries)
    {
        if (is_lost() || ++silences_ <= retries) return false;
        state_ = State::lost;
        silences_ = 0;
        return true;
    }
    void port_changed() { *this = {}; } ///< it may be another drive

private:
    enum class State : std::uint8_t { unknown, answers, lost };

    State state_ = State::unknown;
    int silences_ = 0; ///< in a row
};

} // namespace dpslave::drive
