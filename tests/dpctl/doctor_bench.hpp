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

inline Json with_one(const char* list, Json item)
{
    Json array = Json::array();
    array.push_back(std::move(item));
    return Json::object({{list, std::move(array)}});
}

/// One station that exchanges data on a sound line.
class Doctor : public testing::Test {
protected:
    Doctor()
    {
        replies.status = fixture("GetStatus");
        replies.status["stations"].erase(1);
        station()["left_count"] = 0;
        station()["left_because"] = nullptr;
        replies.info = fixture("GetInfo");
        info()["address_pending"] = nullptr;
        replies.diagnosis = with_one("stations", {{"name", "unwinder"},
                                                  {"refusal", nullptr},
                                                  {"trouble", Json::array()},
                                                  {"refused", Json::array()}});
        replies.counters = with_one("groups", {{"name", "bus"}, {"counters", Json::array()}});
        replies.counters["groups"].push_back({{"name", "unwinder"}, {"counters", Json::array()}});
        count("octets", 9'000'000);
        count("telegrams", 100'000);
        count("checked", 50'000);
        count("requests", 100'000);
        count_of_station("data_exchange", 50'000);
        count_of_station("drive_reads", 500);
        replies.leds = fixture("GetLeds");
        replies.tec = with_one("stations", Json::object());
        replies.tec["stations"].clear();
        replies.io = fixture("GetIo");
        word_is(1, "good");
    }

    Json& bus() { return replies.status["bus"]; }
    Json& station() { return replies.status["stations"][0]; }
    Json& info() { return replies.info["stations"][0]; }
    /// A counter of the bus that has counted all of it within the last minute, and counts now.
    void count(const char* name, std::int64_t value) { set_count(0, name, value, value, 500.0); }
    void count_of_station(const char* name, std::int64_t value) { set_count(1, name, value, value, 500.0); }
    /// `group`: 0 = the bus, 1 = the station. `age`: ms since the last one; none = never.
    void set_count(std::size_t group, const std::string& name, std::int64_t value, std::int64_t minute,
                   std::optional<double> age)
    {
        Json& counters = replies.counters["groups"][group]["counters"];
        for (std::size_t i = 0; i < counters.size(); ++i)
            if (counters[i].at("name") == name) counters.erase(i--);
        counters.push_back(
            {{"name", name},
             {"value", value},
             {"meaning", ""},
             {"minute", minute},
             {"last_age_ms", age ? Json(*age) : Json(nullptr)},
             {"since_age_ms", minute > 0 ? Json(std::max(age.value_or(0), 30'000.0)) : Json(nullptr)}});
    }
    /// No telegram of the master came for `ms`.
    void hears_nothing_for(double ms)
    {
        for (const char* name : {"octets", "telegrams", "checked", "requests"})
            set_count(0, name, 50'000, 100, ms);
        bus()["last_telegram_age_ms"] = ms;
        is_not_asked();
    }
    void is_not_asked() { set_count(1, "data_exchange", 50'000, 0, 300'000.0); }
    void never_heard_anything()
    {
        replies.counters["groups"][0]["counters"].clear();
        bus()["last_telegram_age_ms"] = nullptr;
        is_not_asked();
    }
    void drive_was_never_heard()
    {
        station()["drive"]["link"] = "silent";
        station()["drive"]["ever_answered"] = false;
    }
    void drive_refuses(unsigned tag, const char* code, const char* said)
    {
        replies.diagnosis["stations"][0]["refused"].push_back(
            {{"tag", tag}, {"write", false}, {"code", code}, {"text", said}});
    }
    void word_is(std::size_t index, const char* state)
    {
        replies.io["stations"][0]["words"][index]["state"] = state;
    }
    void refuse(const char* telegram, const char* what)
    {
        replies.diagnosis["stations"][0]["refusal"] = {{"telegram", telegram}, {"what", what},
                                                       {"octet", 5},           {"expected", nullptr},
                                                       {"got", nullptr},       {"advice", "use the GSD"}};
    }
    void is_technology_box(int fault, const char* fault_shown, int network)
    {
        Json tec = fixture("GetTec")["stations"][0];
        tec["name"] = "unwinder";
        tec["notes"] = Json::array();
        tec["trip"] = tec["tripped"] = nullptr;
        tec["rows"][4]["value"] = fault;
        tec["rows"][4]["shown"] = fault_shown;
        tec["rows"][5]["value"] = network;
        replies.tec["stations"].push_back(std::move(tec));
    }
    void is_controller()
    {
        info()["comms_status"] = "run";
        info()["resolution"] = "full";
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
