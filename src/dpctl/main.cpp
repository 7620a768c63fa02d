// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/cli.hpp"

#include "dpslave/arguments/standard_descriptors.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

namespace {

std::string_view environment(const char* name)
{
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

/// https://no-color.org: a value that is not empty forbids colours.
bool takes_colours()
{
    return environment("NO_COLOR").empty() && environment("TERM") != "dumb";
}

bool has_cursor()
{
    return !environment("TERM").empty() && environment("TERM") != "dumb";
}

/// The first of them that is set counts. Source: POSIX, 8.2 Internationalization Variables.
bool is_utf8()
{
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
        const std::string_view value = environment(name);
        if (value.empty()) continue;
        return value.find("UTF-8") != value.npos || value.find("utf8") != value.npos;
    }
    return false;
}

constexpr std::size_t kUsualWidth = 80;
constexpr std::size_t kWidest = 1000;

/// What is printed fits 80 columns; a wider terminal is used. In a pipe COLUMNS says how wide it is.
std::size_t width_of_terminal()
{
    winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0)
        return std::max<std::size_t>(size.ws_col, kUsualWidth);
    const std::string columns{environment("COLUMNS")};
    return std::clamp<std::size_t>(std::strtoul(columns.c_str(), nullptr, 10), kUsualWidth, kWidest);
}

} // namespace

int main(int argc, char** argv)
{
    dpslave::arguments::fill_standard_descriptors();
    const bool tty = ::isatty(STDOUT_FILENO) == 1;
    const bool can_ask = ::isatty(STDIN_FILENO) == 1 && (tty || ::isatty(STDERR_FILENO) == 1);
    dpslave::dpctl::Terminal terminal{
        std::cout,           std::cerr,           tty,       tty && takes_colours(),
        width_of_terminal(), tty && has_cursor(), is_utf8(), can_ask ? &std::cin : nullptr};
    return dpslave::dpctl::run({argv + 1, argv + argc}, terminal);
}
