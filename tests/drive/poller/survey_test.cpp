// SPDX-License-Identifier: Apache-2.0
// A survey reads at the lowest priority, and nothing but its answer follows from it.
#include "poller_bench.hpp"

#include <gmock/gmock.h>

#include <optional>
#include <utility>

namespace dpslave::drive::test {
namespace {

using namespace std::chrono_literals;

using testing::Each;
using testing::SizeIs;

class PollerSurvey : public testing::Test {
protected:
    PollerSurvey() { drive().words = {{1, 11}, {2, 22}, {3, 33}}; }
    MemoryDrive& drive() { return bench.drives[0]; }

    /// Gives the next order as soon as the one before is answered, for so long.
    std::vector<OperateAnswer> survey(std::chrono::nanoseconds duration, std::uint16_t tag)
    {
        std::vector<OperateAnswer> answers;
        const Instant end = bench.now + duration;
        bench.poller.survey(0, 1, tag);
        while (bench.now < end) {
            if (!bench.step()) bench.now += 1ms;
            if (const auto answer = bench.poller.take_operate_answer()) {
                answers.push_back(*answer);
                bench.poller.survey(0, static_cast<std::uint32_t>(answers.size() + 1), tag);
            }
        }
        return answers;
    }
    /// How many reads for the master lie between two survey reads.
    std::vector<int> between_surveys() const
    {
        std::vector<int> counts;
        int count = 0;
        for (const Done& one : bench.log) {
            if (one.purpose == Purpose::input) ++count;
            if (one.purpose != Purpose::survey) continue;
            counts.push_back(std::exchange(count, 0));
        }
        return counts;
    }

    PollerBench bench{{DriveSettings{}, DriveSettings{}}};
};

TEST_F(PollerSurvey, takes_one_read_in_a_round_of_the_drive)
{
    bench.drives[1].alive = false;
    bench.run(5s); // the other drive is lost
    bench.layout(0, 1, {1, 2, 3});
    bench.run(200ms);
    bench.log.clear();

    const auto answers = survey(5s, 2);

    EXPECT_GT(answers.size(), 30u);
    EXPECT_THAT(answers, Each(testing::Field(&OperateAnswer::word, 22)));
    std::vector<int> counts = between_surveys();
    counts.erase(counts.begin()); // it began somewhere in a round
    EXPECT_THAT(counts, Each(testing::Ge(3)));
}

TEST_F(PollerSurvey, takes_one_read_in_a_round_of_all_the_living_drives_of_the_line)
{
    for (int tag = 1; tag <= 10; ++tag) bench.drives[1].words[tag] = 1;
    bench.layout(0, 1, {1});
    bench.layout(1, 1, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    bench.run(1s);
    bench.log.clear();

    survey(10s, 2);

    std::vector<int> counts = between_surveys();
    ASSERT_GT(counts.size(), 10u);
    counts.erase(counts.begin());
    EXPECT_THAT(counts, Each(testing::Ge(10)))
        << "not the short rounds of drive 0 count, but those of drive 1";
}

TEST_F(PollerSurvey, a_bare_drive_is_read_as_fast_as_it_answers)
{
    bench.run(1s); // no master
    const auto answers = survey(2s, 3);

    EXPECT_GT(answers.size(), 80u) << "2 s of reads of 20 ms";
}

TEST_F(PollerSurvey, silence_loses_no_drive_and_counts_nowhere)
{
    bench.layout(0, 1, {1});
    bench.layout(1, 1, {1});
    bench.drives[1].words = {{1, 1}};
    bench.run(1s);
    drive().silent_tags = {500};
    bench.log.clear();

    const auto answers = survey(10s, 500);

    EXPECT_GT(answers.size(), 20u);
    EXPECT_THAT(answers, Each(testing::Field(&OperateAnswer::error, AccessError::no_answer)));
    const DriveSnapshot& shown = bench.poller.snapshot(0);
    EXPECT_TRUE(shown.answers);
    EXPECT_EQ(shown.losses, 0u);
    EXPECT_EQ(shown.silences, 0u);
    for (const Done& one : bench.log) EXPECT_NE(one.purpose, Purpose::probe) << "no drive is in doubt";
}

TEST_F(PollerSurvey, a_denial_counts_nowhere)
{
    bench.layout(0, 1, {1});
    bench.run(1s);
    const std::uint64_t refusals = bench.poller.snapshot(0).refusals;
    survey(1s, 500); // it has no such tag
    EXPECT_EQ(bench.poller.snapshot(0).refusals, refusals);
    EXPECT_EQ(bench.poller.snapshot(0).errors[0], AccessError::none);
}

TEST_F(PollerSurvey, goes_on_finding_out_that_a_drive_has_died)
{
    bench.run(1s);
    drive().alive = false;

    const auto answers = survey(20s, 1);

    EXPECT_FALSE(bench.poller.snapshot(0).answers) << "the probes of an idle drive go on beside the survey";
    EXPECT_FALSE(answers.empty());
}

TEST_F(PollerSurvey, a_lost_drive_is_answered_for_at_once_and_not_asked)
{
    drive().alive = false;
    bench.run(5s);
    bench.log.clear();

    EXPECT_TRUE(bench.poller.survey(0, 7, 1));

    const auto answer = bench.poller.take_operate_answer();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->number, 7u);
    EXPECT_EQ(answer->error, AccessError::no_answer);
    EXPECT_THAT(bench.log, SizeIs(0));
}

TEST_F(PollerSurvey, one_order_waits_for_each_drive)
{
    EXPECT_TRUE(bench.poller.survey(0, 1, 1));
    EXPECT_FALSE(bench.poller.survey(0, 2, 2));
    EXPECT_TRUE(bench.poller.survey(1, 3, 1));
    EXPECT_FALSE(bench.poller.survey(2, 4, 1)) << "there is no such drive";
}

/// The transaction of the survey, whatever the poller does before it.
std::optional<Transaction> survey_read(PollerBench& bench)
{
    for (int i = 0; i < 20; ++i) {
        const auto transaction = bench.poller.next(bench.now);
        if (transaction && transaction->purpose == Purpose::survey) return transaction;
        if (transaction) bench.poller.done({AccessError::none, {}}, bench.now);
        bench.now += 10ms;
    }
    return std::nullopt;
}

TEST_F(PollerSurvey, a_tag_is_asked_by_the_rule_that_is_named)
{
    bench.poller.survey(0, 1, 55, MnemonicRule::pno);
    const auto by_rule = survey_read(bench);
    ASSERT_TRUE(by_rule);
    EXPECT_EQ(by_rule->tag->mnemonic, "37");
}

TEST_F(PollerSurvey, a_value_is_reported_as_the_drive_wrote_it_whatever_the_table_makes_of_it)
{
    bench.poller.survey(0, 1, 55);
    ASSERT_TRUE(survey_read(bench));
    bench.poller.done({.error = AccessError::no_scale, .words = {}, .answer = "-12.34"}, bench.now);

    const auto answer = bench.poller.take_operate_answer();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->error, AccessError::none);
    EXPECT_STREQ(answer->said.data(), "-12.34");
}

TEST_F(PollerSurvey, a_denial_is_reported_with_its_reason)
{
    bench.poller.survey(0, 1, 55);
    ASSERT_TRUE(survey_read(bench));
    bench.poller.done(
        {.error = AccessError::unsupported_type, .words = {}, .answer = {}, .trouble = "EE >04C8"},
        bench.now);

    const auto answer = bench.poller.take_operate_answer();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->error, AccessError::unsupported_type);
    EXPECT_STREQ(answer->said.data(), "EE >04C8");
}

TEST_F(PollerSurvey, what_could_not_be_asked_now_is_asked_in_a_later_round)
{
    bench.poller.survey(0, 1, 55);
    ASSERT_TRUE(survey_read(bench));
    bench.poller.done({AccessError::deferred, {}}, bench.now);
    EXPECT_FALSE(bench.poller.take_operate_answer());

    ASSERT_TRUE(survey_read(bench));
    bench.poller.done({.error = AccessError::none, .words = {}, .answer = "1."}, bench.now);
    EXPECT_TRUE(bench.poller.take_operate_answer());
}

TEST_F(PollerSurvey, asks_by_the_mnemonic_of_the_table_and_by_nothing_else_of_its_row)
{
    Tag text;
    text.number = 55;
    text.type = TagType::string;
    text.access = Access::write_only;
    text.mnemonic = "xy";
    const TagTable table{{text}};
    DriveSettings unit;
    unit.tags = &table;
    PollerBench other{{unit}};

    other.poller.survey(0, 1, 55);
    const auto read = survey_read(other);

    ASSERT_TRUE(read);
    EXPECT_EQ(read->kind, Transaction::Kind::read);
    EXPECT_EQ(read->tag->mnemonic, "xy");
    EXPECT_FALSE(read->tag->listed);
}

} // namespace
} // namespace dpslave::drive::test
