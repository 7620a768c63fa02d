// SPDX-License-Identifier: Apache-2.0
#include "control/fixtures.hpp"
#include "dpctl/cli/render.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Json kBefore = test::fixture("Watch");

TEST(DpctlChanges, AreEverythingAtTheStart)
{
    EXPECT_THAT(status_changes(Json::object(), kBefore),
                ElementsAre("bus: rate 187.5 kbit/s, state DP_Control",
                            "unwinder: state Data_Exch, master 2, drive answers",
                            "rewinder: state Wait_Prm, master none, drive silent"));
    EXPECT_THAT(io_changes(Json::object(), kBefore),
                ElementsAre("unwinder: in tag 7 SPEED FEEDBACK = 50.00 (good)",
                            "unwinder: out tag 56 = -12.50 (read only)"));
}

TEST(DpctlChanges, AreNoneWhenOnlyTimePasses)
{
    Json now = kBefore;
    now["bus"]["last_telegram_age_ms"] = 99;
    now["words"][0]["words"][0]["age_ms"] = 99;
    now["stations"][0]["drive"]["reads"] = 4001;

    EXPECT_THAT(status_changes(kBefore, now), IsEmpty());
    EXPECT_THAT(io_changes(kBefore, now), IsEmpty());
}

TEST(DpctlChanges, NameWhatWasBefore)
{
    Json now = kBefore;
    now["stations"][0]["state"] = "Wait_Prm";
    now["stations"][0]["master"] = nullptr;
    now["stations"][1]["drive"]["link"] = "answers";
    now["bus"]["baud"] = 500000;

    EXPECT_THAT(io_changes(kBefore, now), IsEmpty());
    EXPECT_THAT(status_changes(kBefore, now),
                ElementsAre("bus: rate 500 kbit/s (was 187.5 kbit/s)",
                            "unwinder: state Wait_Prm (was Data_Exch), master none (was 2)",
                            "rewinder: drive answers (was silent)"));
}

TEST(DpctlChanges, AreClearHeldSyncAndAPortThatHasGone)
{
    Json now = kBefore;
    now["stations"][0]["clear"] = true;
    now["stations"][0]["held"] = true;
    now["stations"][1]["drive"]["port_open"] = false;

    EXPECT_THAT(status_changes(kBefore, now),
                ElementsAre("unwinder: state Data_Exch, held in Clear (was Data_Exch)",
                            "rewinder: drive port missing (was silent)"));
}

TEST(DpctlChanges, AreAPortOfTheBusThatHasGone)
{
    Json now = kBefore;
    now["bus"]["port_open"] = false;

    EXPECT_THAT(status_changes(kBefore, now), ElementsAre("bus: state port missing (was DP_Control)"));
}

TEST(DpctlChanges, AreStationsThatHaveGone)
{
    Json now = kBefore;
    now["stations"].erase(1);

    EXPECT_THAT(status_changes(kBefore, now), ElementsAre("rewinder: removed"));
}

TEST(DpctlChanges, AreValuesAndTheirStates)
{
    Json now = kBefore;
    now["words"][0]["words"][0]["value"] = "51.00";
    now["words"][0]["words"][1]["state"] = "good";

    EXPECT_THAT(status_changes(kBefore, now), IsEmpty());
    EXPECT_THAT(io_changes(kBefore, now), ElementsAre("unwinder: in tag 7 SPEED FEEDBACK = 51.00 (good)",
                                                      "unwinder: out tag 56 = -12.50 (good)"));
}

TEST(DpctlChanges, AreWordsThatTheMasterHasChosenAnew)
{
    Json now = kBefore;
    now["words"][0]["words"][0]["tag"] = 8;
    now["words"][0]["words"][0]["name"] = nullptr;

    EXPECT_THAT(io_changes(kBefore, now), ElementsAre("unwinder: in tag 8 = 50.00 (good)"));
}

} // namespace
} // namespace dpslave::dpctl
