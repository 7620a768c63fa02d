// SPDX-License-Identifier: Apache-2.0
// A machine that is busy, full or not listened to, and many stations.
// Only here: a machine that has no time, and a log that takes nothing.
#include "fault_row.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <list>

namespace dpslave::test {
namespace {

/// Needs the machine: no other row runs beside it.
class LoadRow : public FaultRow {};

TEST_F(LoadRow, F33_OfFourProcessesThatWantEachProcessorCostsNoLateReply)
{
    begins(wiring_of("ei-ascii"), master_of("ei-ascii", {"--retries", "3"}));
    std::list<Process> hogs;
    for (int i = 0; i < 4; ++i) hogs.emplace_back(Arguments{"/bin/sh", "-c", "while :; do :; done"});
    const std::uint64_t before = replies.replies();
    for (int value = 2; value <= 6; ++value) {
        drive_shows(value);
        EXPECT_TRUE(master_wants(value));
        EXPECT_TRUE(drive_takes(value));
        EXPECT_TRUE(master_sees(value));
    }
    EXPECT_TRUE(eventually([&] { return replies.replies() > before + 300; }));
    EXPECT_EQ(gateway->station().at("state"), "Data_Exch");

    for (Process& one : hogs) one.end(SIGKILL);
    fault_ends();
    EXPECT_TRUE(master_wants(7));
    EXPECT_TRUE(drive_takes(7));
    recovered();
    EXPECT_TRUE(never_an_older_one(taken()));
    EXPECT_TRUE(never_an_older_one(seen()));
}

/// 32 stations in Data_Exch. A master takes one after the other, so the watchdog is off in all but the last.
class RowOfManyStations : public LoadRow, public ::testing::WithParamInterface<const char*> {
protected:
    static constexpr std::size_t kStations = 32, kDead = 7;
    static constexpr const char* kDeadUnit = "unit 07";

    void begins_with_all()
    {
        Wiring wiring = wiring_of("ei-ascii");
        wiring.units.clear();
        wiring.when_drive_lost = GetParam();
        wiring.output_refresh_s = "10"; // 64 outputs at the pace of the other rows: too many for one line
        for (unsigned i = 0; i < kStations; ++i) wiring.units.push_back(unit(i));
        installs(std::move(wiring));
        for (unsigned i = 0; i < kStations; ++i) ASSERT_NO_FATAL_FAILURE(gets(i, 1));
    }
    /// What the master wants of a station comes to its drive.
    void gets(unsigned station, int value)
    {
        SCOPED_TRACE(station);
        Master one{*gateway, master_of("ei-ascii", {"--no-watchdog"}), 5 + station};
        ASSERT_TRUE(one.does("start 30s"));
        ASSERT_TRUE(one.does(fmt::format("out 1 = {}", value)));
        ASSERT_TRUE(gateway->drive().says(fmt::format("unit {}: tag 56 written {}", unit(station), value)));
        ASSERT_TRUE(one.does("stop"));
        ASSERT_TRUE(one.leaves());
    }
    void the_last_has_a_master_that_stays()
    {
        master.emplace(*gateway, master_of("ei-ascii"), 5 + kStations - 1);
        ASSERT_TRUE(master->does("start 30s"));
    }
    static bool is_silent() { return std::string{GetParam()} == "silent"; }
    static std::string unit(std::size_t station) { return fmt::format("{}{}", station / 8, station % 8); }
    /// That each drive but the dead one is soon read `more` times again.
    ::testing::AssertionResult others_are_read(int more) const
    {
        const auto reads = [&] {
            std::vector<int> all;
            const Json stations = gateway->json({"status"}).at("stations");
            for (const Json& one : stations) all.push_back(one.at("drive").at("reads"));
            return all;
        };
        const std::vector<int> before = reads();
        return eventually([&] {
            const std::vector<int> now = reads();
            for (std::size_t i = 0; i < kStations; ++i)
                if (i != kDead && now.at(i) < before.at(i) + more) return false;
            return true;
        });
    }
};

TEST_P(RowOfManyStations, F34_WithOneDeadDriveServesTheOther31)
{
    ASSERT_NO_FATAL_FAILURE(begins_with_all());
    ASSERT_TRUE(others_are_read(2));

    gateway->drive().send_line(kDeadUnit);
    gateway->drive().send_line("silence");
    EXPECT_TRUE(gateway->daemon().says("drive07: the drive does not answer"));
    gateway->drive().send_line("unit all");
    for (unsigned i = 0; i < kStations; ++i) {
        if (i == kDead) continue;
        ASSERT_NO_FATAL_FAILURE(gets(i, 2));
    }
    the_last_has_a_master_that_stays();
    for (int value = 3; value <= 5; ++value) {
        drive_shows(value);
        EXPECT_TRUE(master_sees(value));
        EXPECT_TRUE(master_wants(value));
        EXPECT_TRUE(gateway->drive().says(fmt::format("unit {}: tag 56 written {}", unit(31), value)));
    }
    EXPECT_TRUE(others_are_read(5));
    const std::string state = is_silent() ? "Power_On" : "Data_Exch";
    EXPECT_TRUE(eventually([&] { return gateway->station(kDead).at("state") == state; }));
    const Json stations = gateway->json({"status"}).at("stations");
    for (std::size_t i = 0; i < kStations; ++i) {
        EXPECT_EQ(stations.at(i).at("state"), i == kDead ? state : "Data_Exch") << i;
        EXPECT_EQ(stations.at(i).at("drive").at("losses"), i == kDead ? 1 : 0) << i;
    }
    EXPECT_TRUE(doctor_names("drive.silent"));

    gateway->drive().send_line(kDeadUnit);
    gateway->drive().skip();
    gateway->drive().send_line("ok");
    fault_ends();
    EXPECT_TRUE(
        gateway->drive().says(is_silent() ? "unit 07: tag 56 written 0" : "unit 07: tag 56 written 1"));
    recovered();
    EXPECT_TRUE(doctor_names("drive.silent", false));
}

INSTANTIATE_TEST_SUITE_P(When, RowOfManyStations, ::testing::Values("hold", "silent", "diagnosis"),
                         [](const auto& one) { return std::string{one.param}; });

class RowOfTheLog : public FaultRow {
protected:
    /// The daemon, with its standard error led to `where`.
    void begins_with_log_to(const std::string& where)
    {
        Wiring wiring = wiring_of("ei-ascii");
        wiring.log_to = where;
        begins(std::move(wiring), master_of("ei-ascii"));
    }
    /// Makes a line of the log, as each change by an operator does.
    ::testing::AssertionResult operator_writes(int value)
    {
        const Outcome done = gateway->dpctl({"write", "58", std::to_string(value)});
        if (done.status == 0) return ::testing::AssertionSuccess();
        return ::testing::AssertionFailure() << done.err;
    }
    void both_sides_work(int value)
    {
        drive_shows(value);
        EXPECT_TRUE(master_wants(value));
        EXPECT_TRUE(drive_takes(value));
        EXPECT_TRUE(master_sees(value));
        EXPECT_TRUE(master_stays_in_data_exchange());
    }
    std::uint64_t losses() const { return gateway->counter("unwinder", "drive_losses"); }
    /// A line is for one of them, and for so many more as it says.
    std::uint64_t losses_in_the_log()
    {
        std::uint64_t sum = 0;
        for (const std::string& line : gateway->daemon().transcript().lines()) {
            if (line.find("the drive does not answer") == std::string::npos) continue;
            const auto more = line.rfind('(');
            sum += more == std::string::npos ? 1 : std::stoul(line.substr(more + 1));
        }
        return sum;
    }
};

TEST_F(RowOfTheLog, F25_OnAFullDiskLosesItsLinesAndNothingElse)
{
    begins_with_log_to("/dev/full");
    for (int value = 2; value <= 4; ++value) {
        EXPECT_TRUE(operator_writes(value));
        both_sides_work(value);
    }
    EXPECT_EQ(gateway->dpctl({"status"}).status, 0);
    fault_ends();
    both_sides_work(5);
    recovered();
    EXPECT_TRUE(never_an_older_one(taken()));
}

TEST_F(RowOfTheLog, F35_IsNotFloodedByATroubleThatComesAgainAndAgain)
{
    begins(wiring_of("ei-ascii"), master_of("ei-ascii", {"--no-watchdog"}));
    master_leaves_the_bus();
    {
        Master foreign{*gateway, master_of("ei-ascii", {"--master", "3", "--retries", "15"})};
        gateway->drive().send_line("lose 1/2"); // a loose plug
        for (int i = 0; i < 200; ++i)
            EXPECT_TRUE(foreign.does("set-prm B8 01 64 0B 05 33 01" + std::string(48, '0')));
        EXPECT_TRUE(foreign.leaves());
    }
    EXPECT_TRUE(eventually([&] { return gateway->counter("unwinder", "foreign_prm") >= 200; }));
    EXPECT_TRUE(eventually([&] { return losses() >= 3; }));
    gateway->drive().send_line("ok");
    EXPECT_EQ(taken().back(), 1);
    fault_ends();
    master.emplace(*gateway, settings());
    ASSERT_TRUE(master->does("start 30s"));
    EXPECT_TRUE(master_wants(2));
    EXPECT_TRUE(drive_takes(2));
    recovered();

    EXPECT_TRUE(eventually([&] { return losses_in_the_log() == losses(); }))
        << losses_in_the_log() << " of " << losses();
    EXPECT_EQ(Reader{gateway->daemon().transcript()}.how_often("master 3 tried to parameterise"), 1U);
    EXPECT_LT(gateway->daemon().transcript().size(), 40U)
        << "lines of the log for 200 Set_Prm and a loose plug";
}

TEST_F(RowOfTheLog, F36_ThatNobodyReadsHoldsNoThreadUpAndSaysAfterwardsHowManyLinesAreLost)
{
    const std::string pipe = folder / "log";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    ASSERT_GT(::fcntl(reader, F_SETPIPE_SZ, 4096),
              0); // full after some twenty lines, what waits for it after some hundred
    begins_with_log_to(pipe);
    for (int value = 0; value < 250; ++value) EXPECT_TRUE(operator_writes(value));
    both_sides_work(2);
    gateway->drive().send_line("silence"); // a thread of a drive line has something to say, too
    EXPECT_TRUE(doctor_names("drive.silent"));
    gateway->drive().send_line("ok");
    both_sides_work(3);

    fault_ends();
    std::string log;
    EXPECT_TRUE(eventually([&] {
        std::array<char, 4096> part{};
        for (ssize_t got = 0; (got = ::read(reader, part.data(), part.size())) > 0;)
            log.append(part.data(), static_cast<std::size_t>(got));
        EXPECT_TRUE(operator_writes(99));
        return log.find("line(s) of the log were lost: what reads it had stopped") != std::string::npos;
    }));
    recovered();
    both_sides_work(4);
    EXPECT_TRUE(never_an_older_one(taken()));
    ::close(reader);
}

} // namespace
} // namespace dpslave::test
