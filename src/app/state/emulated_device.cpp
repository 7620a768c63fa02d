// SPDX-License-Identifier: Apache-2.0
#include "emulated_device.hpp"

#include "presence_words.hpp"

#include <fmt/format.h>

namespace dpslave::app {

using profile::DiagForm;

namespace {

tec::TripForm trip_form(const config::StationConfig& config)
{
    const bool is_code =
        config.profile->diagnosis != DiagForm::tripped && config.tec && config.tec->trip.is_code;
    return is_code ? tec::TripForm::code : tec::TripForm::tripped;
}

} // namespace

EmulatedDevice::EmulatedDevice(const config::StationConfig& config, bool self_test_passed)
    : config_(&config), self_test_passed_(self_test_passed), address_(config.address)
{
    if (config.tec) tec_.emplace(*config.tec, self_test_passed);
    watched_.watch(config.watched);
}

void EmulatedDevice::adopt(const config::StationConfig& config)
{
    if (config.tec && tec_) tec_->adopt(*config.tec);
    watched_.watch(config.watched);
    config_ = &config;
}

void EmulatedDevice::update(const Station& station, const BusSnapshot& bus)
{
    watched_.update(station.drive);
    condition_.data_exchange =
        station.bus.state == dp::State::data_exch && station.bus.hold == StartHold::none;
    is_away_ = station.drive.away;
    const bool answers = station.line_open && (!station.drive.known || station.drive.answers);
    condition_.drive_answers = answers && !is_away_;
    condition_.running = is_away_ || station.bus.state != dp::State::power_on;
    gone_ = gone_words(station);
    if (!tec_) return;

    tec_->update(bus, station.bus, station.drive, watched_.word_of(config_->tec->ext_diagnostic_tag));
    address_ = tec_->address().value_or(address_);
    condition_.running = bus.valid; // its lamps also show why it is silent
    condition_.fault = tec_->fault();
    condition_.network = tec_->network();
    condition_.health = mirrored(config_->tec->health);
    condition_.run = mirrored(config_->tec->run);
}

/// On is good: a lamp of a drive that does not answer is dark.
bool EmulatedDevice::mirrored(const profile::MirroredLamp& lamp) const
{
    const WatchedTags::Seen* const one = watched_.find(lamp.tag);
    if (one == nullptr || !one->is_current) return false;
    return ((one->word & lamp.mask) != 0) != lamp.inverted;
}

BusOrders EmulatedDevice::bus_orders() const
{
    BusOrders orders;
    orders.enabled = self_test_passed_ && (!tec_ || tec_->fault_with_power() == OptionFault::none);
    orders.address = address_;
    orders.drive_lost_after = config_->loss.after;
    switch (config_->profile->diagnosis) {
        case DiagForm::none: return orders;
        case DiagForm::trip_code:
        case DiagForm::tripped:
            orders.ext_diag.assign(
                tec::ext_diag(trip_form(*config_), trip_word(),
                              static_cast<std::uint16_t>(tec_ ? tec_->settings().ext_diagnostic : 0)));
            break;
        case DiagForm::status_word:
            orders.ext_diag.push(3); // header: a device-related block of three octets, this one included
            orders.ext_diag.push16(watched_.word_of(config_->status_tag));
            break;
    }
    orders.ext_diag_fault = config_->ext_diag_bit && reports_a_fault();
    return orders;
}

/// Null: nothing is known of the trip.
const WatchedTags::Seen* EmulatedDevice::seen_trip() const
{
    const WatchedTags::Seen* const one = config_->tec ? watched_.find(config_->tec->trip.bit.tag) : nullptr;
    return one != nullptr && one->was_read ? one : nullptr;
}

/// As tec::ext_diag() takes it. What is not known is no trip, also where the bit says "healthy".
std::uint16_t EmulatedDevice::trip_word() const
{
    const WatchedTags::Seen* const one = seen_trip();
    if (one == nullptr) return 0;
    if (trip_form(*config_) == tec::TripForm::code) return one->word;
    const bool is_set = (one->word & config_->tec->trip.bit.mask) != 0;
    return is_set != config_->tec->trip.bit.inverted ? std::uint16_t{1} : std::uint16_t{0};
}

std::uint8_t EmulatedDevice::trip_octet() const
{
    return tec::ext_diag(trip_form(*config_), trip_word(), 0)[1];
}

bool EmulatedDevice::reports_a_fault() const
{
    if (config_->profile->diagnosis == DiagForm::status_word)
        return (watched_.word_of(config_->status_tag) & config_->profile->fault_mask) != 0;
    return trip_octet() != 0;
}

std::int64_t EmulatedDevice::zero_after_ms() const
{
    return to_ms(tec_ ? tec::zero_after(tec_->settings()) : config_->zero_after);
}

std::optional<std::string> EmulatedDevice::trip() const
{
    if (!config_->tec) return std::nullopt;
    const std::uint16_t tag = config_->tec->trip.bit.tag;
    if (tag == 0) return "not known: no tag has it; set trip_tag in [station.tec]";
    const WatchedTags::Seen* const one = seen_trip();
    if (one == nullptr) return fmt::format("unknown: tag {} was never read", tag);
    const std::string words = tec::trip_words(trip_octet());
    if (!condition_.drive_answers) return words + " (the drive does not answer)";
    return one->is_current ? words : fmt::format("{} (tag {} can no longer be read)", words, tag);
}

std::optional<std::int64_t> EmulatedDevice::trip_tag() const
{
    if (!config_->tec || config_->tec->trip.bit.tag == 0) return std::nullopt;
    return config_->tec->trip.bit.tag;
}

std::optional<bool> EmulatedDevice::tripped() const
{
    return seen_trip() != nullptr ? std::optional{trip_octet() != 0} : std::nullopt;
}

std::string EmulatedDevice::silent_because() const
{
    if (is_away_) return gone_;
    return tec_ ? tec_->fault_words() : std::string{};
}

std::vector<std::string> EmulatedDevice::notes() const
{
    return tec_ ? tec_->notes(silent_because()) : std::vector<std::string>{};
}

} // namespace dpslave::app
