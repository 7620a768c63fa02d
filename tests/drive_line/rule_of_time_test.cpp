// SPDX-License-Identifier: Apache-2.0
/// The rule of time on a line with two drives that have the same tags: a duplicate that comes by itself,
/// shortly behind an answer, is not taken for the answer to the next question. The figures of
/// drive-answers.md: test_drive_line --gtest_filter='RuleOfTimeFigures.*'
#include "random_runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace dpslave::drive_line {
namespace {

constexpr std::uint64_t kSeeds = 20;

template <class Run, class Make>
int violated(const Run& run, const Make& make, bool wire_time)
{
    RunOptions options;
    options.repeating = true;
    options.wire_time = wire_time;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RunResult result = run(seed, make, options);
        if (!result.violation.empty()) ++count;
        EXPECT_TRUE(!wire_time || result.violation.empty()) << "seed " << seed << ": " << result.violation;
    }
    return count;
}

TEST(RuleOfTimeOfALine, RefusesEachDuplicateThatBeganBeforeTheQuestionHadLeft)
{
    EXPECT_EQ(violated(run_ei, ei_client, true), 0);
    EXPECT_EQ(violated(run_modbus, modbus_client, true), 0);
}

TEST(RuleOfTimeOfALine, WithoutItTheseDuplicatesBecomeWordsOfOtherDrivesAndTags)
{
    EXPECT_GE(violated(run_ei, ei_client, false), 15);
    EXPECT_GE(violated(run_modbus, modbus_client, false), 15);
}

// ---- figures

/// Two drives whose tag 100 holds another word each, asked in turn; one answer in ten comes again after
/// `behind`. Of so many reads how many gave the word of the other drive?
int wrong_reads(std::uint32_t baud, Time behind, Time turnaround, bool wire_time)
{
    constexpr int kReads = 1'000;
    Conditions conditions;
    conditions.drives = 2;
    conditions.baud = baud;
    conditions.line.character = Time{10'000'000'000 / baud};
    conditions.line.turnaround = turnaround;
    conditions.line.wire_time = wire_time;
    Chance chance{1};
    EiLine line{conditions.line, chance};
    add_drives(line, conditions, false);
    for (SimulatedDrive& drive : line.drives) drive.stands_still();
    line.faults.isolated = 1'000;
    line.faults.isolated_from = line.faults.isolated_to = behind;
    line.faults.beyond_time = true;
    const auto tables = tables_of(line);
    const auto client = ei_client(line, conditions);
    int wrong = 0;
    for (int i = 0; i < kReads; ++i) {
        SimulatedDrive& drive = line.drives[static_cast<std::size_t>(i % 2)];
        const drive::Tag& tag = *tables[0].find(100);
        std::uint16_t word = 0;
        const AccessError error = client->read({0, drive.unit}, tag, {&word, 1});
        if (error == AccessError::none && word != drive.find(100)->now().word) ++wrong;
    }
    return wrong;
}

/// Of 1000 reads, at 9600, 19200 and 38400 bit/s, drives that answer after 5 to 10 and after 20 to 40 ms.
TEST(RuleOfTimeFigures, ForTheDocument)
{
    fmt::print(
        "bit/s  answers after  ms behind an answer: words of the other drive without the rule -> with it\n");
    for (const std::uint32_t baud : {9'600U, 19'200U, 38'400U}) {
        for (const Time turnaround : {5ms, 20ms}) {
            std::string line =
                fmt::format("{:5}  {:2} to {:2} ms   ", baud, turnaround / 1ms, turnaround * 2 / 1ms);
            for (const Time behind : {1ms, 2ms, 5ms, 10ms, 20ms, 50ms}) {
                const int without = wrong_reads(baud, behind, turnaround, false);
                const int with = wrong_reads(baud, behind, turnaround, true);
                const Time question = 8 * Time{10'000'000'000 / baud};
                EXPECT_TRUE(with == 0 || behind > question - Time{20'000'000'000 / baud}) << behind / 1ms;
                line += fmt::format("  {}: {} -> {}", behind / 1ms, without, with);
            }
            fmt::print("{}\n", line);
        }
    }
}

} // namespace
} // namespace dpslave::drive_line
