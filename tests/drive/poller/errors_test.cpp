// SPDX-License-Identifier: Apache-2.0
/// Why an access failed, parameter by parameter (B-052, B-053, B-088, X-34), and tags that are never written.
#include "drive/consistent.hpp"
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::is_consistent;
using test::kRefusals;
using test::PollerBench;
using test::Refusal;
using namespace std::chrono_literals;

class PollerErrors : public testing::Test {
protected:
    explicit PollerErrors(bool only_from_table = false)
        : tags(make_tags()), bench({settings(tags, only_from_table)})
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
        drive().words[199] = 5;
    }
    static TagTable make_tags()
    {
        std::vector<Tag> rows = test::table_up_to(99).all();
        rows[90].access = Access::read_only;
        rows[92].type = TagType::string;
        rows[70].when = WritableWhen::stopped;
        rows[71].when = WritableWhen::configuration;
        rows[70].min = rows[71].min = 0;
        rows[70].max = rows[71].max = 100;
        return TagTable{rows};
    }
    static DriveSettings settings(const TagTable& tags, bool only_from_table)
    {
        DriveSettings one;
        one.tags = &tags;
        one.tags_only_from_table = only_from_table;
        one.never_written = {50, 199};
        return one;
    }
    /// One parameter that is both read and written.
    void reads_and_writes(int tag)
    {
        bench.layout(0, ++generation, {tag});
        bench.images[0].layout.generation = ++generation;
        bench.images[0].layout.parameters[0].writes = true;
        bench.master_writes(0, tag, 5);
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    const DriveSnapshot& seen() { return bench.poller.snapshot(0); }

    TagTable tags;
    PollerBench bench;
    Generation generation = 0;
};

TEST_F(PollerErrors, OfAReadAreThoseOfTheLastAccess)
{
    for (const Refusal& one : kRefusals) {
        drive().read_errors = {{5, one.error}};
        bench.layout(0, ++generation, {5, 6});
        EXPECT_EQ(seen().errors[0], AccessError::none) << "untried";
        bench.run(500ms);
        EXPECT_EQ(seen().errors[0], one.error);
        EXPECT_EQ(seen().states[0], one.state);
        EXPECT_EQ(seen().errors[1], AccessError::none);
        EXPECT_TRUE(is_consistent(seen()));
        drive().read_errors.clear();
        bench.run(11s);
        EXPECT_EQ(seen().errors[0], AccessError::none) << "it works again";
        EXPECT_TRUE(is_consistent(seen()));
    }
}

TEST_F(PollerErrors, OfAWriteAreThoseOfTheLastAccess)
{
    for (const Refusal& one : kRefusals) {
        drive().write_errors = {{10, one.error}};
        bench.layout(0, ++generation, {6}, {10});
        bench.master_writes(0, 10, 5);
        bench.run(500ms);
        EXPECT_EQ(seen().errors[1], one.error);
        EXPECT_EQ(seen().states[1], one.state);
        EXPECT_EQ(seen().errors[0], AccessError::none) << "data exchange goes on";
        EXPECT_TRUE(is_consistent(seen()));
        drive().write_errors.clear();
        bench.run(11s);
        EXPECT_EQ(seen().errors[1], AccessError::none);
        EXPECT_EQ(drive().words[10], 5);
        EXPECT_TRUE(is_consistent(seen()));
    }
}

/// B-053: a drive says EE 05 or 08 for them too, an instrument exception 2 or 3; the table knows more.
TEST_F(PollerErrors, OfAWriteThatTheDriveTakesInOneStateOnlyNameTheState)
{
    struct Case {
        int tag, word;
        AccessError said, meant;
    };
    using E = AccessError;
    for (const Case& one : {Case{70, 5, E::read_only, E::not_stopped},
                            {70, 5, E::out_of_range, E::not_stopped},
                            {71, 100, E::read_only, E::not_config_mode},
                            {71, 100, E::out_of_range, E::not_config_mode},
                            {70, 101, E::out_of_range, E::out_of_range},
                            {71, 101, E::read_only, E::not_config_mode},
                            {70, 5, E::invalid_tag, E::invalid_tag},
                            {72, 5, E::read_only, E::read_only}}) {
        drive().write_errors = {{one.tag, one.said}};
        bench.layout(0, ++generation, {6}, {one.tag});
        bench.master_writes(0, one.tag, one.word);
        bench.run(500ms);
        EXPECT_EQ(seen().errors[1], one.meant) << "cyclic";

        bench.poller.set_demand(0, {DemandOrder::Kind::write, static_cast<std::uint16_t>(one.tag),
                                    static_cast<std::uint16_t>(one.word), 1, generation});
        bench.run(200ms);
        const auto answer = bench.poller.take_demand_answer(0);
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->error, one.meant) << "Demand Data";

        EXPECT_TRUE(bench.poller.operate({.number = 1,
                                          .unit = 0,
                                          .is_write = true,
                                          .tag = static_cast<std::uint16_t>(one.tag),
                                          .word = static_cast<std::uint16_t>(one.word)}));
        bench.run(200ms);
        EXPECT_EQ(bench.poller.take_operate_answer()->error, one.meant) << "dpctl";
    }
}

TEST_F(PollerErrors, OfAReadAreNeverAboutTheStateForWrites)
{
    drive().read_errors = {{70, AccessError::read_only}};
    bench.layout(0, ++generation, {70});
    bench.run(500ms);
    EXPECT_EQ(seen().errors[0], AccessError::read_only);
}

TEST_F(PollerErrors, OfAParameterThatIsReadAndWrittenTheRefusalOfTheWriteComesFirst)
{
    for (const Refusal& one : kRefusals) {
        drive().write_errors = {{10, one.error}};
        drive().read_errors = {{10, AccessError::not_config_mode}};
        reads_and_writes(10);
        bench.run(500ms);
        EXPECT_EQ(seen().errors[0], one.error);
        EXPECT_EQ(seen().states[0], one.state);
        drive().write_errors.clear();
        bench.run(10s + 500ms);
        EXPECT_EQ(seen().errors[0], AccessError::not_config_mode) << "else that of the read";
        EXPECT_EQ(seen().states[0], WordState::refused);
        EXPECT_TRUE(is_consistent(seen()));
        drive().read_errors.clear();
    }
}

TEST_F(PollerErrors, SayNoAnswerWhileTheDriveIsLostExceptWhereItHasNoSuchTag)
{
    drive().words.erase(6);
    bench.layout(0, 1, {5, 6}, {10});
    bench.master_writes(0, 10, 5);
    bench.run(1s);
    drive().alive = false;
    bench.run(2s);
    EXPECT_EQ(seen().errors[0], AccessError::no_answer);
    EXPECT_EQ(seen().errors[1], AccessError::invalid_tag);
    EXPECT_EQ(seen().errors[2], AccessError::no_answer);
    EXPECT_TRUE(is_consistent(seen()));
    drive().alive = true;
    for (int i = 0; i < 20; ++i) {
        bench.run(200ms);
        EXPECT_TRUE(is_consistent(seen()));
    }
    EXPECT_EQ(seen().errors[0], AccessError::none);
    EXPECT_EQ(seen().errors[2], AccessError::none);
}

TEST_F(PollerErrors, OfTheTableAreKnownAtOnce)
{
    bench.layout(0, 1, {92}, {90});
    EXPECT_EQ(seen().errors[0], AccessError::unsupported_type);
    EXPECT_EQ(seen().errors[1], AccessError::read_only);
    EXPECT_TRUE(is_consistent(seen()));
}

TEST_F(PollerErrors, BeginAnewWithALayout)
{
    drive().words.erase(5);
    bench.layout(0, 1, {5});
    bench.run(500ms);
    EXPECT_EQ(seen().errors[0], AccessError::invalid_tag);
    bench.layout(0, 2, {6});
    EXPECT_EQ(seen().errors[0], AccessError::none);
}

// ---- tags that are never written

TEST_F(PollerErrors, ATagThatIsNeverWrittenIsReadOnlyOnEveryWay)
{
    for (const int tag : {50, 199}) { // one of the table, and one that is in none
        bench.layout(0, ++generation, {tag}, {tag});
        bench.master_writes(0, tag, 1);
        bench.poller.set_demand(
            0, {DemandOrder::Kind::write, static_cast<std::uint16_t>(tag), 1, generation, generation});
        EXPECT_EQ(bench.poller.take_demand_answer(0)->error, AccessError::read_only);
        EXPECT_TRUE(bench.poller.operate(
            {.number = 1, .unit = 0, .is_write = true, .tag = static_cast<std::uint16_t>(tag), .word = 1}));
        EXPECT_EQ(bench.poller.take_operate_answer()->error, AccessError::read_only);
        bench.run(3s);
        bench.master_leaves(0);
        bench.run(3s);
        EXPECT_EQ(bench.writes_of(tag), 0u);
        EXPECT_EQ(seen().states[1], WordState::read_only);
        EXPECT_EQ(seen().errors[1], AccessError::read_only);
        EXPECT_EQ(seen().states[0], WordState::good) << "it may be read";
    }
}

class PollerErrorsOfListedTags : public PollerErrors {
protected:
    PollerErrorsOfListedTags() : PollerErrors(true) {}
};

TEST_F(PollerErrorsOfListedTags, ATagThatIsNeverWrittenIsReadOnlyThoughItIsInNoTable)
{
    bench.layout(0, 1, {199}, {199});
    EXPECT_EQ(seen().errors[0], AccessError::invalid_tag);
    EXPECT_EQ(seen().errors[1], AccessError::read_only);
}

} // namespace
} // namespace dpslave::drive
