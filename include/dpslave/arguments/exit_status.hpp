// SPDX-License-Identifier: Apache-2.0
/// The exit statuses of dpctl and dpsim.
#pragma once

namespace dpslave::arguments {

enum Exit : int {
    kFine = 0,     ///< success, or the answer is yes
    kNo = 1,       ///< the answer is no, or an input or a reply is faulty
    kUsage = 2,    ///< the command line is wrong, or names what does not exist
    kNoDaemon = 3, ///< there is no daemon at the socket
    kNoAnswer = 4, ///< an answer did not come in time
    kRefused = 5,  ///< the daemon or the drive refused
};

/// The same for a person: the end of each help.
extern const char* const kExitTable;

} // namespace dpslave::arguments
