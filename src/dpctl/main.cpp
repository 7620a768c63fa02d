// SPDX-License-Identifier: Apache-2.0
#include "cli.hpp"

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

int main(int argc, char** argv)
{
    const bool tty = ::isatty(STDOUT_FILENO) == 1;
    dpslave::dpctl::Terminal terminal{std::cout, std::cerr, tty, tty && std::getenv("NO_COLOR") == nullptr};
    return dpslave::dpctl::run(std::vector<std::string>(argv + 1, argv + argc), terminal);
}
