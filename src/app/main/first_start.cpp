// SPDX-License-Identifier: Apache-2.0
#include "first_start.hpp"

#include <algorithm>
#include <fstream>

namespace dpslave::app {

bool has_new_default(const config::Config& config)
{
    return std::any_of(
        config.stations.begin(), config.stations.end(),
        [](const config::StationConfig& station) { return station.loss.when == drive::WhenLost::silent; });
}

std::optional<std::string> first_start_words(const std::filesystem::path& state)
{
    const std::filesystem::path said = state / "said-when-drive-lost";
    std::error_code ignored;
    if (std::filesystem::exists(said, ignored)) return std::nullopt;
    std::ofstream{said} << "The default of when_drive_lost was named in the log.\n";
    return "A drive that is switched off takes its station off the bus, as the old board did: when_drive_lost is \"silent\" by default. A CPU without OB86 then stops. when_drive_lost = \"hold\" under [[station]] keeps the last values as before; docs/guide/master.md says how to choose.";
}

} // namespace dpslave::app
