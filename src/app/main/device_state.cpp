// SPDX-License-Identifier: Apache-2.0
#include "device_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dpslave::app {

using profile::DiagForm;

namespace {

constexpr int kHighestAddress = 125;

tec::TripForm trip_form(const config::StationConfig& config)
{
    const bool is_code =
        config.profile->diagnosis != DiagForm::tripped && config.tec && config.tec->trip.is_code;
    return is_code ? tec::TripForm::code : tec::TripForm::tripped;
}

constexpr std::string_view kRideThroughWarning =
    "Setting the RIDE THROUGH parameter to anything other than zero could compromise safety: the outputs "
    "outlive the connection to the master.";

std::string listed(const std::vector<std::string_view>& names)
{
    std::string all;
    for (const std::string_view name : names) all.append(all.empty() ? "" : ", ").append(name);
    return all;
}

/// The names of those that can be set.
std::string inputs_of(const std::array<tec::Row, 10>& rows)
{
    std::vector<std::string_view> names;
    for (const tec::Row& row : rows)
        if (row.is_input) names.push_back(row.name);
    return listed(names);
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
            return listed(tec::inputs_out_of_range(settings)) +
                   " is out of range: set what the range beside it allows.";
        case OptionFault::type_mismatch:
            return "TYPE is not PROFIBUS DP: set TYPE to 2, then ADDRESS, then look at FAULT again.";
        case OptionFault::self_test:
            return "The self-test at the start has failed: start dpslaved again; its log says what failed.";
        case OptionFault::hardware:
            return "The port of the bus or of the drive line is gone, or the driver enable does not work: "
                   "look "
                   "at the adapters and their cables, and at the GPIO chip; the log names which it is, and "
                   "it "
                   "is opened again as soon as it returns.";
        case OptionFault::missing: return "There is no option: see what the log says about the ports.";
    }
    return "";
}

} // namespace

DeviceState::DeviceState(const config::StationConfig& config, bool self_test_passed)
    : config_(&config), address_(config.address)
{
    hardware_.self_test_passed = self_test_passed;
    if (config.tec) {
        settings_ = config.tec->start;
        fault_ = tec::fault(settings_, hardware_);
    }
    for (const std::uint16_t tag : config.watched) seen_.push_back({.tag = tag});
}

void DeviceState::adopt(const config::StationConfig& config)
{
    if (config.tec && config_->tec) {
        const tec::Settings& before = config_->tec->start;
        const tec::Settings& now = config.tec->start;
        for (const auto input :
             {&tec::Settings::type, &tec::Settings::address, &tec::Settings::ext_diagnostic,
              &tec::Settings::int_diag_select, &tec::Settings::ride_through, &tec::Settings::unused_1})
            if (before.*input != now.*input) settings_.*input = now.*input;
    }
    std::vector<Seen> before = std::exchange(seen_, {});
    for (const std::uint16_t tag : config.watched) {
        const auto known =
            std::find_if(before.begin(), before.end(), [tag](const Seen& one) { return one.tag == tag; });
        seen_.push_back(known != before.end() ? *known : Seen{.tag = tag});
    }
    config_ = &config;
}

void DeviceState::look(const Station& station, const BusSnapshot& bus)
{
    look_at_drive(station.drive);
    condition_.data_exchange = station.bus.state == dp::State::data_exch && !station.bus.holds;
    condition_.drive_answers = station.line_open && (!station.drive.known || station.drive.answers);
    condition_.running = station.bus.state != dp::State::power_on;
    say_status();
    say_scales(station);
    if (!config_->tec) return;

    const config::TecConfig& tec = *config_->tec;
    if (tec.ext_diagnostic_tag != 0) settings_.ext_diagnostic = word_of(tec.ext_diagnostic_tag);
    if (settings_.address >= 0 && settings_.address <= kHighestAddress)
        address_ = static_cast<std::uint8_t>(settings_.address);
    hardware_.ports_open = station.line_open && bus.port_open && bus.driver_works;
    hardware_.baud_search = !hears_the_bus(bus);
    fault_ = tec::fault(settings_, hardware_);
    network_ = tec::network_state(fault_, hardware_, station.bus, station.drive);
    int_diagnostic_ = tec::int_diagnostic(settings_.int_diag_select, station.bus, station.drive);
    condition_.running = bus.valid; // its lamps also show why it is silent
    condition_.fault = fault_;
    condition_.network = network_;
    condition_.health = mirrored(tec.health);
    condition_.run = mirrored(tec.run);
    const bool began = fault_ != OptionFault::none || station.bus.state != dp::State::power_on;
    if (bus.valid && began) say_fault();
    say_trip();
}

void DeviceState::look_at_drive(const drive::UnitSnapshot& drive)
{
    for (std::size_t i = 0; i < seen_.size() && i < drive.watched.size(); ++i) {
        const drive::Watched& now = drive.watched[i];
        if (now.tag != seen_[i].tag) continue; // of the drive side before a reload that watches others
        seen_[i].is_current = (now.state == WordState::good || now.repeated) && drive.answers;
        if (now.state != WordState::good && now.state != WordState::stale) continue;
        seen_[i].word = now.word;
        seen_[i].was_read = true;
    }
}

const DeviceState::Seen* DeviceState::seen(std::uint16_t tag) const
{
    const auto found =
        std::find_if(seen_.begin(), seen_.end(), [tag](const Seen& one) { return one.tag == tag; });
    return found != seen_.end() ? &*found : nullptr;
}

std::uint16_t DeviceState::word_of(std::uint16_t tag) const
{
    const Seen* const one = seen(tag);
    return one != nullptr ? one->word : std::uint16_t{0};
}

/// On is good: a lamp of a drive that does not answer is dark.
bool DeviceState::mirrored(const profile::MirroredLamp& lamp) const
{
    const Seen* const one = seen(lamp.tag);
    if (one == nullptr || !one->is_current) return false;
    return ((one->word & lamp.mask) != 0) != lamp.inverted;
}

BusOrders DeviceState::bus_orders() const
{
    BusOrders orders;
    orders.enabled = fault_ == OptionFault::none && hardware_.self_test_passed;
    orders.address = address_;
    switch (config_->profile->diagnosis) {
        case DiagForm::none: return orders;
        case DiagForm::trip_code:
        case DiagForm::tripped:
            orders.ext_diag.assign(tec::ext_diag(trip_form(*config_), trip_word(),
                                                 static_cast<std::uint16_t>(settings_.ext_diagnostic)));
            break;
        case DiagForm::status_word:
            orders.ext_diag.push(3); // header: a device-related block of three octets, this one included
            orders.ext_diag.push16(word_of(config_->status_tag));
            break;
    }
    orders.ext_diag_fault = config_->ext_diag_bit && reports_a_fault();
    return orders;
}

/// Null: nothing is known of the trip.
const DeviceState::Seen* DeviceState::seen_trip() const
{
    const Seen* const one = config_->tec ? seen(config_->tec->trip.bit.tag) : nullptr;
    return one != nullptr && one->was_read ? one : nullptr;
}

/// As tec::ext_diag() takes it. What is not known is no trip, also where the bit says "healthy".
std::uint16_t DeviceState::trip_word() const
{
    const Seen* const one = seen_trip();
    if (one == nullptr) return 0;
    if (trip_form(*config_) == tec::TripForm::code) return one->word;
    const bool is_set = (one->word & config_->tec->trip.bit.mask) != 0;
    return is_set != config_->tec->trip.bit.inverted ? std::uint16_t{1} : std::uint16_t{0};
}

std::uint8_t DeviceState::trip_octet() const
{
    return tec::ext_diag(trip_form(*config_), trip_word(), 0)[1];
}

bool DeviceState::reports_a_fault() const
{
    if (config_->profile->diagnosis == DiagForm::status_word)
        return (word_of(config_->status_tag) & config_->profile->fault_mask) != 0;
    return trip_octet() != 0;
}

std::int64_t DeviceState::zero_after_ms() const
{
    return to_ms(config_->tec ? tec::zero_after(settings_) : config_->zero_after);
}

std::array<tec::Row, 10> DeviceState::rows() const
{
    return tec::rows(settings_, fault_, network_, int_diagnostic_);
}

std::optional<std::string> DeviceState::trip() const
{
    if (!config_->tec) return std::nullopt;
    const std::uint16_t tag = config_->tec->trip.bit.tag;
    if (tag == 0) return "not known: no tag has it; set trip_tag in [station.tec]";
    const Seen* const one = seen_trip();
    if (one == nullptr) return fmt::format("unknown: tag {} was never read", tag);
    const std::string words = tec::trip_words(trip_octet());
    if (!condition_.drive_answers) return words + " (the drive does not answer)";
    return one->is_current ? words : fmt::format("{} (tag {} can no longer be read)", words, tag);
}

std::optional<std::int64_t> DeviceState::trip_tag() const
{
    if (!config_->tec || config_->tec->trip.bit.tag == 0) return std::nullopt;
    return config_->tec->trip.bit.tag;
}

std::optional<bool> DeviceState::tripped() const
{
    return seen_trip() != nullptr ? std::optional{trip_octet() != 0} : std::nullopt;
}

std::string DeviceState::silent_because() const
{
    if (fault_ == OptionFault::none) return {};
    return fmt::format("FAULT is {}, the station is silent on the bus. {}", dpslave::text(fault_),
                       remedy(fault_, settings_));
}

std::vector<std::string> DeviceState::notes() const
{
    std::vector<std::string> notes;
    if (!config_->tec) return notes;
    if (settings_.ride_through != 0) notes.push_back(fmt::format("WARNING: {}", kRideThroughWarning));
    if (std::string why = silent_because(); !why.empty()) notes.push_back(std::move(why));
    if (settings_.address >= 0 && settings_.address <= 2)
        notes.push_back(
            fmt::format("ADDRESS {}: 0, 1 and 2 are usually reserved for PROFIBUS masters and should "
                        "be avoided.",
                        settings_.address));
    tec::Settings start = config_->tec->start;
    if (config_->tec->ext_diagnostic_tag != 0) {
        start.ext_diagnostic = settings_.ext_diagnostic;
        notes.push_back(
            fmt::format("EXT DIAGNOSTIC follows tag {} of the drive.", config_->tec->ext_diagnostic_tag));
    }
    if (settings_ != start)
        notes.emplace_back("Values that were set apply until the next start. To keep them, write them into "
                           "the configuration file.");
    return notes;
}

std::optional<std::string> DeviceState::set(std::string_view parameter, std::string_view value)
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
    if (named->name == "EXT DIAGNOSTIC" && config_->tec->ext_diagnostic_tag != 0)
        return fmt::format("it follows tag {} of the drive, as ext_diagnostic_tag in [station.tec] says",
                           config_->tec->ext_diagnostic_tag);
    std::swap(settings_, after);
    if (settings_.ride_through != after.ride_through) say_ride_through();
    return std::nullopt;
}

std::optional<std::uint8_t> DeviceState::address_after(std::string_view parameter,
                                                       std::string_view value) const
{
    tec::Settings after = settings_;
    const bool is_done = tec::set(after, parameter, value) == tec::SetResult::done;
    if (!is_done || after.address == settings_.address) return std::nullopt;
    if (after.address < 0 || after.address > kHighestAddress) return std::nullopt;
    return static_cast<std::uint8_t>(after.address);
}

std::optional<OptionFault> DeviceState::fault_after(std::string_view parameter, std::string_view value) const
{
    tec::Settings after = settings_;
    if (tec::set(after, parameter, value) != tec::SetResult::done) return std::nullopt;
    return tec::fault(after, hardware_);
}

std::vector<Sentence> DeviceState::take_news()
{
    return std::exchange(news_, {});
}

void DeviceState::say(bool is_warning, std::string text)
{
    news_.push_back({.is_warning = is_warning, .text = config_->name + ": " + std::move(text)});
}

void DeviceState::say_ride_through()
{
    if (settings_.ride_through == 0)
        say(false, "RIDE THROUGH is 0 again");
    else
        say(true, fmt::format("RIDE THROUGH is {}. {}", settings_.ride_through, kRideThroughWarning));
}

void DeviceState::say_fault()
{
    if (fault_ != fault_said_) {
        if (fault_ == OptionFault::none)
            say(false, "FAULT is NONE again");
        else
            say(true, fmt::format("FAULT is {}, the station is silent on the bus; {}", dpslave::text(fault_),
                                  remedy(fault_, settings_)));
        fault_said_ = fault_;
    }
    if (network_said_ != network_) {
        say(network_ == NetworkState::data_ex_error,
            fmt::format("NETWORK STATE is {}", dpslave::text(network_)));
        network_said_ = network_;
    }
}

void DeviceState::say_trip()
{
    const std::uint8_t now = trip_octet();
    if (now == trip_said_) return;
    trip_said_ = now;
    if (now == 0)
        say(false, "trip of the drive: none any more");
    else
        say(true, "trip of the drive: " + *trip());
}

/// Once for each set of tags: what holds the start, what reads 0, and what to do.
void DeviceState::say_scales(const Station& station)
{
    std::string now = scale_words(station).value_or("");
    if (station.bus.state != dp::State::data_exch) scales_said_.clear(); // nothing is chosen any more
    const bool is_known = station.bus.state == dp::State::data_exch && !station.bus.stat_diag &&
                          station.drive.generation == station.bus.layout.generation;
    if (now == scales_said_ || (now.empty() && !is_known)) return;
    if (now.empty())
        say(false, "every tag that the master has chosen has a scale");
    else
        say(true, now);
    scales_said_ = std::move(now);
}

void DeviceState::say_status()
{
    if (config_->profile->diagnosis != DiagForm::status_word) return;
    const std::uint16_t word = word_of(config_->status_tag);
    const auto faults = static_cast<std::uint16_t>(word & config_->profile->fault_mask);
    if (faults == status_said_) return;
    status_said_ = faults;
    if (faults == 0)
        say(false, "the instrument no longer reports an alarm or a fault");
    else
        say(true,
            fmt::format("the instrument reports {}", shown_value(*config_->tags, config_->status_tag, word)));
}

} // namespace dpslave::app
