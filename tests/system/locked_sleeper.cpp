// SPDX-License-Identifier: Apache-2.0
// Locks its memory and sleeps: linked with the libraries of the daemon it is what these alone take. With an
// argument it ends at once: what the start of a program with them takes.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>

int main(int count, char**)
{
    if (count > 1) return 0;
    std::puts(::mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? "locked" : "refused");
    std::fflush(stdout);
    ::pause();
}
