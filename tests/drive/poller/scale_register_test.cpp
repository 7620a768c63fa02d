// SPDX-License-Identifier: Apache-2.0
/// The registers in which an instrument says how it gives its values: what contradicts the station is
/// not shown and not written.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using namespace test;

constexpr std::uint16_t kResolution = 50, kDecimals = 60;

/// 1 to 4: floating values, of which 3 and 4 follow the display; 5 to 9: whole numbers.
TagTable instrument()
{
    std::vector<Tag> rows;
    for (std::uint16_t number = 1; number <= 9; ++number) {
        Tag row;
        row.number = number;
        row.is_real = number <= 4;
        row.follows_display = number == 3 || number == 4;
        rows.push_back(row);
    }
    return TagTable{rows};
}
const TagTable kInstrument = instrument();

class ScaleRegisters : public ::testing::Test {
protected:
    static DriveSettings settings()
    {
        DriveSettings unit;
        unit.tags = &kInstrument;
        unit.scale_registers = {{.tag = kResolution, .expected = 0},
                                {.tag = kDecimals, .expected = 1, .only_display = true}};
        return unit;
    }
    ScaleRegisters()
    {
        MemoryDrive& drive = bench.drives[0];
        for (int tag = 1; tag <= 9; ++tag) drive.words[tag] = static_cast<std::uint16_t>(100 + tag);
        drive.words[kResolution] = 0;
        drive.words[kDecimals] = 1;
    }
    void choose(const std::vector<int>& reads, const std::vector<int>& writes = {})
    {
        bench.layout(0, ++generation_, reads, writes);
        bench.run(2s);
        look();
    }
    void look()
    {
        if (const auto inputs = bench.poller.take_inputs(0)) image = *inputs;
    }
    std::size_t reads_of_registers() const { return bench.reads_of(kResolution) + bench.reads_of(kDecimals); }
    const DriveSnapshot& seen() const { return bench.poller.snapshot(0); }

    PollerBench bench{{settings()}};
    InputImage image;

private:
    Generation generation_ = 0;
};

TEST_F(ScaleRegisters, AreReadOnceBeforeTheExchangeWhereSomethingDependsOnThem)
{
    choose({5, 6});
    EXPECT_EQ(reads_of_registers(), 0U);
    choose({1, 5});
    EXPECT_EQ(reads_of_registers(), 2U);
    bench.run(60s);
    EXPECT_EQ(reads_of_registers(), 2U) << "and not in every round";
    EXPECT_TRUE(image.every_input_tried);
    EXPECT_EQ(image.hold, StartHold::none);
    EXPECT_EQ(image.words[0], 101);
}

TEST_F(ScaleRegisters, AContradictionHoldsTheStartAndNamesTheRegister)
{
    bench.drives[0].words[kResolution] = 1;
    choose({1, 5}, {2});

    EXPECT_EQ(image.hold, StartHold::unscaled);
    EXPECT_EQ(image.words[0], 0) << "it was never read";
    EXPECT_EQ(image.words[1], 105) << "a whole number does not depend on it";
    EXPECT_EQ(seen().scale_fault, (ScaleFault{kResolution, 1, 0}));
    bench.master_writes(0, 2, 7);
    bench.run(5s);
    EXPECT_EQ(bench.drives[0].words[2], 102) << "nothing is written";
}

/// Exception 6 of Modbus, or a NAK in noise.
TEST_F(ScaleRegisters, AnInstrumentThatIsBusyIsAskedAgainAndMeanwhileNothingIsDecided)
{
    bench.drives[0].words[kResolution] = 1;
    bench.drives[0].read_errors[kResolution] = AccessError::not_understood;
    choose({1, 5});
    EXPECT_FALSE(image.every_input_tried);
    bench.drives[0].read_errors.clear();
    bench.run(3s);
    look();
    EXPECT_EQ(image.hold, StartHold::unscaled);

    bench.drives[0].read_errors[kResolution] = AccessError::not_understood;
    bench.run(12s);
    look();
    EXPECT_EQ(image.hold, StartHold::unscaled) << "what was found stands";
}

TEST_F(ScaleRegisters, AnOutputAloneHoldsTheStartAsWell)
{
    bench.drives[0].words[kResolution] = 1;
    choose({}, {2});
    EXPECT_EQ(image.hold, StartHold::unscaled);
}

TEST_F(ScaleRegisters, WithUnscaledTagsZeroTheExchangeBeginsAllTheSame)
{
    DriveSettings unit = settings();
    unit.unscaled_holds = false;
    PollerBench other{{unit}};
    other.drives[0].words = bench.drives[0].words;
    other.drives[0].words[kResolution] = 1;
    other.layout(0, 1, {1});
    other.run(2s);
    const auto inputs = other.poller.take_inputs(0);
    ASSERT_TRUE(inputs);
    EXPECT_EQ(inputs->hold, StartHold::none);
    EXPECT_EQ(inputs->words[0], 0);
}

TEST_F(ScaleRegisters, TheDecimalsOfTheDisplayConcernOnlyTheTagsThatFollowIt)
{
    bench.drives[0].words[kDecimals] = 2;
    choose({1, 3});
    EXPECT_EQ(image.words[0], 101);
    EXPECT_EQ(image.words[1], 0);
    EXPECT_EQ(seen().scale_fault, (ScaleFault{kDecimals, 2, 1}));
}

TEST_F(ScaleRegisters, ADriveThatIsSetRightIsFoundWithoutANewStart)
{
    bench.drives[0].words[kResolution] = 1;
    choose({1}, {2});
    bench.drives[0].words[kResolution] = 0;
    bench.run(11s);
    look();
    EXPECT_EQ(image.hold, StartHold::none);
    EXPECT_EQ(image.words[0], 101);
    bench.master_writes(0, 2, 7);
    bench.run(2s);
    EXPECT_EQ(bench.drives[0].words[2], 7);
}

TEST_F(ScaleRegisters, ThatAreDeniedHoldNothing)
{
    bench.drives[0].words.erase(kResolution);
    bench.drives[0].words.erase(kDecimals);
    choose({1, 3});
    EXPECT_EQ(image.hold, StartHold::none);
    EXPECT_EQ(image.words[1], 103);
}

TEST_F(ScaleRegisters, ThatAreSilentHoldNothing)
{
    bench.drives[0].silent_tags = {kResolution, kDecimals};
    choose({1, 3});
    bench.run(60s);
    look();
    EXPECT_TRUE(image.every_input_tried);
    EXPECT_EQ(image.hold, StartHold::none);
    EXPECT_EQ(image.words[1], 103);
    EXPECT_TRUE(seen().answers);
}

TEST_F(ScaleRegisters, AfterALossTheyAreReadBeforeAnythingThatDependsOnThem)
{
    choose({1, 5}, {2, 6});
    bench.master_writes(0, 2, 7);
    bench.master_writes(0, 6, 8);
    bench.run(2s);
    bench.drives[0].alive = false;
    bench.run(5s);
    bench.drives[0].words[kResolution] = 1;
    bench.drives[0].words[1] = 10;
    bench.drives[0].words[2] = 0;
    bench.drives[0].words[6] = 0;
    bench.drives[0].alive = true;
    bench.run(10s);
    look();

    EXPECT_EQ(bench.drives[0].words[2], 0) << "an output in another scale is not written";
    EXPECT_EQ(bench.drives[0].words[6], 8);
    EXPECT_EQ(image.words[0], 101) << "the input is held";
    EXPECT_EQ(image.words[1], 105);
    EXPECT_EQ(seen().states[0], WordState::unscaled);
    EXPECT_TRUE(image.every_input_tried);
}

TEST_F(ScaleRegisters, DemandDataForATagThatDependsOnAWrongOneIsRefused)
{
    bench.drives[0].words[kResolution] = 1;
    choose({1});
    bench.poller.set_demand(0, {.kind = DemandOrder::Kind::read, .tag = 2, .number = 1, .generation = 1});
    bench.run(1s);
    const auto answer = bench.poller.take_demand_answer(0);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->error, AccessError::no_scale);
}

} // namespace
} // namespace dpslave::drive
