// SPDX-License-Identifier: Apache-2.0
// The telegrams of the captures, sent again to layer 2 and slave on the simulated clock. The bus of
// tests/support judges the window of each reply, and that nobody speaks who was not asked.
#include "dpsim/replay/answer_judge.hpp"
#include "drive_of_capture.hpp"
#include "scenario.hpp"
#include "support/bus.hpp"

#include "dpslave/dp/slave.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <gtest/gtest.h>

namespace captures {
namespace {

using namespace dpslave;

class Simulated : public testing::TestWithParam<Scenario> {
protected:
    Simulated()
        : personality_(personality_of(GetParam().station)), slave_(personality_, GetParam().station.address)
    {
        slave_.start(bus_.now());
        layer2_.attach(GetParam().station.address, slave_, personality_.max_tsdr);
        bus_.advance({});
    }

    /// Sends what the master of a capture said. Fails at the first answer that is not that of the capture.
    void play(const std::string& path)
    {
        const auto script = sim::script_of(read_capture(path));
        ASSERT_TRUE(script) << script.error();
        const sim::AnswerJudge judge{*script, sim::DriveSide::capture};
        DriveOfACapture drive{*script, slave_};
        for (std::size_t i = 0; i < script->steps.size(); ++i) {
            const sim::ReplayStep& step = script->steps[i];
            drive.serve(i);
            bus_.advance(step.pause);
            const auto reply = bus_.ask(step.octets);
            ASSERT_EQ(reply.has_value(), step.answer.has_value()) << path << ", packet " << step.packet;
            if (!reply) continue;
            ++compared_;
            const auto verdict = judge.judge(i, *reply);
            const bool is_right = GetParam().is_recorded() ? verdict.is_same : *reply == *step.answer;
            ASSERT_TRUE(is_right) << path << ", packet " << step.answer_packet << ": " << verdict.why << "\n"
                                  << ::test::show(*step.answer) << "\n"
                                  << ::test::show(*reply);
        }
    }

    std::size_t compared_ = 0; ///< answers of the capture that is judged

private:
    static dp::Personality personality_of(const Station& station)
    {
        const auto profile = profile::load_profile(io::read_regular_file, station.profiles, station.profile);
        if (!profile) throw std::runtime_error{input::to_string(profile.error().at(0))};
        dp::Personality personality = profile->personality;
        personality.ident = station.ident;
        return personality;
    }

    dp::Personality personality_;
    fdl::Layer2 layer2_{{.baud = Baud::k187_5, .search = {}, .start_up_latency = {}}};
    dp::Slave slave_;
    ::test::Bus bus_{layer2_,
                     {.baud = Baud::k187_5,
                      .min_tsdr = Tbit{11},
                      .max_tsdr = personality_.max_tsdr[index_of(Baud::k187_5)]}};
};

TEST_P(Simulated, GivesTheAnswersOfTheCapture)
{
    if (!GetParam().before.empty()) play(GetParam().before);
    compared_ = 0;

    play(GetParam().path());

    EXPECT_GE(compared_, GetParam().is_recorded() ? 60U : 1U);
}

INSTANTIATE_TEST_SUITE_P(Captures, Simulated, testing::ValuesIn(all_scenarios()),
                         [](const auto& one) { return test_name_of(one.param); });

} // namespace
} // namespace captures
