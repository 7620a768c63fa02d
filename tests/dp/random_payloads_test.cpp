// SPDX-License-Identifier: Apache-2.0
/// Ten thousand random and half-right telegrams: whatever they say, state, diagnosis and outputs agree, and a
/// normal start-up works right after.
#include "bench.hpp"

#include <random>

namespace test {
namespace {

using dpslave::dp::State;

class RandomPayloads : public DpBench, public testing::WithParamInterface<unsigned> {
protected:
    RandomPayloads() : DpBench(option_board()) {}

    unsigned upto(unsigned most) { return static_cast<unsigned>(random_() % (most + 1)); }
    std::uint8_t octet() { return static_cast<std::uint8_t>(upto(255)); }
    bool often() { return upto(3) != 0; }

    Octets noise(std::size_t most)
    {
        Octets all(upto(static_cast<unsigned>(most)));
        for (auto& one : all) one = octet();
        return all;
    }

    /// Mostly legal, so that all states are reached.
    Octets prm()
    {
        if (!often()) return noise(244);
        Octets all = octets("88 01 0A 0B 05 33 01");
        if (!often()) all[upto(6)] = octet();
        const unsigned tags = upto(3);
        for (unsigned i = 0; i < 12; ++i) {
            all.push_back(i < tags && !often() ? octet() : 0);
            all.push_back(i < tags ? static_cast<std::uint8_t>(10 + i + upto(1)) : 0);
        }
        tags_ = tags;
        return all;
    }
    Octets cfg()
    {
        if (!often()) return noise(30);
        Octets all;
        if (often()) all.push_back(0x73);
        for (unsigned i = 0; i < tags_; ++i) all.push_back(i % 2 == 0 ? 0x50 : 0x60);
        if (!often() && !all.empty()) all[upto(static_cast<unsigned>(all.size() - 1))] = octet();
        return all;
    }
    Octets outputs()
    {
        if (upto(20) == 0) return noise(244);
        const auto snapshot = seen();
        std::size_t length = snapshot.cfg.size() != 0 && snapshot.cfg.bytes()[0] == 0x73 ? 8 : 0;
        for (std::size_t i = 0; i < snapshot.layout.count; ++i)
            length += snapshot.layout.parameters[i].writes ? 2u : 0u;
        Octets all(length);
        for (auto& one : all) one = octet();
        return all;
    }

    void one_telegram()
    {
        Master& who = often() ? master : foreign;
        switch (upto(11)) {
            case 0:
            case 1: who.asks(61, without_min_tsdr(prm())); break;
            case 2:
            case 3: who.asks(62, cfg()); break;
            case 4: who.slave_diag(); break;
            case 5:
                who.asks(static_cast<std::uint8_t>(upto(63)), noise(3),
                         often() ? 62 : static_cast<std::uint8_t>(upto(63)));
                break;
            case 6: who.control(show(noise(3))); break;
            case 7: give_the_drive_side_something(); break;
            case 8: bus.advance(std::chrono::milliseconds{upto(60)}); break;
            default: who.data_exchange(outputs()); break;
        }
    }

    /// A longer pause is legal too, but the judge knows only one.
    static Octets without_min_tsdr(Octets prm)
    {
        if (prm.size() > 3) prm[3] = 0;
        return prm;
    }

    void give_the_drive_side_something()
    {
        dpslave::InputImage image{.generation = upto(1) == 0 ? generation() : upto(9),
                                  .every_input_tried = often()};
        image.words.fill(static_cast<std::uint16_t>(upto(0xFFFF)));
        slave.set_inputs(image);
        if (const auto order = slave.take_demand_order())
            slave.set_demand_answer({order->number, static_cast<dpslave::AccessError>(upto(8)),
                                     static_cast<std::uint16_t>(upto(0xFFFF))});
        slave.set_ext_diag(noise(20), often());
    }

    void expect_agreement()
    {
        const auto s = seen();
        const bool exchanging = s.state == State::data_exch;
        const auto diagnosis = s.diagnosis.bytes();
        ASSERT_EQ(diagnosis.size(), 6u);
        EXPECT_EQ((diagnosis[0] & 0x02) == 0, exchanging);
        EXPECT_EQ((diagnosis[1] & 0x01) != 0, s.state == State::wait_prm);
        EXPECT_EQ((diagnosis[1] & 0x04), 0x04);
        EXPECT_EQ((diagnosis[1] & 0x08) != 0, s.watchdog_on);
        EXPECT_EQ(diagnosis[3], s.master);
        EXPECT_EQ(s.master == 0xFF, s.state == State::wait_prm);
        EXPECT_EQ(diagnosis[0] & 0xA1, 0); // what only masters set
        EXPECT_EQ(diagnosis[1] & 0xC0, 0);
        EXPECT_GE(s.min_tsdr, dpslave::Tbit{11});
        EXPECT_EQ(s.layout.generation != 0, exchanging);
        if (const auto given = slave.take_outputs()) outputs_ = *given;
        EXPECT_EQ(outputs_.layout.generation, s.layout.generation);
        EXPECT_EQ(outputs_.words, s.outputs);
        lefts_ += left().size();
        EXPECT_EQ(lefts_, s.counters.left_data_exchange);
        if (exchanging) return;
        EXPECT_FALSE(s.may_write || outputs_.may_write || s.sync || s.freeze || s.stat_diag);
        EXPECT_EQ(s.outputs, decltype(s.outputs){});
        EXPECT_EQ(s.inputs, decltype(s.inputs){});
    }

    std::mt19937 random_{GetParam()};
    unsigned tags_ = 0;
    dpslave::OutputImage outputs_{};
    std::size_t lefts_ = 0;
};

TEST_P(RandomPayloads, LeaveTheSlaveInAgreementWithItselfAndFitForService)
{
    std::array<int, 4> visits{};
    for (int i = 0; i < 3000; ++i) {
        one_telegram();
        ++visits[static_cast<std::size_t>(state())];
        expect_agreement();
        ASSERT_FALSE(HasFailure()) << "telegram " << i;
    }
    EXPECT_GT(visits[1], 50);
    EXPECT_GT(visits[2], 50);
    EXPECT_GT(visits[3], 50);
    events();
    while (slave.take_demand_order()) {
    }

    slave.set_ext_diag({}, false);
    master.set_prm("40 00 00 00 05 33 00");
    foreign.set_prm("40 00 00 00 05 33 00");
    start_up(board_prm({55, 56}), "73 50 60");
    inputs_are({0x1234});
    diagnosis_is_read();
    EXPECT_EQ(master.slave_diag(), "DL 00 0C 00 02 05 33");
    EXPECT_EQ(master.data_exchange("10 37 00 00 00 00 00 00 A5 01"), "DL 00 00 00 00 00 00 00 00 12 34");
    EXPECT_EQ(slave.take_outputs()->words[1], 0xA501);
    EXPECT_EQ(slave.take_demand_order()->tag, 55);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPayloads, testing::Values(1u, 20u, 300u, 4000u));

} // namespace
} // namespace test
