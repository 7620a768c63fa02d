// SPDX-License-Identifier: Apache-2.0
// The log of the real daemon: who has set what.
// Only here: the user and the process that a call came from.
#include "gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <string>

namespace dpslave::test {
namespace {

using ::testing::ContainsRegex;

/// The last line of the daemon that holds `text`, after it was said.
std::string line_with(Gateway& gateway, const std::string& text)
{
    EXPECT_TRUE(gateway.daemon().says(text));
    std::string found;
    for (const std::string& line : gateway.daemon().transcript().lines())
        if (line.find(text) != std::string::npos) found = line;
    return found;
}

TEST(TheLog, HasUserAndBothValuesOfAChangedInputOfTheFunctionBlock)
{
    Wiring wiring;
    wiring.profile = "605";
    wiring.table = "tag,name,type,decimals,min,max,access,values,start\n"
                   "55,Speed,INT,2,-300.00,300.00,ro,,0.00\n";
    wiring.keys = "[station.tec]\nride_through = 20\n";
    Gateway gateway{wiring};

    ASSERT_EQ(gateway.dpctl({"tec", "set", "RIDE_THROUGH", "7"}).status, 0);
    EXPECT_THAT(line_with(gateway, "RIDE_THROUGH set to 7"),
                ContainsRegex(fmt::format("info: unwinder: RIDE_THROUGH set to 7 s by uid {}, pid [0-9]+, "
                                          "before 20 s$",
                                          ::getuid())));

    ASSERT_NE(gateway.dpctl({"tec", "set", "RIDE_THROUGH", "700000"}).status, 0);
    EXPECT_FALSE(gateway.daemon().ever_said("700000")) << "what was refused was not set";
}

TEST(TheLog, NamesTheOldValueOfATagThatIsReadForTheDiagnosis)
{
    Wiring wiring;
    wiring.profile = "605";
    wiring.table = "tag,name,type,decimals,min,max,access,values,start\n"
                   "31,Reason,WORD,,0000,FFFF,rw,,1234\n";
    wiring.keys = "[station.tec]\next_diagnostic_tag = 31\n";
    Gateway gateway{wiring};
    ASSERT_TRUE(eventually([&] { return gateway.tec("EXT DIAGNOSTIC") == 0x1234; }));

    const Outcome written = gateway.dpctl({"write", "31", "0x0005"});
    ASSERT_EQ(written.status, 0) << written.err;
    EXPECT_THAT(line_with(gateway, "tag 31 Reason set to"), ContainsRegex("before [>x0]*1234: done$"));
}

} // namespace
} // namespace dpslave::test
