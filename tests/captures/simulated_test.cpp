// SPDX-License-Identifier: Apache-2.0
// The telegrams of a foreign master, sent again to layer 2 and slave on the simulated clock. The bus of
// tests/support judges the window of each reply, and that nobody speaks who was not asked.
#include "dpsim/replay/answer_judge.hpp"
#include "foreign.hpp"
#include "support/bus.hpp"

#include "dpslave/dp/slave.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <gtest/gtest.h>

namespace captures {
namespace {

using namespace dpslave;

class Simulated : public testing::TestWithParam<Foreign> {
protected:
    Simulated() : personality_(personality_of(GetParam())), slave_(personality_, kSlave)
    {
        slave_.start(bus_.now());
        layer2_.attach(kSlave, slave_, personality_.max_tsdr);
        bus_.advance({});
    }

    /// Sends what the master of a capture said. Fails at the first answer that is not that of the capture.
    void play(const std::string& name)
    {
        const auto script = sim::script_of(read_foreign(name));
        ASSERT_TRUE(script) << script.error();
        const sim::AnswerJudge judge{*script, sim::DriveSide::capture};
        for (std::size_t i = 0; i < script->steps.size(); ++i) {
            const sim::ReplayStep& step = script->steps[i];
            const auto reply = ask(step.octets);
            ASSERT_EQ(reply.has_value(), step.answer.has_value()) << name << ", packet " << step.packet;
            if (!reply) continue;
            ++compared_;
            const auto verdict = judge.judge(i, *reply);
            ASSERT_TRUE(verdict.is_same)
                << name << ", packet " << step.answer_packet << ": " << verdict.why << "\n"
                << test::show(*step.answer) << "\n"
                << test::show(*reply);
        }
    }

    std::size_t compared_ = 0; ///< answers of the capture that is judged

private:
    /// A telegram of the capture, and the reply to it.
    std::optional<test::Octets> ask(const test::Octets& telegram)
    {
        bus_.master_sends(telegram);
        auto reply = bus_.reply();
        serve_drive();
        return reply;
    }

    static dp::Personality personality_of(const Foreign& foreign)
    {
        const auto profile = profile::load_profile(
            io::read_regular_file, std::string{DPSLAVE_SOURCE_DIR} + "/config/profiles", foreign.profile);
        if (!profile) throw std::runtime_error{toml::to_string(profile.error().at(0))};
        dp::Personality personality = profile->personality;
        personality.ident = foreign.ident;
        return personality;
    }

    /// The drive of the captures answers each read with 0.
    void serve_drive()
    {
        while (slave_.take_left()) {
        }
        while (slave_.take_demand_order()) {
        }
        const auto outputs = slave_.take_outputs();
        if (!outputs || outputs->layout.generation == 0 || outputs->layout.generation == served_) return;
        served_ = outputs->layout.generation;
        slave_.set_inputs({.generation = served_, .every_input_tried = true});
    }

    dp::Personality personality_;
    fdl::Layer2 layer2_{{.baud = Baud::k187_5, .search = {}, .start_up_latency = {}}};
    dp::Slave slave_;
    test::Bus bus_{layer2_,
                   {.baud = Baud::k187_5,
                    .min_tsdr = Tbit{11},
                    .max_tsdr = personality_.max_tsdr[index_of(Baud::k187_5)]}};
    Generation served_ = 0;
};

TEST_P(Simulated, GivesTheAnswersOfTheCapture)
{
    if (!GetParam().before.empty()) play(GetParam().before);
    compared_ = 0;

    play(GetParam().name);

    EXPECT_GE(compared_, 60U);
}

INSTANTIATE_TEST_SUITE_P(OfAForeignMaster, Simulated, testing::ValuesIn(all_foreign()),
                         [](const auto& one) { return test_name_of(one.param); });

} // namespace
} // namespace captures
