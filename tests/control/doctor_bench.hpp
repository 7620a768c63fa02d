// SPDX-License-Identifier: Apache-2.0
/// Replies of a daemon with one station, which a test makes sick.
#pragma once

#include "doctor.hpp"
#include "fixtures.hpp"

#include <gtest/gtest.h>

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
        replies.diagnosis =
            with_one("stations", {{"name", "unwinder"}, {"refusal", nullptr}, {"trouble", Json::array()}});
        replies.counters = with_one("groups", {{"name", "bus"}, {"counters", Json::array()}});
        count("octets", 9'000'000);
        count("telegrams", 100'000);
        count("requests", 100'000);
        replies.leds = fixture("GetLeds");
        replies.tec = with_one("stations", Json::object());
        replies.tec["stations"].clear();
        replies.io = fixture("GetIo");
    }

    Json& bus() { return replies.status["bus"]; }
    Json& station() { return replies.status["stations"][0]; }
    Json& info() { return replies.info["stations"][0]; }
    void count(const char* name, std::int64_t value)
    {
        replies.counters["groups"][0]["counters"].push_back(
            {{"name", name}, {"value", value}, {"meaning", ""}});
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
            if (finding.rule->note == notes) names.emplace_back(finding.rule->name);
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
                for (const std::string_view step : rule.steps) all.append(step) += '\n';
        return all;
    }
    Replies replies;
};

} // namespace dpslave::dpctl
