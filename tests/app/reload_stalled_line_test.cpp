// SPDX-License-Identifier: Apache-2.0
/// A reload while a drive line stalls: it is said, it keeps neither the answer nor the next reload,
/// and the line does the newest when it goes round again.
#include "reload_bench.hpp"

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using control::Json;
using test::kGood;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class ReloadOfAStalledLine : public test_reload::ReloadBench {
protected:
    /// The file from now on, with `to` in place of `from`.
    void file_has(std::string_view from, std::string_view to)
    {
        std::string text{kGood};
        text.replace(text.find(from), from.size(), to);
        folder_.write("etc/dpslaved.toml", text);
    }
    void line_stalls()
    {
        go_round();
        stalled.insert("/dev/null-p3");
        stalled.insert("/dev/null-p4"); // it is the same line, which is to move
        line().link.sign->enter(io::PortCall::write, now);
        now += 3s;
    }
    void line_goes_round_again()
    {
        stalled.clear();
        line().link.sign->leave(now);
    }
    DriveLine& line() { return *line_; }
    Json reloads()
    {
        auto caller = call();
        return answer_to(caller);
    }
    static std::vector<std::string> warnings(const Json& reply)
    {
        return reply.at("warnings").get<std::vector<std::string>>();
    }

    const std::shared_ptr<DriveLine> line_ = plant.lines().front();
    const std::string kLate =
        "line p3 has stalled in write for 3.0 s and has not taken the new configuration yet";
};

TEST_F(ReloadOfAStalledLine, SaysSoInItsAnswerAndInTheLog)
{
    line_stalls();
    file_has("protocol", "retries = 1\nprotocol");
    const Json reply = reloads();

    EXPECT_EQ(reply.at("applied"), true);
    EXPECT_THAT(reply.at("changes"), SizeIs(1));
    EXPECT_THAT(warnings(reply), ElementsAre(kLate));
    EXPECT_THAT(events.events().back().text, HasSubstr(kLate));
}

TEST_F(ReloadOfAStalledLine, ThatBeganToStallAMomentAgoIsWaitedForUntilItIsKnown)
{
    line_stalls();
    now -= 3s; // it is within its call for no time yet
    file_has("protocol", "retries = 1\nprotocol");
    auto caller = call();
    ASSERT_TRUE(goes_round_until([&] { return line().link.change.offered() != nullptr; }));
    for (int i = 0; i < 3; ++i) go_round();
    now += 400ms;

    EXPECT_THAT(warnings(answer_to(caller)),
                ElementsAre(HasSubstr("line p3 has stalled in write for 0.4 s")));
}

TEST_F(ReloadOfAStalledLine, KeepsNoFurtherOneAndTheLineDoesTheNewestOnly)
{
    line_stalls();
    file_has("protocol", "retries = 1\nprotocol");
    reloads();
    file_has("protocol", "retries = 7\nprotocol");
    const Json second = reloads();
    EXPECT_EQ(second.at("applied"), true);
    EXPECT_THAT(warnings(second), ElementsAre(kLate));
    EXPECT_THAT(warnings(reloads()), ElementsAre(kLate)) << "one of the same file as well";

    line_goes_round_again();
    go_round();
    ASSERT_NE(changes[&line()], nullptr);
    EXPECT_EQ(changes[&line()]->line->retries, 7);
    EXPECT_EQ(line().link.changes_done, 1u) << "both were one";
    EXPECT_TRUE(goes_round_until([&] { return reload.is_idle(); }));
    EXPECT_THAT(warnings(reloads()), IsEmpty());
}

TEST_F(ReloadOfAStalledLine, ThatMovesTwiceLeavesTheDrivesAtThePortThatItHas)
{
    line_stalls();
    file_has("/dev/null-p3", "/dev/null-p4");
    reloads();
    stalled.insert("/dev/null-p5");
    file_has("/dev/null-p3", "/dev/null-p5");
    reloads();
    line_goes_round_again();
    go_round();

    LineChange& change = *changes[&line()];
    EXPECT_EQ(change.line->port, "/dev/null-p5");
    change.begins_at("/dev/null-p3");
    EXPECT_TRUE(change.opens_port);
    EXPECT_TRUE(change.is_other_port);
    EXPECT_TRUE(change.leaves_drives);
}

TEST_F(ReloadOfAStalledLine, ThatMovesAndComesBackLeavesNoDrive)
{
    line_stalls();
    file_has("/dev/null-p3", "/dev/null-p4");
    reloads();
    folder_.write("etc/dpslaved.toml", kGood);
    reloads();
    line_goes_round_again();
    go_round();

    LineChange& change = *changes[&line()];
    change.begins_at("/dev/null-p3");
    EXPECT_TRUE(change.opens_port);
    EXPECT_FALSE(change.is_other_port);
    EXPECT_FALSE(change.leaves_drives);
}

TEST_F(ReloadOfAStalledLine, ThatIsRemovedKeepsNoReloadAndGoesWhenItHasEnded)
{
    line_stalls();
    std::string text{kGood};
    for (const char* const name : {"\"p3\"", "\"p3\""}) text.replace(text.find(name), 4, "\"p9\"");
    text.replace(text.find("/dev/null-p3"), 12, "/dev/null-p9");
    folder_.write("etc/dpslaved.toml", text);
    stalled.insert("/dev/null-p9"); // it has a thread of its own
    const Json first = reloads();
    EXPECT_EQ(first.at("applied"), true) << first;
    EXPECT_THAT(warnings(first), testing::Contains(AllOf(HasSubstr("line p3 has stalled in write for 3.0 s"),
                                                         HasSubstr("ends when its call comes back"))));
    folder_.write("etc/dpslaved.toml", text + "output_refresh_s = 2.0\n");
    EXPECT_EQ(reloads().at("applied"), true);
    EXPECT_TRUE(is_changed());
    EXPECT_THAT(plant.leaving_lines(), ElementsAre(line_));
    EXPECT_THAT(plant.leaving(), SizeIs(1)) << "its station is kept for what the line will tell of it";

    line().link.ended = true;
    EXPECT_TRUE(goes_round_until([&] { return plant.leaving_lines().empty() && reload.is_idle(); }));
    EXPECT_THAT(plant.leaving(), IsEmpty());
}

} // namespace
} // namespace dpslave::app
