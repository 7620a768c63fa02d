// SPDX-License-Identifier: Apache-2.0
#include "config_file.hpp"

namespace dpslave::app {

namespace {

constexpr std::chrono::seconds kLookInterval{1};

} // namespace

ConfigFile::ConfigFile(const config::Config& present, std::filesystem::path profiles, Instant now)
    : file_(present.file), profiles_(std::move(profiles)), next_look_(now + kLookInterval)
{
    note(present);
}

void ConfigFile::note(const config::Config& read)
{
    for (const config::StationConfig& one : read.stations) addresses_[one.name] = one.address;
}

Result<config::Config, input::Faults> ConfigFile::load()
{
    auto config = config::load_config(file_, profiles_);
    addresses_.clear();
    if (config) note(*config);
    return config;
}

void ConfigFile::on_time(Instant now)
{
    if (now < next_look_) return;
    next_look_ = now + kLookInterval;
    std::error_code gone;
    const auto written = std::filesystem::last_write_time(file_, gone);
    if (gone || written == written_) return;
    written_ = written;
    static_cast<void>(load());
}

std::optional<std::uint8_t> ConfigFile::address_of(const std::string& station) const
{
    const auto found = addresses_.find(station);
    return found != addresses_.end() ? std::optional{found->second} : std::nullopt;
}

} // namespace dpslave::app
