// SPDX-License-Identifier: Apache-2.0
/// dpctl bus: who is on the bus, in a table.
#include "control/fixtures.hpp"
#include "control/lines.hpp"
#include "dpctl/cli/render.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::HasSubstr;
using testing::Not;

report::GetBusReply reply()
{
    return report::read<report::GetBusReply>(test::fixture("GetBus"));
}

TEST(DpctlBus, IsOneLineForEachAddressAndThenWhomTheMastersAskInVain)
{
    EXPECT_EQ(render_bus(reply(), false), test::lines(R"(
bus  /dev/ttyS1, 187.5 kbit/s, DP_Control, load 20.5 %

  ADDR  WHAT       IDENT  STATE      BY       CYCLE ms  RETRIES    LOAD  HEARD
     2  master     -      -           -    4.2/5.0/9.7        0  12.2 %   3 ms
     5  gateway    0533   Data_Exch   2  9.8/10.0/12.4        1   8.2 %   4 ms
     9  not heard  -      no answer   2              -       80   0.0 %      -

  Master 2 asks for address 9 and gets no answer: 120 requests, last 150 ms ago.

  CYCLE: shortest, mean and longest of the last ten seconds; of a slave from one
  Data_Exchange to the next, of a master from one token to the next.
)"));
}

TEST(DpctlBus, NamesTheNextStepWhenNoStationWasHeard)
{
    report::GetBusReply silent = reply();
    silent.members.clear();

    EXPECT_THAT(render_bus(silent, false),
                HasSubstr("no station was heard yet; ask for the cause: dpctl doctor"));
}

TEST(DpctlBus, CallsASlaveThatAnsweredBeforeWithoutAnswerOnlyAfterSeveralRequests)
{
    report::GetBusReply now = reply();
    now.members[1].unanswered = 3;
    EXPECT_THAT(render_bus(now, false), Not(HasSubstr("asks for address 5")));

    now.members[1].unanswered = 4;
    EXPECT_THAT(render_bus(now, false),
                HasSubstr("Master 2 asks for address 5 and gets no answer: 4 requests"));
}

} // namespace
} // namespace dpslave::dpctl
