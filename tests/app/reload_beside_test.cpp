// SPDX-License-Identifier: Apache-2.0
/// A reload whose disk or name service hangs. The thread beside the main thread is real, the clock of the
/// main thread is the test's.
#include "reload_bench.hpp"

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using control::Json;
using test::kGood;
using testing::AllOf;
using testing::HasSubstr;

class ReloadBeside : public test_reload::ReloadBench {};

TEST_F(ReloadBeside, AsksForTheGroupOnceAndIsAnswered)
{
    change_file();
    auto caller = call();

    const Json reply = answer_to(caller);

    EXPECT_EQ(reply.at("applied"), true) << reply;
    EXPECT_TRUE(is_changed());
    EXPECT_EQ(applied, 1);
    EXPECT_EQ(gates->names.asked, 1);
}

TEST_F(ReloadBeside, WhoseDiskHangsIsRefusedInItsTimeAndNotDoneLater)
{
    change_file();
    gates->disk.close();
    auto caller = call();
    ASSERT_TRUE(goes_round_until([&] { return gates->disk.asked == 1; }));

    now += Reload::kLongestReading + 1ms;
    const Json reply = answer_to(caller);

    EXPECT_EQ(reply.at("applied"), false);
    EXPECT_THAT(reply.at("faults").at(0).get<std::string>(),
                AllOf(HasSubstr("the disk with " + file.path().string()), HasSubstr("nothing was changed")));
    EXPECT_TRUE(reload.is_idle());
    gates->disk.open();
    EXPECT_TRUE(file.settle(1min));
    EXPECT_FALSE(is_changed());
    auto next = call();
    EXPECT_EQ(answer_to(next).at("applied"), true);
    EXPECT_TRUE(is_changed());
}

TEST_F(ReloadBeside, WhoseNameServiceHangsSaysSo)
{
    change_file();
    gates->names.close();
    auto caller = call();
    ASSERT_TRUE(goes_round_until([&] { return gates->names.asked == 1; }));

    now += Reload::kLongestReading + 1ms;

    EXPECT_THAT(answer_to(caller).at("faults").at(0).get<std::string>(),
                HasSubstr("the name service, asked for the group \"root\", has not answered for 4 s"));
    EXPECT_FALSE(is_changed());
}

TEST_F(ReloadBeside, BySignalThatHangsIsTold)
{
    gates->ports.close();
    reload.request();
    ASSERT_TRUE(goes_round_until([&] { return gates->ports.asked == 1; }));

    now += Reload::kLongestReading + 1ms;
    go_round();

    EXPECT_TRUE(reload.is_idle());
    EXPECT_THAT(events.events().back().text, HasSubstr("the ports of the lines has not answered"));
}

TEST_F(ReloadBeside, WhoseLinkOfAPortHangsKeepsTheMainThreadNotAndChangesNothing)
{
    change_file();
    gates->links.close();
    auto caller = call();
    ASSERT_TRUE(goes_round_until([&] { return gates->links.asked == 1; }));

    now += Reload::kLongestReading + 1ms;

    EXPECT_THAT(answer_to(caller).at("faults").at(0).get<std::string>(),
                HasSubstr("the ports of the lines has not answered"));
    EXPECT_FALSE(is_changed());
}

TEST_F(ReloadBeside, ToAnotherNameOfTheSamePortLeavesNoDrive)
{
    folder_.write("etc/dpslaved.toml", std::string{kGood}.replace(std::string{kGood}.find("/dev/null-p3"), 12,
                                                                  "/dev/serial/by-id/p3"));
    auto caller = call();
    ASSERT_EQ(answer_to(caller).at("applied"), true);

    const LineChange* const change = changes[plant.lines().front().get()].get();
    ASSERT_NE(change, nullptr);
    EXPECT_TRUE(change->opens_port);
    EXPECT_TRUE(change->is_held) << "the line itself has it still";
    EXPECT_FALSE(change->is_other_port);
    EXPECT_FALSE(change->leaves_drives);
}

TEST_F(ReloadBeside, ToAnotherPortLeavesTheDrivesOfTheOldOne)
{
    folder_.write("etc/dpslaved.toml",
                  std::string{kGood}.replace(std::string{kGood}.find("/dev/null-p3"), 12, "/dev/null-p4"));
    auto caller = call();
    ASSERT_EQ(answer_to(caller).at("applied"), true);

    const LineChange* const change = changes[plant.lines().front().get()].get();
    ASSERT_NE(change, nullptr);
    EXPECT_FALSE(change->is_held);
    EXPECT_TRUE(change->is_other_port);
    EXPECT_TRUE(change->leaves_drives);
}

TEST_F(ReloadBeside, ThatComesWhileOneHangsIsAnsweredWithItAndSoIsADryRun)
{
    gates->disk.close();
    auto first = call();
    ASSERT_TRUE(goes_round_until([&] { return gates->disk.asked == 1; }));
    auto second = call();
    auto trial = call(true);
    ASSERT_TRUE(goes_round_until([&] { return server->counters().calls == 3; }));
    EXPECT_FALSE(reload.is_idle());

    now += Reload::kLongestReading + 1ms;

    for (control::Client* const caller : {&first, &second, &trial})
        EXPECT_THAT(answer_to(*caller).at("faults").at(0).get<std::string>(), HasSubstr("has not answered"));
    EXPECT_EQ(gates->disk.asked, 1);
}

TEST_F(ReloadBeside, AsADryRunChangesNothing)
{
    change_file();
    auto caller = call(true);

    const Json reply = answer_to(caller);

    EXPECT_EQ(reply.at("applied"), false);
    EXPECT_EQ(reply.at("faults"), Json::array());
    EXPECT_EQ(reply.at("changes").size(), 1U) << reply;
    EXPECT_FALSE(is_changed());
}

TEST_F(ReloadBeside, LooksOnceASecondWhetherTheFileHasChanged)
{
    folder_.write("etc/dpslaved.toml",
                  std::string{kGood}.replace(std::string{kGood}.find("address = 5"), 11, "address = 9"));
    EXPECT_EQ(file.address_of("unwinder"), 5);

    now += 1s;

    EXPECT_TRUE(goes_round_until([&] { return file.address_of("unwinder") == 9; }));
    EXPECT_EQ(gates->disk.asked, 1);
    now += 1s;
    go_round();
    EXPECT_TRUE(file.settle(1min));
    EXPECT_EQ(gates->disk.asked, 1) << "read once";
}

} // namespace
} // namespace dpslave::app
