// SPDX-License-Identifier: Apache-2.0
/// Replies of a daemon with one station, which a test makes sick.
#pragma once

#include "control/fixtures.hpp"
#include "dpctl/doctor/doctor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

namespace dpslave::dpctl {

using test::fixture;

/// One station that exchanges data on a sound line.
class Doctor : public testing::Test {
protected:
    Doctor()
    {
        replies.status = report::read<report::GetStatusReply>(fixture("GetStatus"));
        replies.status.stations.resize(1);
        station().left_count = 0;
        station().left_because = std::nullopt;
        replies.info = report::read<report::GetInfoReply>(fixture("GetInfo"));
        info().address_pending = std::nullopt;
        replies.diagnosis.stations = {{.name = "unwinder"}};
        replies.counters.groups = {{"bus", {}}, {"unwinder", {}}};
        count("octets", 9'000'000);
        count("telegrams", 100'000);
        count("checked", 50'000);
        count("requests", 100'000);
        count_of_station("data_exchange", 50'000);
        count_of_station("drive_reads", 500);
        replies.leds = report::read<report::GetLedsReply>(fixture("GetLeds"));
        replies.io = report::read<report::GetIoReply>(fixture("GetIo"));
        word_is(1, "good");
    }

    report::Bus& bus() { return replies.status.bus; }
    report::Station& station() { return replies.status.stations[0]; }
    report::Info& info() { return replies.info.stations[0]; }
    /// A counter of the bus that has counted all of it within the last minute, and counts now.
    void count(const char* name, std::int64_t value) { set_count(0, name, value, value, 500.0); }
    void count_of_station(const char* name, std::int64_t value) { set_count(1, name, value, value, 500.0); }
    /// `group`: 0 = the bus, 1 = the station. `age`: ms since the last one; none = never.
    void set_count(std::size_t group, const std::string& name, std::int64_t value, std::int64_t minute,
                   std::optional<double> age)
    {
        auto& counters = replies.counters.groups[group].counters;
        std::erase_if(counters, [&](const report::Counter& one) { return one.name == name; });
        counters.push_back({name, value, "", minute, age,
                            minute > 0 ? std::optional{std::max(age.value_or(0), 30'000.0)} : std::nullopt});
    }
    /// No telegram of the master came for `ms`.
    void hears_nothing_for(double ms)
    {
        for (const char* name : {"octets", "telegrams", "checked", "requests"})
            set_count(0, name, 50'000, 100, ms);
        bus().last_telegram_age_ms = ms;
        is_not_asked();
    }
    void is_not_asked() { set_count(1, "data_exchange", 50'000, 0, 300'000.0); }
    void never_heard_anything()
    {
        replies.counters.groups[0].counters.clear();
        bus().last_telegram_age_ms = std::nullopt;
        is_not_asked();
    }
    void drive_was_never_heard()
    {
        station().drive.link = "silent";
        station().drive.ever_answered = false;
    }
    void drive_refuses(std::int64_t tag, const char* code, const char* said)
    {
        replies.diagnosis.stations[0].refused.push_back({tag, false, code, said});
    }
    void word_is(std::size_t index, const char* state) { replies.io.stations[0].words[index].state = state; }
    void refuse(const char* telegram, const char* what)
    {
        replies.diagnosis.stations[0].refusal = {
            .telegram = telegram, .what = what, .octet = 5, .advice = "use the GSD"};
    }
    void is_technology_box(int fault, const char* fault_shown, int network)
    {
        auto tec = report::read<report::Tec>(fixture("GetTec")["stations"][0]);
        tec.name = "unwinder";
        tec.notes.clear();
        tec.trip = std::nullopt;
        tec.tripped = std::nullopt;
        tec.rows[4].value = fault;
        tec.rows[4].shown = fault_shown;
        tec.rows[5].value = network;
        replies.tec.stations.push_back(std::move(tec));
    }
    void is_controller()
    {
        info().comms_status = "run";
        info().resolution = "full";
    }
    /// What is wrong; with `notes` what there is to know.
    std::vector<std::string> found(bool notes = false) const
    {
        std::vector<std::string> names;
        for (const Finding& finding : diagnose(replies, ""))
            if ((finding.rule->rank == Rank::note) == notes) names.emplace_back(finding.rule->name);
        return names;
    }
    std::string evidence(std::string_view rule) const
    {
        for (const Finding& finding : diagnose(replies, ""))
            if (finding.rule->name == rule) return finding.evidence;
        return "not found";
    }
    static std::string steps(std::string_view name)
    {
        std::string all;
        for (const Rule& rule : rules())
            if (rule.name == name)
                for (const std::string_view step : steps_of(rule)) all.append(step) += '\n';
        return all;
    }
    Replies replies;
};

} // namespace dpslave::dpctl
