// SPDX-License-Identifier: Apache-2.0
#include "scenario.hpp"

#include "support/paths.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace captures {
namespace {

const std::string kFolder = dpslave::test::source_path("tests/captures/");
const std::string kEnding = ".pcapng";

Station station_of(const std::string& name)
{
    const std::string shipped = dpslave::test::source_path("config/profiles");
    for (const Station& station :
         {Station{"590", "590", 0x0533, 8, shipped}, Station{"6053", "605", 0x1649, 8, shipped},
          Station{"2400f", "2408f", 0x4242, 8, shipped},
          Station{"example", "example", 0x4711, 5, kFolder + "stations/profiles"}})
        if (name.starts_with(station.name + "-")) return station;
    throw std::runtime_error{name + ": its name does not begin with that of a station"};
}

std::vector<Scenario> scenarios_in(const std::string& folder)
{
    std::vector<Scenario> made;
    for (const auto& entry : std::filesystem::directory_iterator{kFolder + folder}) {
        if (entry.path().extension() != kEnding) continue;
        const std::string name = entry.path().stem();
        made.push_back({.folder = folder, .name = name, .station = station_of(name), .before = {}});
        Scenario& scenario = made.back();
        if (scenario.is_recorded() && name.ends_with("-sync-freeze"))
            scenario.before =
                kFolder + folder + "/" + scenario.station.name + "-more-identifiers-than-tags" + kEnding;
    }
    return made;
}

} // namespace

std::string Scenario::path() const
{
    return kFolder + folder + "/" + name + kEnding;
}

const std::vector<Scenario>& all_scenarios()
{
    static const std::vector<Scenario> all = [] {
        std::vector<Scenario> made;
        for (const char* folder : {"foreign", "worked", "found"}) {
            std::vector<Scenario> some = scenarios_in(folder);
            std::sort(some.begin(), some.end(),
                      [](const Scenario& a, const Scenario& b) { return a.name < b.name; });
            made.insert(made.end(), some.begin(), some.end());
        }
        return made;
    }();
    return all;
}

const Scenario& scenario(const std::string& name)
{
    for (const Scenario& one : all_scenarios())
        if (one.name == name) return one;
    throw std::runtime_error{"there is no capture " + name};
}

std::string folder_of_stations()
{
    return kFolder + "stations/";
}

dpslave::pcapng::Capture read_capture(const std::string& path)
{
    std::ifstream file{path, std::ios::binary};
    const std::vector<std::uint8_t> octets{std::istreambuf_iterator<char>{file}, {}};
    auto capture = dpslave::pcapng::read(octets);
    if (!capture) throw std::runtime_error{path + ": " + capture.error()};
    return *std::move(capture);
}

std::string test_name_of(const Scenario& scenario)
{
    std::string name;
    bool is_first = true;
    for (const char c : scenario.folder + "-" + scenario.name) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) == 0) {
            is_first = true;
            continue;
        }
        name += is_first ? static_cast<char>(std::toupper(letter)) : c;
        is_first = false;
    }
    return name;
}

} // namespace captures
