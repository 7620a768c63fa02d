// SPDX-License-Identifier: Apache-2.0
/// A station as the main thread sees it, made by hand.
#pragma once

#include "app/state/device_news.hpp"

#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace dpslave::test {

class DeviceBench {
public:
    DeviceBench()
    {
        profile_->name = "box";
        station.name = "unwinder";
        station.address = 5;
        station.profile = profile_;
        station.personality = personality_;
        station.tags = std::make_shared<const drive::TagTable>();
        view.config = {std::shared_ptr<void>{}, &station};
        view.line = &line;
        view.line_open = true;
        bus.valid = true;
        bus.last_telegram = Instant{} + std::chrono::seconds{1};
        view.bus.state = dp::State::wait_prm;
    }

    profile::Profile& profile() { return *profile_; }
    dp::Personality& personality() { return *personality_; }

    /// A technology box whose trip comes from tag 4 and whose lamps from tag 272.
    void is_a_box(profile::DiagForm form = profile::DiagForm::trip_code)
    {
        profile_->has_tec = true;
        profile_->diagnosis = form;
        profile_->leds = led::Language::technology_box;
        config::TecConfig tec;
        tec.start.address = 5;
        tec.trip.bit.tag = 4;
        tec.health = {.tag = 272, .mask = 0x0008, .inverted = false};
        tec.run = {.tag = 272, .mask = 0x0010, .inverted = true};
        station.tec = tec;
        station.watched = {4, 272};
    }

    void is_a_controller()
    {
        profile_->diagnosis = profile::DiagForm::status_word;
        profile_->fault_mask = 0x6CEF;
        profile_->leds = led::Language::controller;
        profile_->selectable_resolution = true;
        personality_->demand = dp::DemandForm::extended;
        drive::Tag status;
        status.number = 75;
        status.name = "Summary Output Status";
        status.type = drive::TagType::word;
        status.labels = {{.is_bit = true, .number = 4, .text = "manual"},
                         {.is_bit = true, .number = 5, .text = "sensor break"},
                         {.is_bit = true, .number = 14, .text = "IP1 fault"}};
        station.tags = std::make_shared<const drive::TagTable>(std::vector{status});
        station.status_tag = 75;
        station.watched = {75};
        station.zero_after.reset();
    }

    /// The drive answers, and its watched tags read as given, in their order.
    void drive_reads(std::initializer_list<std::uint16_t> words)
    {
        view.drive.known = view.drive.answers = true;
        std::size_t i = 0;
        for (const std::uint16_t word : words) {
            view.drive.watched[i] = {.tag = station.watched[i], .word = word, .state = WordState::good};
            ++i;
        }
    }
    /// What the device makes of it, and what is told of it.
    void update(app::EmulatedDevice& device)
    {
        device.update(view, bus);
        news.update(view, device, bus);
    }
    void drive_is_lost()
    {
        view.drive.answers = false;
        for (drive::Watched& one : view.drive.watched)
            if (one.state == WordState::good) one.state = WordState::stale;
    }

    config::StationConfig station;
    config::LineConfig line;
    app::Station view;
    app::BusSnapshot bus;
    app::DeviceNews news;

private:
    std::shared_ptr<profile::Profile> profile_ = std::make_shared<profile::Profile>();
    std::shared_ptr<dp::Personality> personality_ = std::make_shared<dp::Personality>();
};

} // namespace dpslave::test
