// SPDX-License-Identifier: Apache-2.0
/// Bit errors on characters with parity, in both directions, from layer 2 to the outputs. The bus judges each
/// reply: its request was valid as it was received, bit by bit, by a checker of its own (support/wire).
#include "dp/bench.hpp"
#include "support/row.hpp"

#include <fmt/format.h>

namespace test {
namespace {

/// A master whose telegrams and answers go over a bad line. It repeats a request until it is answered.
class BitErrors : public DpBench, public testing::WithParamInterface<double> {
protected:
    BitErrors() : DpBench(option_board()) {}

    void begins()
    {
        start_up(board_prm({55, 56, 57}, "80 00 00 0B 05 33 00"), "50 60 60"); // without watchdog
        inputs_are({0x1234});
        diagnosis_is_read();
        slave.take_outputs(); // those of the start
    }
    /// A good answer to this request, as it arrives; nothing: the line has spoilt one of the two.
    std::optional<Heard> answer_to(const Octets& request)
    {
        ++telegrams;
        bus.arrives_as(request, line.received(request));
        const auto reply = bus.reply();
        if (!reply) return std::nullopt;
        Octets arrived;
        for (const Character& one : line.received(*reply)) {
            if (!one.good) return std::nullopt;
            arrived.push_back(one.octet);
        }
        return heard(arrived);
    }
    /// Outputs `value` and its complement, so that a value that nobody sent is seen.
    void exchanges(std::uint16_t value)
    {
        const auto complement = static_cast<std::uint16_t>(~value);
        Octets data;
        for (const std::uint16_t word : {value, complement})
            data.insert(data.end(), {static_cast<std::uint8_t>(word >> 8U), static_cast<std::uint8_t>(word)});
        fc = fc == 0x5D ? 0x7D : 0x5D;
        const Octets request = sd2(kUs, 2, fc, data);
        std::optional<Heard> answer;
        while (!answer) {
            answer = answer_to(request);
            look_at_outputs(value);
        }
        EXPECT_EQ(answer->data, (Octets{0x12, 0x34})) << "value " << value;
    }
    void look_at_outputs(std::uint16_t newest)
    {
        const auto outputs = slave.take_outputs();
        if (!outputs) return;
        EXPECT_EQ(outputs->words[1], newest);
        EXPECT_EQ(outputs->words[2], static_cast<std::uint16_t>(~newest));
    }

    BitLine line{GetParam(), 8, 1};
    std::uint8_t fc = 0x5D;
    std::uint64_t telegrams = 0;
};

TEST_P(BitErrors, F08_OnTheBusNeverMakeAReplyToADamagedRequestNorAValueThatNobodySent)
{
    begins();
    fc = 0x6D;
    for (std::uint16_t value = 1; telegrams < 40'000; ++value) exchanges(value);
    EXPECT_GT(line.hits(), 0U) << "or nothing was shown";

    line.heal();
    const dpslave::Instant healed = bus.now();
    const std::uint64_t before = telegrams;
    exchanges(0x5AA5);
    EXPECT_EQ(telegrams, before + 1) << "the first whole request is answered";
    dpslave::test::recovered_in(bus.now() - healed);
    RecordProperty("bits_inverted", fmt::format("{}", line.hits()));
}

INSTANTIATE_TEST_SUITE_P(OneIn, BitErrors, testing::Values(1e-6, 1e-5, 1e-4, 1e-3, 1e-2),
                         [](const auto& one) { return fmt::format("{:.0f}", 1 / one.param); });

} // namespace
} // namespace test
