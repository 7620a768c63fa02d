// SPDX-License-Identifier: Apache-2.0
#include "drive_line.hpp"

#include <fmt/format.h>

namespace dpslave::app {

void DriveLine::answered_until(std::uint32_t number)
{
    if (static_cast<std::int32_t>(number - link.withdrawn.load()) > 0) link.withdrawn.store(number);
}

std::uint32_t DriveLine::withdraw(std::uint32_t until)
{
    link.sign->give_up();
    answered_until(until);
    return link.operating.load();
}

std::string stall_words(const DriveLine& line, std::chrono::nanoseconds length)
{
    const std::string_view call = io::name(line.link.sign->call());
    return fmt::format("line {} has stalled{}{} for {:.1f} s", line.config.name, call.empty() ? "" : " in ",
                       call, std::chrono::duration<double>(length).count());
}

} // namespace dpslave::app
