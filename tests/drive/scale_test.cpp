// SPDX-License-Identifier: Apache-2.0
/// a number whose scale is not known. The poller and the EI-ASCII client together, on a simulated line.
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

constexpr UnitAddress kDrive{0, 0};
constexpr int kNumber = 288, kWord = 536, kBare = 300; ///< bare: its row has no decimals

Tag row(int number, TagType type)
{
    Tag tag;
    tag.number = static_cast<std::uint16_t>(number);
    tag.type = type;
    return tag;
}

TagTable table()
{
    Tag scaled = row(kNumber, TagType::number);
    scaled.decimals = 1;
    Tag bare = row(kBare, TagType::number);
    bare.decimals_known = false;
    return TagTable{{scaled, bare, row(kWord, TagType::word)}};
}

std::string mnemonic(int tag)
{
    const auto two = *mnemonic_by_rule(static_cast<std::uint16_t>(tag), MnemonicRule::dc_590plus);
    return {two[0], two[1]};
}

class Scale : public testing::Test {
protected:
    explicit Scale(std::optional<std::uint8_t> unlisted_decimals = {}, bool unscaled_holds = true)
        : poller({settings(tags, unlisted_decimals, unscaled_holds)}, {})
    {
        line.drives = {&drive};
        holds(kNumber, "12.5");
        holds(kWord, ">1B0B");
        holds(kBare, "7.5");
    }
    static DriveSettings settings(const TagTable& tags, std::optional<std::uint8_t> unlisted_decimals,
                                  bool unscaled_holds)
    {
        DriveSettings one;
        one.tags = &tags;
        one.scale_from_table = true;
        one.unlisted_decimals = unlisted_decimals;
        one.unscaled_holds = unscaled_holds;
        return one;
    }

    void holds(int tag, const std::string& text) { drive.parameters[mnemonic(tag)].text = text; }
    const std::string& held(int tag) { return drive.parameters[mnemonic(tag)].text; }
    unsigned writes_of(int tag) { return drive.parameters[mnemonic(tag)].writes; }

    void layout(const std::vector<int>& reads, const std::vector<int>& writes = {})
    {
        image = {};
        image.layout.generation = ++generation;
        for (const int tag : reads) add(tag, true);
        for (const int tag : writes) add(tag, false);
        poller.set_outputs(0, image);
    }
    void master_writes(std::size_t parameter, std::uint16_t word)
    {
        image.may_write = true;
        image.words[parameter] = word;
        poller.set_outputs(0, image);
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
            if (const auto fresh = poller.take_inputs(0)) inputs = *fresh;
        }
    }

    bool is_held() const { return inputs.hold == StartHold::unscaled; }

    FakeDrive drive{'0', '0'};
    test::SimulatedLine line;
    EiAsciiClient client{line, {.baud = 9600, .timeout = 200ms}, {{kDrive, MnemonicRule::dc_590plus}}};
    TagTable tags = table();
    Poller poller;
    OutputImage image;
    InputImage inputs;
    Generation generation = 0;

private:
    void add(int tag, bool reads)
    {
        image.layout.parameters[image.layout.count++] = {static_cast<std::uint16_t>(tag), reads, !reads};
    }
    void carry_out(const Transaction& transaction)
    {
        std::array<std::uint16_t, 1> word{};
        const Outcome outcome = test::carry_out(client, kDrive, transaction, word);
        poller.done(outcome, line.time);
    }
};

TEST_F(Scale, AnInputThatAnswersWithAnUnscaledNumberReadsZeroAndHoldsTheStart)
{
    layout({kNumber, kBare});
    run(500ms);

    EXPECT_TRUE(inputs.every_input_tried);
    EXPECT_TRUE(is_held());
    EXPECT_EQ(inputs.words[0], 125);
    EXPECT_EQ(inputs.words[1], 0);
    const DriveSnapshot& seen = poller.snapshot(0);
    EXPECT_EQ(seen.states[1], WordState::unscaled);
    EXPECT_EQ(seen.errors[1], AccessError::no_scale);
    EXPECT_STREQ(seen.answer_texts[1].data(), "7.5");
}

TEST_F(Scale, ATagWithoutARowIsUnscaledToo)
{
    holds(400, "3.");
    layout({400});
    run(500ms);

    EXPECT_TRUE(is_held());
    EXPECT_EQ(inputs.words[0], 0);
}

TEST_F(Scale, ARowThatIsNotConfirmedIsUnscaled)
{
    std::vector<Tag> rows = tags.all();
    for (Tag& tag : rows) tag.confirmed = false;
    tags = TagTable{rows};
    layout({kNumber, kWord});
    run(500ms);

    EXPECT_TRUE(is_held());
    EXPECT_EQ(inputs.words[0], 0);
    EXPECT_EQ(inputs.words[1], 0x1B0B) << "an answer with > is taken as it is";
}

TEST_F(Scale, AnOutputIsReadOnceToLearnWhetherItHasAScale)
{
    layout({}, {kBare});
    run(500ms);

    EXPECT_TRUE(inputs.every_input_tried);
    EXPECT_TRUE(is_held());
    EXPECT_EQ(poller.snapshot(0).states[0], WordState::unscaled);
    EXPECT_STREQ(poller.snapshot(0).answer_texts[0].data(), "7.5");
    EXPECT_EQ(drive.parameters[mnemonic(kBare)].reads, 1u);
    EXPECT_EQ(writes_of(kBare), 0u);
}

TEST_F(Scale, AnOutputThatAnswersAsAWordDoesNotHoldAndIsNotReadAgain)
{
    holds(400, ">0007");
    layout({}, {400});
    run(500ms);
    EXPECT_TRUE(inputs.every_input_tried);
    EXPECT_FALSE(is_held());

    master_writes(0, 0x1234);
    run(20s);
    EXPECT_EQ(held(400), ">1234");
    EXPECT_EQ(drive.parameters[mnemonic(400)].reads, 1u);
}

TEST_F(Scale, AnOutputWithARowIsNotReadAtAll)
{
    layout({}, {kNumber});
    run(2s);
    EXPECT_EQ(drive.parameters[mnemonic(kNumber)].reads, 0u);
    EXPECT_FALSE(is_held());
}

TEST_F(Scale, WhatHasNoScaleIsAskedFirst)
{
    std::vector<int> reads;
    for (int tag = 100; tag < 130; ++tag) {
        holds(tag, ">0001");
        reads.push_back(tag);
    }
    std::vector<Tag> rows = tags.all();
    for (const int tag : reads) rows.push_back(row(tag, TagType::word));
    tags = TagTable{rows};
    reads.push_back(kBare);
    layout(reads);
    run(60ms);

    EXPECT_TRUE(is_held()) << "before 30 words that have a row, which take longer than 1 s";
    run(3s);
    EXPECT_TRUE(inputs.every_input_tried);
    EXPECT_EQ(inputs.words[0], 1);
}

TEST_F(Scale, SilenceNeverHolds)
{
    drive.alive = false;
    layout({kBare}, {400});
    run(3s);

    EXPECT_TRUE(inputs.every_input_tried);
    EXPECT_FALSE(is_held());
}

TEST_F(Scale, WhatHasAnsweredHoldsAlsoWhenTheDriveIsSilentAfterwards)
{
    layout({kBare});
    run(500ms);
    drive.alive = false;
    run(5s);

    EXPECT_TRUE(is_held());
}

TEST_F(Scale, AnAnswerInHexadecimalEndsIt)
{
    layout({kBare});
    run(500ms);
    ASSERT_TRUE(is_held());
    holds(kBare, ">0042");
    run(11s);

    EXPECT_FALSE(is_held());
    EXPECT_EQ(inputs.words[0], 0x42);
    EXPECT_EQ(poller.snapshot(0).states[0], WordState::good);
    EXPECT_STREQ(poller.snapshot(0).answer_texts[0].data(), "");
}

TEST_F(Scale, ARowThatAReloadBringsIsTakenAtOnceAndTheExchangeBeginsWithItsWord)
{
    const auto row_with = [](bool confirmed, bool decimals_known) {
        Tag bare = row(kBare, TagType::number);
        bare.decimals = decimals_known ? 1 : 0;
        bare.decimals_known = decimals_known;
        bare.confirmed = confirmed;
        return TagTable{{bare}};
    };
    for (const bool was_confirmed : {false, true}) {
        const TagTable before = row_with(was_confirmed, !was_confirmed), now = row_with(true, true);
        poller.exchange({settings(before, {}, true)}, {0U}, {});
        layout({kBare});
        run(500ms);
        ASSERT_TRUE(is_held());
        ASSERT_EQ(inputs.words[0], 0);

        poller.exchange({settings(now, {}, true)}, {0U}, {});
        const Instant reload = line.time;
        while (is_held() && line.time < reload + 1s) run(1ms);

        EXPECT_FALSE(is_held());
        EXPECT_EQ(inputs.words[0], 75) << "the first image that lets it begin has the word";
        poller.exchange({settings(tags, {}, true)}, {0U}, {});
    }
}

TEST_F(Scale, ARowThatAReloadBringsEndsItAlsoWhileTheDriveIsSilent)
{
    layout({kBare});
    run(500ms);
    drive.alive = false;
    run(5s);
    ASSERT_TRUE(is_held());
    Tag scaled = row(kBare, TagType::number);
    scaled.decimals = 1;
    const TagTable now{{scaled}};

    poller.exchange({settings(now, {}, true)}, {0U}, {});
    run(100ms);

    EXPECT_FALSE(is_held()) << "silence never holds";
    EXPECT_EQ(poller.snapshot(0).states[0], WordState::stale);
    poller.exchange({settings(tags, {}, true)}, {0U}, {});
}

TEST_F(Scale, FoundOutLaterTheInputIsHeldAndMarkedAndTheOthersGoOn)
{
    holds(400, ">0007");
    layout({kNumber, 400}, {kNumber});
    run(1s);
    master_writes(2, 30);
    run(1s);
    ASSERT_EQ(inputs.words[1], 7);
    drive.alive = false; // it is replaced by one that has a number there
    run(3s);
    holds(400, "7.5");
    holds(kNumber, "1.5");
    drive.alive = true;
    run(15s);

    EXPECT_EQ(inputs.words[1], 7);
    EXPECT_EQ(poller.snapshot(0).errors[1], AccessError::no_scale);
    EXPECT_EQ(inputs.words[0], 30);
    EXPECT_EQ(held(kNumber), "3.") << "the other output is written";
}

TEST_F(Scale, AnOutputThatHasBecomeANumberIsNotWritten)
{
    holds(400, ">0007");
    layout({}, {400});
    run(500ms);
    master_writes(0, 0x1234);
    run(1s);
    drive.alive = false;
    run(3s);
    drive.parameters[mnemonic(400)] = {.text = "7.5"};
    drive.alive = true;
    run(30s);

    EXPECT_EQ(held(400), "7.5");
    EXPECT_EQ(writes_of(400), 0u);
    EXPECT_EQ(poller.snapshot(0).states[0], WordState::unscaled);
}

TEST_F(Scale, DemandDataForSuchATagIsRefusedReadAndWriteAndHoldsNothing)
{
    layout({kNumber});
    run(500ms);
    for (const auto kind : {DemandOrder::Kind::read, DemandOrder::Kind::write}) {
        DemandOrder order;
        order.kind = kind;
        order.tag = kBare;
        order.value = 5;
        order.number = kind == DemandOrder::Kind::read ? 1 : 2;
        order.generation = generation;
        poller.set_demand(0, order);
        run(500ms);
        const auto answer = poller.take_demand_answer(0);
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->error, AccessError::no_scale);
        while (poller.take_demand_answer(0)) {
        }
    }
    EXPECT_EQ(writes_of(kBare), 0u);
    EXPECT_FALSE(is_held());
}

TEST_F(Scale, ARowThatAnAnswerContradictsStaysRefused)
{
    layout({kNumber, kWord});
    run(500ms);
    ASSERT_EQ(inputs.words[0], 125);
    holds(kNumber, "12.34");
    run(500ms);
    ASSERT_EQ(inputs.words[0], 0);
    holds(kNumber, "12.5");
    run(60s);

    EXPECT_EQ(inputs.words[0], 0) << "not 125: the decimals are known to be wrong";
    EXPECT_EQ(poller.snapshot(0).errors[0], AccessError::contradicted);
    EXPECT_STREQ(poller.snapshot(0).answer_texts[0].data(), "12.34");
    EXPECT_EQ(inputs.words[1], 0x1B0B);
    EXPECT_FALSE(is_held());

    layout({kNumber}, {kNumber}); // another start-up does not make it true
    run(500ms);
    master_writes(1, 30);
    run(5s);
    EXPECT_EQ(inputs.words[0], 0);
    EXPECT_EQ(writes_of(kNumber), 0u);
}

TEST_F(Scale, ARowThatAnAnswerContradictsStaysRefusedThroughAReloadThatDoesNotChangeIt)
{
    layout({kNumber});
    run(500ms);
    holds(kNumber, "12.34");
    run(500ms);
    ASSERT_EQ(poller.snapshot(0).errors[0], AccessError::contradicted);
    holds(kNumber, "12.5");
    const TagTable same = table();
    DriveSettings other_key = settings(same, {}, true);
    other_key.output_refresh = 5s;

    poller.exchange({other_key}, {0U}, {});
    run(30s);
    EXPECT_EQ(inputs.words[0], 0);
    EXPECT_EQ(poller.snapshot(0).errors[0], AccessError::contradicted);
    EXPECT_STREQ(poller.snapshot(0).answer_texts[0].data(), "12.34");

    Tag two = row(kNumber, TagType::number);
    two.decimals = 2;
    const TagTable corrected{{two}};
    poller.exchange({settings(corrected, {}, true)}, {0U}, {});
    run(500ms);
    EXPECT_EQ(inputs.words[0], 1250);
    poller.exchange({settings(tags, {}, true)}, {0U}, {});
}

TEST_F(Scale, ADemandReadThatContradictsARowRefusesTheInputToo)
{
    layout({kNumber});
    run(500ms);
    holds(kNumber, "12.34");
    DemandOrder order{.kind = DemandOrder::Kind::read, .tag = kNumber, .number = 1, .generation = generation};
    poller.set_demand(0, order);
    run(40ms);
    holds(kNumber, "12.5");
    run(5s);

    EXPECT_EQ(inputs.words[0], 0);
    while (const auto answer = poller.take_demand_answer(0))
        EXPECT_EQ(answer->error, AccessError::contradicted);
}

class ScaleZero : public Scale {
protected:
    ScaleZero() : Scale({}, false) {}
};

TEST_F(ScaleZero, GoesOnWithTheInputAtZero)
{
    layout({kNumber, kBare});
    run(500ms);

    EXPECT_TRUE(inputs.every_input_tried);
    EXPECT_FALSE(is_held());
    EXPECT_EQ(inputs.words[1], 0);
    EXPECT_EQ(poller.snapshot(0).states[1], WordState::unscaled);
}

class ScaleUnlisted : public Scale {
protected:
    ScaleUnlisted() : Scale(2) {}
};

TEST_F(ScaleUnlisted, OneScaleForTagsWithoutARowButNotForARowWithoutDecimals)
{
    holds(400, "3.5");
    layout({400});
    run(500ms);
    EXPECT_FALSE(is_held());
    EXPECT_EQ(inputs.words[0], 350);

    layout({kBare});
    run(500ms);
    EXPECT_TRUE(is_held());
}

} // namespace
} // namespace dpslave::drive
