// SPDX-License-Identifier: Apache-2.0
#include "tec_option.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace dpslave::app {

const std::string_view kRideThroughWarning =
    "Setting the RIDE THROUGH parameter to anything other than zero could compromise safety: the outputs outlive the connection to the master.";

namespace {

constexpr int kHighestAddress = 125;

/// The names of those that can be set.
std::string inputs_of(const std::array<tec::Row, 10>& rows)
{
    std::vector<std::string_view> names;
    for (const tec::Row& row : rows)
        if (row.is_input) names.push_back(row.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

/// False: "the slave has not detected valid communications". A fixed rate is not searched, and
/// noise or a wrong rate brings tokens and SC, but no telegram with a checksum.
bool hears_the_bus(const BusSnapshot& bus)
{
    if (bus.baud_state != fdl::BaudState::fixed) return bus.baud_state != fdl::BaudState::baud_search;
    const bool heard = bus.last_telegram != Instant{};
    return heard && bus.taken_at - bus.last_telegram < fdl::dwell_at(bus.baud);
}

/// What to do about FAULT; empty when there is none.
std::string remedy(OptionFault fault, const tec::Settings& settings)
{
    switch (fault) {
        case OptionFault::none: return "";
        case OptionFault::parameter:
            return fmt::format("{} is out of range: set what the range beside it allows.",
                               fmt::join(tec::inputs_out_of_range(settings), ", "));
        case OptionFault::type_mismatch:
            return "TYPE is not PROFIBUS DP: set TYPE to 2, then ADDRESS, then look at FAULT again.";
        case OptionFault::self_test:
            return "The self-test at the start has failed: start dpslaved again; its log says what failed.";
        case OptionFault::hardware:
            return "The port of the bus is gone, or its driver enable does not work: look at the adapter, its cable and the GPIO chip; the log names which, and it is opened again by itself.";
        case OptionFault::missing: return "There is no option: see what the log says about the ports.";
    }
    return "";
}

std::optional<std::uint8_t> address_of(const tec::Settings& settings)
{
    if (settings.address < 0 || settings.address > kHighestAddress) return std::nullopt;
    return static_cast<std::uint8_t>(settings.address);
}

} // namespace

TecOption::TecOption(const config::TecConfig& config, bool self_test_passed)
    : config_(&config), settings_(config.start)
{
    hardware_.self_test_passed = self_test_passed;
    fault_ = tec::fault(settings_, hardware_);
}

void TecOption::adopt(const config::TecConfig& config)
{
    const tec::Settings &before = config_->start, &now = config.start;
    for (const auto input :
         {&tec::Settings::type, &tec::Settings::address, &tec::Settings::ext_diagnostic,
          &tec::Settings::int_diag_select, &tec::Settings::ride_through, &tec::Settings::unused_1})
        if (before.*input != now.*input) settings_.*input = now.*input;
    config_ = &config;
}

void TecOption::update(const BusSnapshot& bus, const dp::Snapshot& station, const drive::DriveSnapshot& drive,
                       std::uint16_t ext_diagnostic)
{
    if (config_->ext_diagnostic_tag != 0) settings_.ext_diagnostic = ext_diagnostic;
    hardware_.bus_works = bus.port_open && bus.driver_works;
    hardware_.has_power = !drive.away;
    hardware_.baud_search = !hears_the_bus(bus);
    fault_ = tec::fault(settings_, hardware_);
    network_ = tec::network_state(fault_, hardware_, station, drive);
    int_diagnostic_ = tec::int_diagnostic(settings_.int_diag_select, station, drive);
}

OptionFault TecOption::fault_with_power() const
{
    tec::Hardware powered = hardware_;
    powered.has_power = true;
    return tec::fault(settings_, powered);
}

std::optional<std::uint8_t> TecOption::address() const
{
    return address_of(settings_);
}

std::array<tec::Row, 10> TecOption::rows() const
{
    return tec::rows(settings_, fault_, network_, int_diagnostic_);
}

std::string TecOption::fault_words() const
{
    if (fault_ == OptionFault::none) return {};
    return fmt::format("FAULT is {}, the station is silent on the bus. {}", dpslave::text(fault_),
                       remedy(fault_, settings_));
}

std::vector<std::string> TecOption::notes(std::string silent) const
{
    std::vector<std::string> notes;
    if (settings_.ride_through != 0) notes.push_back(fmt::format("WARNING: {}", kRideThroughWarning));
    if (!silent.empty()) notes.push_back(std::move(silent));
    if (settings_.address >= 0 && settings_.address <= 2)
        notes.push_back(fmt::format(
            "ADDRESS {}: 0, 1 and 2 are usually reserved for PROFIBUS masters and should be avoided.",
            settings_.address));
    tec::Settings start = config_->start;
    if (config_->ext_diagnostic_tag != 0) {
        start.ext_diagnostic = settings_.ext_diagnostic;
        notes.push_back(
            fmt::format("EXT DIAGNOSTIC follows tag {} of the drive.", config_->ext_diagnostic_tag));
    }
    if (settings_ != start)
        notes.emplace_back(
            "Values that were set apply until the next start. To keep them, write them into the configuration file.");
    return notes;
}

std::optional<std::string> TecOption::set(std::string_view parameter, std::string_view value)
{
    const auto all = rows();
    const auto named = std::find_if(
        all.begin(), all.end(), [parameter](const tec::Row& row) { return tec::is_called(row, parameter); });
    tec::Settings after = settings_;
    switch (tec::set(after, parameter, value)) {
        case tec::SetResult::done: break;
        case tec::SetResult::no_such_input:
            return "there is no such input; those that can be set are " + inputs_of(all);
        case tec::SetResult::is_output:
            return fmt::format("{} is an output; those that can be set are {}", named->name, inputs_of(all));
        case tec::SetResult::no_such_value:
            return fmt::format("it takes {}; a PC tool may set any number from -32768 to 65535",
                               named->range);
    }
    if (named->name == "EXT DIAGNOSTIC" && config_->ext_diagnostic_tag != 0)
        return fmt::format("it follows tag {} of the drive, as ext_diagnostic_tag in [station.tec] says",
                           config_->ext_diagnostic_tag);
    std::swap(settings_, after);
    if (settings_.ride_through != after.ride_through) ++ride_through_changes_;
    return std::nullopt;
}

std::optional<std::uint8_t> TecOption::address_after(std::string_view parameter, std::string_view value) const
{
    tec::Settings after = settings_;
    const bool is_done = tec::set(after, parameter, value) == tec::SetResult::done;
    return is_done && after.address != settings_.address ? address_of(after) : std::nullopt;
}

std::optional<OptionFault> TecOption::fault_after(std::string_view parameter, std::string_view value) const
{
    tec::Settings after = settings_;
    if (tec::set(after, parameter, value) != tec::SetResult::done) return std::nullopt;
    return tec::fault(after, hardware_);
}

} // namespace dpslave::app
