// SPDX-License-Identifier: Apache-2.0
#include "drive_line.hpp"

#include <fmt/format.h>

namespace dpslave::app {

std::string stall_words(const DriveLine& line, std::chrono::nanoseconds length)
{
    const std::string_view call = io::name(line.link.sign->call());
    return fmt::format("line {} has stalled{}{} for {:.1f} s", line.config.name, call.empty() ? "" : " in ",
                       call, std::chrono::duration<double>(length).count());
}

} // namespace dpslave::app
