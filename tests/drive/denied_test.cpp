// SPDX-License-Identifier: Apache-2.0
/// a chosen tag that the drive denies. The poller and the EI-ASCII client together, on a simulated
/// line.
#include "client_transaction.hpp"
#include "fake_drive.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/drive/poller.hpp"

#include <gtest/gtest.h>

#include <array>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using test::FakeDrive;

constexpr int kSpeed = 288, kOut = 300, kWriteOnly = 301, kMissingTag = 700;

std::string mnemonic(int tag, MnemonicRule rule = MnemonicRule::dc_590plus)
{
    const auto two = *mnemonic_by_rule(static_cast<std::uint16_t>(tag), rule);
    return {two[0], two[1]};
}

TagTable table()
{
    std::vector<Tag> rows;
    for (const int number : {kSpeed, kOut, kWriteOnly, kMissingTag}) {
        Tag row;
        row.number = static_cast<std::uint16_t>(number);
        row.type = TagType::word;
        if (number == kWriteOnly) row.access = Access::write_only;
        rows.push_back(row);
    }
    return TagTable{rows};
}

class Denied : public testing::Test {
protected:
    explicit Denied(DeniedHold holds = DeniedHold::where_one, unsigned baud = 9600)
        : line(baud),
          client(line, {.baud = baud, .timeout = 200ms},
                 {{{0, 0}, MnemonicRule::dc_590plus}, {{0, 1}, MnemonicRule::dc_590plus}}),
          poller({settings(0, holds), settings(1, holds)}, {})
    {
        line.drives = {&drive, &other};
        for (FakeDrive* const one : line.drives)
            for (const int tag : {kSpeed, kOut, kWriteOnly}) one->parameters[mnemonic(tag)].text = ">0007";
    }
    DriveSettings settings(std::uint8_t unit, DeniedHold holds) const
    {
        DriveSettings one;
        one.address = {0, unit};
        one.tags = &tags;
        one.scale_from_table = true;
        one.denied_holds = holds;
        return one;
    }
    void layout(const std::vector<int>& reads, const std::vector<int>& writes = {}, std::size_t unit = 0)
    {
        OutputImage& image = images[unit];
        image = {};
        image.layout.generation = ++generation;
        for (const int tag : reads) add(image, tag, true);
        for (const int tag : writes) add(image, tag, false);
        poller.set_outputs(unit, image);
    }
    void master_writes(std::size_t parameter, std::uint16_t word)
    {
        images[0].may_write = true;
        images[0].words[parameter] = word;
        poller.set_outputs(0, images[0]);
    }
    void run(std::chrono::nanoseconds time)
    {
        const Instant end = line.time + time;
        while (line.time < end) {
            const auto transaction = poller.next(line.time);
            if (transaction)
                carry_out(*transaction);
            else
                line.time = std::min(end, std::max(line.time + 1ms, poller.next_deadline()));
            for (std::size_t i = 0; i < 2; ++i)
                if (const auto fresh = poller.take_inputs(i)) inputs[i] = *fresh;
        }
    }
    unsigned reads_of(int tag) { return drive.parameters[mnemonic(tag)].reads; }

    FakeDrive drive{'0', '0'}, other{'0', '1'};
    test::SimulatedLine line;
    EiAsciiClient client;
    TagTable tags = table();
    Poller poller;
    std::array<OutputImage, 2> images;
    std::array<InputImage, 2> inputs;
    Generation generation = 0;

private:
    static void add(OutputImage& image, int tag, bool reads)
    {
        image.layout.parameters[image.layout.count++] = {static_cast<std::uint16_t>(tag), reads, !reads};
    }
    void carry_out(const Transaction& transaction)
    {
        std::array<std::uint16_t, 1> word{};
        const Outcome outcome =
            test::carry_out(client, {0, static_cast<std::uint8_t>(transaction.unit)}, transaction, word);
        poller.done(outcome, line.time);
    }
};

TEST_F(Denied, AnInputHoldsTheStartAndWhatTheDriveSaidIsNamed)
{
    layout({kSpeed, kMissingTag});
    run(2s);

    EXPECT_TRUE(inputs[0].every_input_tried);
    EXPECT_EQ(inputs[0].hold, StartHold::denied);
    EXPECT_EQ(inputs[0].words[1], 0);
    EXPECT_EQ(poller.snapshot(0).states[1], WordState::invalid_tag);
    EXPECT_STREQ(poller.snapshot(0).answer_texts[1].data(), "EE >01C7");
}

TEST_F(Denied, AnOutputIsReadOnceAndHoldsTheStart)
{
    layout({kSpeed}, {kOut, kMissingTag});
    run(5s);

    EXPECT_EQ(inputs[0].hold, StartHold::denied);
    EXPECT_EQ(reads_of(kOut), 1U);
    EXPECT_EQ(poller.snapshot(0).states[2], WordState::invalid_tag);
    EXPECT_STREQ(poller.snapshot(0).answer_texts[2].data(), "EE >01C7");
}

TEST_F(Denied, NeitherAWriteOnlyRowNorADriveThatDoesNotGiveTheValueIsADenial)
{
    drive.parameters[mnemonic(kOut)].write_only = true; // EE 04
    layout({}, {kOut, kWriteOnly});
    run(15s);

    EXPECT_TRUE(inputs[0].every_input_tried);
    EXPECT_EQ(inputs[0].hold, StartHold::none);
    EXPECT_EQ(reads_of(kWriteOnly), 0U);
}

TEST_F(Denied, TheDriveThatAnswersTheTagEndsIt)
{
    layout({kSpeed}, {kMissingTag});
    run(2s);
    ASSERT_EQ(inputs[0].hold, StartHold::denied);
    drive.parameters[mnemonic(kMissingTag)].text = ">0001";
    run(11s);

    EXPECT_EQ(inputs[0].hold, StartHold::none);
}

TEST_F(Denied, AReloadWithAnotherMnemonicEndsItAlsoWhileTheDriveIsSilent)
{
    layout({kSpeed}, {kMissingTag});
    run(2s);
    drive.alive = false;
    run(5s);
    ASSERT_EQ(inputs[0].hold, StartHold::denied) << "silence does not end it";
    std::vector<Tag> rows = tags.all();
    rows.back().mnemonic = "zz";
    const TagTable now{rows};
    DriveSettings reloaded = settings(0, DeniedHold::where_one);
    reloaded.tags = &now;

    poller.exchange({reloaded, settings(1, DeniedHold::where_one)}, {0U, 1U}, {});
    run(100ms);
    EXPECT_EQ(inputs[0].hold, StartHold::none);
    poller.exchange({settings(0, DeniedHold::where_one), settings(1, DeniedHold::where_one)}, {0U, 1U}, {});
}

TEST_F(Denied, WatchedTagsAndDemandDataDoNotHold)
{
    DriveSettings watching = settings(0, DeniedHold::where_one);
    watching.watched = {kMissingTag};
    poller.exchange({watching, settings(1, DeniedHold::where_one)}, {0U, 1U}, {});
    layout({kSpeed});
    poller.set_demand(
        0, {.kind = DemandOrder::Kind::read, .tag = kMissingTag, .number = 1, .generation = generation});
    run(2s);

    EXPECT_TRUE(inputs[0].every_input_tried);
    EXPECT_EQ(inputs[0].hold, StartHold::none);
}

TEST_F(Denied, FoundOutLaterTheInputIsHeldAndNamedAndNever0)
{
    layout({kSpeed, kOut});
    run(1s);
    ASSERT_EQ(inputs[0].words[0], 7);
    drive.parameters.erase(mnemonic(kSpeed));
    run(30s);

    EXPECT_EQ(inputs[0].words[0], 7);
    EXPECT_EQ(poller.snapshot(0).states[0], WordState::invalid_tag);
    EXPECT_STREQ(poller.snapshot(0).answer_texts[0].data(), "EE >01C7");
}

TEST_F(Denied, SilenceNeverHoldsAndTheDriveIsThenNotWaitedFor)
{
    drive.alive = false;
    layout({kSpeed, kMissingTag});
    run(3s);

    EXPECT_TRUE(inputs[0].every_input_tried);
    EXPECT_FALSE(inputs[0].drive_answers);
    EXPECT_EQ(inputs[0].hold, StartHold::none);
}

TEST_F(Denied, ADriveUnderAnotherMnemonicRuleHoldsTheStart)
{
    drive.parameters.clear();
    for (const int tag : {kSpeed, kOut}) drive.parameters[mnemonic(tag, MnemonicRule::ac)].text = ">0007";
    layout({kSpeed}, {kOut});
    run(3s);

    EXPECT_EQ(inputs[0].hold, StartHold::denied);
}

class DeniedZero : public Denied {
protected:
    DeniedZero() : Denied(DeniedHold::where_all) {}
};

TEST_F(DeniedZero, TheInputReads0TheOutputIsDroppedAndTheOthersGoOn)
{
    layout({kSpeed, kMissingTag}, {kOut});
    run(2s);
    EXPECT_EQ(inputs[0].hold, StartHold::none);
    EXPECT_EQ(inputs[0].words[1], 0);
    master_writes(2, 0x1234);
    run(1s);

    EXPECT_EQ(inputs[0].words[0], 7);
    EXPECT_EQ(drive.parameters[mnemonic(kOut)].text, ">1234");
}

TEST_F(DeniedZero, WhereEveryTagIsDeniedTheStartIsHeld)
{
    layout({kMissingTag}, {kMissingTag + 1});
    run(3s);
    EXPECT_EQ(inputs[0].hold, StartHold::denied);
}

class DeniedBox : public Denied {
protected:
    DeniedBox() : Denied(DeniedHold::never) {}
};

TEST_F(DeniedBox, NeverHoldsAndAsksNoOutput)
{
    layout({kMissingTag}, {kOut});
    run(3s);

    EXPECT_EQ(inputs[0].hold, StartHold::none);
    EXPECT_EQ(reads_of(kOut), 0U);
}

class DeniedSlow : public Denied {
protected:
    DeniedSlow() : Denied(DeniedHold::where_one, 300) {}
};

TEST_F(DeniedSlow, At300BitsTheDriveIsWaitedForUntilTheTagIsDenied)
{
    layout({kMissingTag}, {}, 1);
    layout({kSpeed, kMissingTag});
    bool was_given_up = false;
    while (inputs[0].hold == StartHold::none && line.time < Instant{} + 60s) {
        run(1ms);
        was_given_up = was_given_up || (inputs[0].generation == generation && !inputs[0].drive_answers);
    }

    EXPECT_EQ(inputs[0].hold, StartHold::denied);
    EXPECT_GT(line.time, Instant{} + 1s) << "later than the second of C2";
    EXPECT_FALSE(was_given_up);
}

TEST_F(Denied, TwelveTagsOfEachOfTwoDrivesAt9600AreWaitedFor)
{
    std::vector<int> reads;
    for (int tag = 400; tag < 411; ++tag) {
        reads.push_back(tag);
        for (FakeDrive* const one : line.drives) one->parameters[mnemonic(tag)].text = ">0001";
    }
    reads.push_back(kMissingTag); // the last of all
    layout(reads, {}, 1);
    layout(reads);
    while (!inputs[0].every_input_tried && line.time < Instant{} + 20s) {
        run(1ms);
        EXPECT_TRUE(inputs[0].generation == 0 || inputs[0].drive_answers);
    }

    EXPECT_EQ(inputs[0].hold, StartHold::denied);
}

} // namespace
} // namespace dpslave::drive
