// SPDX-License-Identifier: Apache-2.0
/// Every answer of a drive belongs to its question: section 4 of the rules of the drive line, with random
/// transactions of both protocols. tools/run drive-line makes a million of each; from another seed on:
/// DRIVE_LINE_SEED=1000000; one run with its trace: DRIVE_LINE_ONLY=SEED.
#include "random_runs.hpp"
#include "support/count_of.hpp"
#include "unjudged_clients.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace dpslave::drive_line {
namespace {

constexpr std::uint64_t kTransactions = 30'000;

constexpr int kMostFindings = 5; ///< that are printed in full

/// Runs one after the other until there were enough transactions; the first finding is printed with its
/// trace.
template <class Run, class Make>
void expect_truth(const Run& run, const Make& make, RunOptions options = {},
                  std::uint64_t most = kTransactions)
{
    const std::uint64_t only = test::count_of("DRIVE_LINE_ONLY", 0);
    const std::uint64_t wanted = only != 0 ? 1 : test::count_of("DRIVE_LINE_TRANSACTIONS", most);
    std::uint64_t made = 0, runs = 0;
    int findings = 0;
    for (std::uint64_t seed = only != 0 ? only : test::count_of("DRIVE_LINE_SEED", 1); made < wanted;
         ++seed, ++runs) {
        options.traces = false;
        const RunResult result = run(seed, make, options);
        made += result.transactions;
        if (result.violation.empty()) continue;
        options.traces = true;
        ADD_FAILURE() << "seed " << seed << " after " << made
                      << " transactions: " << story(run(seed, make, options));
        if (++findings == kMostFindings) break;
    }
    testing::Test::RecordProperty("transactions", static_cast<int>(made));
    testing::Test::RecordProperty("runs", static_cast<int>(runs));
}

/// How many of the first `runs` seeds show a violation of this client.
template <class Run, class Make>
int runs_with_a_violation(const Run& run, const Make& make, std::uint64_t runs, RunOptions options = {})
{
    int count = 0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed)
        if (!run(seed, make, options).violation.empty()) ++count;
    return count;
}

TEST(EiAsciiAnswers, BelongToTheirQuestions)
{
    expect_truth(run_ei, ei_client);
}

TEST(ModbusAnswers, BelongToTheirQuestions)
{
    expect_truth(run_modbus, modbus_client);
}

/// Of an output whose row says `once`: with lost ACKs, noise, reloads, drives without power.
TEST(EiAsciiAnswers, AWordWhoseWritesCountIsNeverWrittenTwice)
{
    expect_truth(run_ei, ei_client, {.counts = true}, kTransactions / 5);
    expect_truth(run_ei, ei_client, {.counts = true, .silent = true}, kTransactions / 5);
}

TEST(ModbusAnswers, AWordWhoseWritesCountIsNeverWrittenTwice)
{
    expect_truth(run_modbus, modbus_client, {.counts = true}, kTransactions / 5);
    expect_truth(run_modbus, modbus_client, {.counts = true, .silent = true}, kTransactions / 5);
}

TEST(Judge, FindsThatAWordWhoseWritesCountIsWrittenTwiceWhereTheTableDoesNotSaySo)
{
    EXPECT_GE(runs_with_a_violation(run_ei, ei_client, 40, {.counts = true, .says_once = false}), 20);
    EXPECT_GE(runs_with_a_violation(run_modbus, modbus_client, 40, {.counts = true, .says_once = false}), 5);
}

TEST(Judge, FindsViolationsOfAClientThatTakesTheFirstAnswerThatLooksRight)
{
    EXPECT_GE(runs_with_a_violation(run_ei, unjudged_ei, 40), 20);
    EXPECT_GE(runs_with_a_violation(run_modbus, unjudged_modbus, 40), 10);
}

/// Drives that die, deny tags and refuse writes excuse no violation.
TEST(Judge, FindsNoViolationOfThatClientWhereNothingIsLateOrLost)
{
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        RunResult result = run_ei(seed, unjudged_ei, {.calm = true, .traces = true});
        EXPECT_EQ(result.violation, "") << "EI-ASCII, seed " << seed << ": " << story(result);
        result = run_modbus(seed, unjudged_modbus, {.calm = true, .traces = true});
        EXPECT_EQ(result.violation, "") << "Modbus, seed " << seed << ": " << story(result);
    }
}

// ---- what the judge has found, by the seed that found it

/// Noise that looks like an ACK answered a write of dpctl that the drive had refused.
TEST(FoundOnTheLine, AWriteOfTheOperatorIsDoneOnlyWhenTheDriveHoldsIt)
{
    EXPECT_EQ(run_ei(232, ei_client).violation, "");
}

/// The tag was denied as the write was read back, and that counted as its proof.
TEST(FoundOnTheLine, AWriteOfDemandDataThatIsDeniedBehindItsAckIsNotDone)
{
    EXPECT_EQ(run_ei(394, ei_client).violation, "");
}

/// A refused block was cut at a tag that was not read at present: refused again for ever.
TEST(FoundOnTheLine, ARefusedBlockIsCutUntilWhatTheDriveHasIsRead)
{
    EXPECT_EQ(run_modbus(12, modbus_client).violation, "");
    EXPECT_EQ(run_modbus(35, modbus_client).violation, "");
}

/// What waited in the port was judged when its debt had settled, and ended a younger one.
TEST(FoundOnTheLine, ADebtSettlesWhenAllThatHasComeIsJudged)
{
    EXPECT_EQ(run_modbus(100'741, modbus_client).violation, "");
}

/// Noise before the echo of a write passed for the echo, and the echo for the answer.
TEST(FoundOnTheLine, AnEchoBehindNoiseIsNotTheAnswerToAWrite)
{
    EXPECT_EQ(run_modbus(655, modbus_client).violation, "");
    EXPECT_EQ(run_modbus(900'681, modbus_client).violation, "");
}

/// A drive without II that owed V0 and EE was asked for these again and again, and owed them again each time.
TEST(FoundOnTheLine, ADriveIsNotAskedAgainForWhatItOwesUntilThatSettles)
{
    EXPECT_EQ(run_ei(500'303, ei_client).violation, "");
}

/// Noise that looked like the ACK of a write, and nothing valid behind it, was no silence: a station stayed.
TEST(FoundOnTheLine, NoiseInPlaceOfAnAckLetsNoStationStayWithoutItsDrive)
{
    EXPECT_EQ(run_ei(37, ei_client, {.counts = true, .silent = true}).violation, "");
}

/// The silence of a survey did not count, and a false EOT and its EE counted once: a station stayed too long.
TEST(FoundOnTheLine, EachQuestionWithoutAnAnswerCountsUntilTheDriveIsLost)
{
    EXPECT_EQ(run_modbus(2'001'486, modbus_client, {.counts = true, .silent = true}).violation, "");
    EXPECT_EQ(run_ei(2'002'285, ei_client, {.counts = true, .silent = true}).violation, "");
    EXPECT_EQ(run_ei(2'002'746, ei_client, {.counts = true, .silent = true}).violation, "");
}

/// A drive that had come back owed the answer to its zero, and was asked nothing else meanwhile.
TEST(FoundOnTheLine, ADriveThatIsBackIsAskedWhileItsZeroWaits)
{
    EXPECT_EQ(run_modbus(3'002'155, modbus_client, {.counts = true, .silent = true}).violation, "");
}

/// A late answer was taken for a question, one stayed owed, and so the next one was taken as well: it was
/// older than its question, and shown as good.
TEST(FoundOnTheLine, OfTwoAnswersThatMayBeOlderOnlyTheFirstIsShownAsGood)
{
    EXPECT_EQ(run_ei(2'000'238, ei_client, {.counts = true}).violation, "");
}

/// The zero after the loss of the master got lost, and noise looked like its ACK.
TEST(FoundOnTheLine, TheZeroAfterTheLossOfTheMasterIsThereWhenItCounts)
{
    EXPECT_EQ(run_ei(900'468, ei_client).violation, "");
}

} // namespace
} // namespace dpslave::drive_line
