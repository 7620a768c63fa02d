// SPDX-License-Identifier: Apache-2.0
/// Rows of the fault matrix on the simulated clock: a cable that is pulled for long, bit errors on it, one
/// dead drive of many.
#include "random_runs.hpp"
#include "support/bit_line.hpp"
#include "support/row.hpp"

#include <gtest/gtest.h>

#include <map>
#include <optional>

namespace dpslave::drive_line {
namespace {

constexpr unsigned kAlways = 10'000; // in parts of 10'000
constexpr std::uint16_t kInput = 100, kOutput = 110;

/// A calm line with so many drives; each master reads one tag and writes one.
template <class Line>
class LineBench {
public:
    template <class Make>
    LineBench(std::size_t drives, const Make& make, bool is_modbus)
    {
        conditions_.drives = drives;
        add_drives(line, conditions_, is_modbus);
        for (SimulatedDrive& drive : line.drives) drive.has_loopback = drive.knows_identity = true;
        tables_ = tables_of(line);
        backend_ = make(line, conditions_);
        RunRules rules;
        rules.masters_act = false;
        rules.compare_outputs = is_modbus;
        run.emplace(line, *backend_, tables_, rules);
        for (std::size_t i = 0; i < drives; ++i) {
            run->enter(i, {{kInput, true, false}, {kOutput, false, true}});
            run->change(i);
        }
    }
    std::uint16_t held(std::size_t drive = 0) { return line.drives[drive].find(kOutput)->now().word; }
    std::uint16_t wanted(std::size_t drive = 0) { return run->image(drive).words[1]; }
    /// The drive holds what its master wants and its input is good.
    bool works(std::size_t drive = 0)
    {
        const drive::UnitSnapshot& seen = run->seen(drive);
        return seen.answers && held(drive) == wanted(drive) && seen.states[0] == WordState::good;
    }
    /// How long it takes until then, at most `limit`.
    Time until_it_works(Time limit)
    {
        const Instant began = line.time;
        while (!works() && line.time < began + limit && !run->violation()) run->live(run->transactions() + 1);
        return line.time - began;
    }

private:
    Chance chance_{7};
    Conditions conditions_;
    std::vector<drive::TagTable> tables_;
    std::unique_ptr<drive::Backend> backend_;

public:
    Line line{conditions_.line, chance_};
    std::optional<LineRun> run;
};

template <class Line, class Make>
void cable_is_pulled(const Make& make, bool is_modbus)
{
    for (const Time pulled : {Time{10ms}, Time{1s}, Time{10s}, Time{60s}, Time{600s}}) {
        SCOPED_TRACE(std::chrono::duration<double>{pulled}.count());
        LineBench<Line> bench{1, make, is_modbus};
        bench.run->live_for(20s);
        ASSERT_TRUE(bench.works());
        const std::uint16_t last = bench.held();

        bench.line.faults.question_lost = kAlways;
        for (int change = 0; change < 5; ++change) {
            bench.run->change(0);
            bench.run->live_for(pulled / 5);
            EXPECT_TRUE(pulled < 1s || bench.held() == last) << "the last value stands in the drive";
        }
        EXPECT_TRUE(pulled < 10s || !bench.run->seen(0).answers) << "the operator is told";

        bench.line.faults = {};
        const Time took = bench.until_it_works(60s);
        EXPECT_TRUE(bench.works()) << "after " << took.count() << " ns";
        test::recovered_in(took);
        bench.run->live_for(20s); // repeats carry the same value: the judge looks
        EXPECT_FALSE(bench.run->violation()) << *bench.run->violation();
    }
}

TEST(PulledCable, F02_OfAnEiAsciiDriveForTenMinutesLeavesTheLastValueAndNoOlderOneComesAfterIt)
{
    cable_is_pulled<EiLine>(ei_client, false);
}

TEST(PulledCable, F02_OfAModbusDriveForTenMinutesLeavesTheLastValueAndNoOlderOneComesAfterIt)
{
    cable_is_pulled<ModbusFrames>(modbus_client, true);
}

/// Octets in both directions over a line with bit errors, 7E1. A drive says nothing to a question with a bad
/// character; here an octet with wrong parity comes as 00 (SerialLine).
class EiLineWithBitErrors final : public drive::SerialLine {
public:
    EiLineWithBitErrors(EiLine& line, double errors) : line_(line), there_(errors, 7, 1), back_(errors, 7, 2)
    {}

    bool write(Bytes octets) override
    {
        Octets arrived;
        bool good = true;
        for (const auto& one : there_.received({octets.begin(), octets.end()})) {
            good = good && one.good;
            arrived.push_back(one.octet);
        }
        return !good || line_.write(arrived);
    }
    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override
    {
        const Instant until = line_.now() + timeout;
        while (waiting_.empty()) {
            std::array<std::uint8_t, 64> part{};
            const std::size_t got = line_.read(part, until - line_.now());
            if (got == 0) return 0;
            for (const auto& one :
                 back_.received({part.begin(), part.begin() + static_cast<std::ptrdiff_t>(got)}))
                waiting_.push_back(one.good ? one.octet : std::uint8_t{0});
        }
        std::size_t given = 0;
        for (; given < into.size() && !waiting_.empty(); ++given) {
            into[given] = waiting_.front();
            waiting_.pop_front();
        }
        return given;
    }
    Instant now() const override { return line_.now(); }
    void discard() override
    {
        waiting_.clear();
        line_.discard();
    }
    void heal()
    {
        there_.heal();
        back_.heal();
    }
    std::uint64_t hits() const { return there_.hits() + back_.hits(); }

private:
    EiLine& line_;
    ::test::BitLine there_, back_;
    std::deque<std::uint8_t> waiting_;
};

class BitErrorsOfALine : public testing::TestWithParam<double> {};

TEST_P(BitErrorsOfALine, F09_NeverShowAValueThatTheDriveDidNotHoldNorWriteOneThatNobodyWanted)
{
    std::optional<EiLineWithBitErrors> noisy;
    LineBench<EiLine> bench{2,
                            [&](EiLine& line, const Conditions& conditions) {
                                noisy.emplace(line, GetParam());
                                return ei_client_on(*noisy, line, conditions);
                            },
                            false};
    for (int change = 0; change < 2'000 && !bench.run->violation(); ++change) {
        bench.run->change(static_cast<std::size_t>(change) % 2);
        bench.run->live_for(300ms);
    }
    EXPECT_FALSE(bench.run->violation()) << *bench.run->violation();
    EXPECT_GT(noisy->hits(), 0U) << "or nothing was shown";

    noisy->heal();
    bench.run->change(0);
    test::recovered_in(bench.until_it_works(60s));
    EXPECT_TRUE(bench.works());
    EXPECT_FALSE(bench.run->violation()) << *bench.run->violation();
}

INSTANTIATE_TEST_SUITE_P(OneIn, BitErrorsOfALine, testing::Values(1e-6, 1e-5, 1e-4, 1e-3, 1e-2),
                         [](const auto& one) { return fmt::format("{:.0f}", 1 / one.param); });

/// Reads of all drives but one within a minute.
std::uint64_t reads_of_others(LineBench<EiLine>& bench, std::size_t drives, std::size_t left_out)
{
    const auto all = [&] {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < drives; ++i)
            if (i != left_out) sum += bench.run->seen(i).reads;
        return sum;
    };
    const std::uint64_t before = all();
    bench.run->live_for(60s);
    return all() - before;
}

TEST(DeadDriveOfMany, F34_CostsTheOthersLessThanATenthOfTheirReads)
{
    constexpr std::size_t kDrives = 9, kDead = 4;
    LineBench<EiLine> bench{kDrives, ei_client, false};
    bench.run->live_for(20s);
    const std::uint64_t before = reads_of_others(bench, kDrives, kDead);
    bench.line.dies(kDead);
    bench.run->live_for(20s);
    EXPECT_FALSE(bench.run->seen(kDead).answers);
    EXPECT_GT(reads_of_others(bench, kDrives, kDead), before * 9 / 10);
    for (std::size_t i = 0; i < kDrives; ++i) EXPECT_EQ(bench.run->seen(i).losses, i == kDead ? 1U : 0U);
    EXPECT_FALSE(bench.run->violation()) << *bench.run->violation();

    bench.line.returns(kDead, false);
    const Instant returned = bench.line.time;
    while (!bench.works(kDead) && bench.line.time < returned + 60s)
        bench.run->live(bench.run->transactions() + 1);
    EXPECT_TRUE(bench.works(kDead));
    test::recovered_in(bench.line.time - returned);
}

} // namespace
} // namespace dpslave::drive_line
