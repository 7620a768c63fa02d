// SPDX-License-Identifier: Apache-2.0
#include "dpslave/arguments/exit_status.hpp"

namespace dpslave::arguments {

const char* const kExitTable = "Exit status:\n"
                               "  0  success, or the answer is yes\n"
                               "  1  the answer is no, or an input or a reply is faulty\n"
                               "  2  wrong usage, or the command line names what does not exist\n"
                               "  3  no daemon\n"
                               "  4  no answer in time\n"
                               "  5  the daemon or the drive refused";

} // namespace dpslave::arguments
