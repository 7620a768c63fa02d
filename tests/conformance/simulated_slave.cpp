// SPDX-License-Identifier: Apache-2.0
#include "simulated_slave.hpp"

#include "support/paths.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <stdexcept>

namespace conformance {

using dpslave::Baud;
using dpslave::Tbit;
namespace dp = dpslave::dp;
namespace fdl = dpslave::fdl;

namespace {

/// Of the profile that is shipped, with the ident of the station.
dp::Personality personality_of(const Family& family)
{
    const auto profile = dpslave::profile::load_profile(
        dpslave::io::read_regular_file, dpslave::test::source_path("config/profiles"), family.profile);
    if (!profile) throw std::runtime_error{dpslave::input::to_string(profile.error().at(0))};
    dp::Personality personality = profile->personality;
    if (family.has_own_ident) personality.ident = family.ident;
    return personality;
}

constexpr Baud kClockRate = Baud::k93_75; ///< that of the pty

} // namespace

SimulatedSlave::SimulatedSlave(const Family& family) : family_(family), personality_(personality_of(family))
{
    for (std::size_t i = 0; i < kInputTags.size(); ++i) words_[kInputTags[i]] = kInputsAtStart[i];
    power_on({.baud = kClockRate, .search = {}, .start_up_latency = {}}, kClockRate, test::kUs);
}

void SimulatedSlave::power_on(const fdl::Layer2Settings& settings, Baud rate, std::uint8_t address)
{
    layer2_ = std::make_unique<fdl::Layer2>(settings);
    slave_ = std::make_unique<dp::Slave>(personality_, address);
    bus_ = std::make_unique<test::Bus>(
        *layer2_, test::BusSettings{.baud = rate,
                                    .min_tsdr = Tbit{11},
                                    .max_tsdr = personality_.max_tsdr[dpslave::index_of(rate)]});
    slave_->start(bus_->now());
    layer2_->attach(address, *slave_, personality_.max_tsdr);
    bus_->advance({});
    report_fault(false);
}

/// The outputs of the drive stay as they are: nothing is there any more to write them.
void SimulatedSlave::power_off()
{
    bus_.reset();
    layer2_.reset();
    slave_.reset();
    outputs_ = {};
    refreshed_.reset();
}

void SimulatedSlave::restart(std::uint8_t address)
{
    power_off();
    power_on({.baud = kClockRate, .search = {}, .start_up_latency = {}}, kClockRate, address);
}

void SimulatedSlave::restart_at(Baud rate, bool search)
{
    power_off();
    fdl::Layer2Settings settings{.baud = rate, .search = {}, .start_up_latency = {}};
    if (search) {
        settings.baud = Baud::k1500;
        settings.search = fdl::BaudSearchSettings{};
    }
    power_on(settings, rate, test::kUs);
}

std::optional<Octets> SimulatedSlave::ask(const Octets& request)
{
    settle();
    bus_->master_sends(request);
    auto reply = bus_->reply();
    settle();
    return reply;
}

testing::AssertionResult SimulatedSlave::is_silent_to(const Octets& octets)
{
    const auto reply = ask(octets);
    if (!reply) return testing::AssertionSuccess();
    return testing::AssertionFailure() << test::show(octets) << " is answered with " << test::show(*reply);
}

void SimulatedSlave::send(const Octets& telegram)
{
    settle();
    bus_->send(telegram);
    settle();
}

void SimulatedSlave::pass_exactly(std::chrono::nanoseconds time)
{
    bus_->line_is_idle_for(time);
    settle();
}

void SimulatedSlave::set_input(std::size_t index, std::uint16_t word)
{
    words_[kInputTags.at(index)] = word;
    refreshed_.reset();
    settle();
}

testing::AssertionResult SimulatedSlave::drive_gets(std::uint16_t word)
{
    if (!written_.empty() && written_.back() == word) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "the drive was not given " << word;
}

void SimulatedSlave::report_fault(bool stands)
{
    if (family_.has_diagnosis()) slave_->set_ext_diag(stands ? family_.faulty : family_.healthy, stands);
}

/// What the drive side does: it ends layouts, writes outputs that changed and reads the inputs of a new
/// layout.
void SimulatedSlave::settle()
{
    std::uint16_t& held = words_[kOutputTags[0]];
    const auto write = [&](std::uint16_t word) { written_.push_back(held = word); };
    while (slave_->take_left()) write(0);
    if (const auto newest = slave_->take_outputs()) outputs_ = *newest;
    for (std::size_t i = 0; outputs_.may_write && i < outputs_.layout.count; ++i)
        if (outputs_.layout.parameters[i].tag == kOutputTags[0] && outputs_.words[i] != held)
            write(outputs_.words[i]);

    const dpslave::Layout& layout = outputs_.layout;
    if (!drive_answers_ || layout.generation == 0 || refreshed_ == layout.generation) return;
    dpslave::InputImage image{.generation = layout.generation, .every_input_tried = true};
    for (std::size_t i = 0; i < layout.count; ++i)
        if (layout.parameters[i].reads) image.words[i] = words_[layout.parameters[i].tag];
    slave_->set_inputs(image);
    refreshed_ = layout.generation;
}

} // namespace conformance
