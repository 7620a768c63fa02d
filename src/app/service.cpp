// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/service.hpp"

#include "dpslave/profile/document.hpp"

namespace dpslave::app {

bool is_unconfigured(const std::filesystem::path& file)
{
    profile::Document document{file};
    if (!document.readable()) return false;
    const profile::Table root = document.root();
    return !root.has("bus") && !root.has("line") && !root.has("station");
}

std::optional<std::string> release_driver(const BusConfig& bus)
{
    return io::DriverEnable::release(bus.driver_enable, bus.port);
}

} // namespace dpslave::app
