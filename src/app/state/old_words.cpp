// SPDX-License-Identifier: Apache-2.0
#include "old_words.hpp"

namespace dpslave::app {

void make_old(drive::DriveSnapshot& drive, drive::WhenLost when)
{
    drive.known = true;
    drive.answers = false;
    for (std::size_t k = 0; k < drive.states.size(); ++k) {
        if (drive.states[k] != WordState::good) continue;
        drive.states[k] = WordState::stale;
        drive.errors[k] = AccessError::no_answer;
        drive.repeated[k] = false;
    }
    for (drive::Watched& one : drive.watched)
        if (one.state == WordState::good) one.state = WordState::stale;
    if (when == drive::WhenLost::hold) return;
    drive.presence = drive::DrivePresence::gone;
    drive.away = when == drive::WhenLost::silent;
}

} // namespace dpslave::app
