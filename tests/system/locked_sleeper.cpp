// SPDX-License-Identifier: Apache-2.0
// Locks its memory and sleeps: linked with the libraries of the daemon it is what these alone take.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>

int main()
{
    std::puts(::mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? "locked" : "refused");
    std::fflush(stdout);
    ::pause();
}
