// SPDX-License-Identifier: Apache-2.0
#include "dpslave/arguments/standard_descriptors.hpp"

#include "dpslave/arguments/exit_status.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace dpslave::arguments {

/// open() gives the lowest number that is free: all three, from where on the first is missing.
void fill_standard_descriptors()
{
    for (int wanted = STDIN_FILENO; wanted <= STDERR_FILENO; ++wanted) {
        if (::fcntl(wanted, F_GETFD) >= 0) continue;
        int got = ::open("/dev/null", O_RDONLY | O_NOCTTY);
        if (got < 0) got = ::open("/", O_RDONLY | O_DIRECTORY); // no /dev: a folder takes no octets either
        if (got != wanted) ::_exit(kNo);
    }
}

} // namespace dpslave::arguments
