// SPDX-License-Identifier: Apache-2.0
// dpctl --field: one field of a document, for scripts.
#include "dpctl/cli/field_of.hpp"
#include "dpctl/dpctl_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Json kDocument = Json::parse(R"({"bus": {"baud": 187500, "port": "tty\n1"},
    "stations": [{"name": "unwinder", "master": 2, "bits": []}, {"name": "rewinder", "master": null, "held": true}],
    "none": []})");

TEST(FieldOf, GivesAValueAsItStands)
{
    EXPECT_THAT(*field_of(kDocument, "bus.baud"), ElementsAre("187500"));
    EXPECT_THAT(*field_of(kDocument, "bus.port"), ElementsAre("tty\\x0A1"))
        << "a text of the daemon is printable";
    EXPECT_THAT(*field_of(kDocument, "bus"), ElementsAre(R"({"baud":187500,"port":"tty\n1"})"));
}

TEST(FieldOf, GivesALineForEachObjectOfAList)
{
    EXPECT_THAT(*field_of(kDocument, "stations.name"), ElementsAre("unwinder", "rewinder"));
    EXPECT_THAT(*field_of(kDocument, "stations.master"), ElementsAre("2", "null"));
    EXPECT_THAT(*field_of(kDocument, "stations.held"), ElementsAre("null", "true")) << "only one has it";
}

TEST(FieldOf, GivesNoLineOfAnEmptyList)
{
    EXPECT_THAT(*field_of(kDocument, "none"), IsEmpty());
    EXPECT_THAT(*field_of(kDocument, "none.name"), IsEmpty());
}

TEST(FieldOf, NamesTheFieldsThatThereAre)
{
    EXPECT_EQ(field_of(kDocument, "buss").error(),
              "there is no field 'buss'; there are: bus, none, stations");
    EXPECT_EQ(field_of(kDocument, "stations.state").error(),
              "there is no field 'state'; there are: bits, held, master, name");
    EXPECT_EQ(field_of(kDocument, "bus.baud.x").error(), "there is no field 'x'; there is none below it");
}

TEST(DpctlField, PrintsOneFieldOfAReplyAndRefusesAnUnknownOne)
{
    test::FixtureDaemon daemon;
    const auto ran = [&](const std::string& field) {
        return test::dpctl({"status", "--socket", daemon.socket(), "--field", field});
    };

    EXPECT_EQ(ran("stations.name").out, "unwinder\nrewinder\n");
    EXPECT_EQ(ran("stations.name").exit, 0);
    EXPECT_EQ(ran("station").exit, 2);
    EXPECT_EQ(ran("station").out, "");
    EXPECT_THAT(ran("station").err, HasSubstr("dpctl: there is no field 'station'; there are: bus, "));
}

TEST(DpctlField, IsTakenByACommandWithoutADaemonToo)
{
    EXPECT_EQ(test::dpctl({"hex", "288", "0x10", "--field", "numbers.hex"}).out, "0120\n0010\n");
}

} // namespace
} // namespace dpslave::dpctl
