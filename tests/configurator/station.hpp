// SPDX-License-Identifier: Apache-2.0
/// A station that runs, and a file that is judged against it.
#pragma once

#include "page.hpp"

#include "dpslave/configurator/station_check.hpp"

#include <string>
#include <utility>

namespace dpslave::test {

/// A 620 that was never asked, at 187.5 kbit/s.
inline configurator::RunningStation unwinder()
{
    configurator::RunningStation station{"unwinder", "620", "ei-ascii", {.ident = 0x0533}, 187'500};
    for (const auto& [baud, bits] : {std::pair{9600U, 60U},
                                     {19'200U, 60U},
                                     {93'750U, 60U},
                                     {187'500U, 60U},
                                     {500'000U, 100U},
                                     {1'500'000U, 150U}})
        station.rates.emplace_back(baud, bits);
    return station;
}

/// The reply. `table` may be "mine.csv".
inline json judge(const std::string& file, const configurator::RunningStation& station,
                  const std::string& table = "")
{
    const input::TextSource source = [](const std::string& name) -> Result<std::string, Unreadable> {
        if (name == "mine.csv")
            return std::string{"tag,name,type,decimals,access\n55,Speed,INT,2,ro\n57,Torque,INT,,rw\n"
                               "58,Mode,WORD,,rw\n"};
        return shipped(name);
    };
    return json::parse(configurator::reply_of(configurator::check_with_station(
        {source, "profiles", {}}, file, "UNWI0533.GSD", false, station, table)));
}

/// The GSD file of a mapping with this list.
inline std::string file_of(const json& list, const std::string& profile = "620")
{
    return made_file({{"profile", profile}, {"list", list}});
}

} // namespace dpslave::test
