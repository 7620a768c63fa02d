// SPDX-License-Identifier: Apache-2.0
// The program dpctl: doctor, and what needs no daemon.
#include "control/fixtures.hpp"
#include "control/lines.hpp"
#include "dpctl_bench.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kShipped = source_path("config/profiles");

// ---------------------------------------------------------------- doctor

TEST(DpctlDoctor, EndsWith1WhenSomethingIsFoundAnd0WhenAllIsWell)
{
    const FixtureDaemon daemon;

    const Ran all = dpctl({"doctor", "--socket", daemon.socket()});
    EXPECT_EQ(all.exit, 1);
    EXPECT_THAT(
        all.out,
        HasSubstr(
            "\n1. The drive has never answered: cable, unit, rate or format (dpslaved)\n   rewinder: "));
    EXPECT_EQ(all.err, "");

    const Ran one = dpctl({"doctor", "unwinder", "--socket", daemon.socket()});
    EXPECT_EQ(one.exit, 1);
    EXPECT_THAT(one.out, HasSubstr("\n1. Modules in the wrong order")) << "its tag 56 is read only";

    const Json json = Json::parse(dpctl({"doctor", "16", "--json", "--socket", daemon.socket()}).out);
    EXPECT_EQ(json["findings"][0]["rule"], "drive.never");
    EXPECT_EQ(json["line"]["cable_b_m"], 600);

    const Ran unknown = dpctl({"doctor", "winder", "--socket", daemon.socket()});
    EXPECT_EQ(unknown.exit, 2);
    EXPECT_EQ(unknown.err, "dpctl: there is no station 'winder'\n");
}

TEST(DpctlDoctor, EndsWith3AndAHintWhenNoDaemonRuns)
{
    const Ran ran = dpctl({"doctor", "--socket", "/nonexistent/control.sock"});

    EXPECT_EQ(ran.exit, 3);
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr("systemctl status dpslaved"));
    EXPECT_THAT(ran.err, HasSubstr("no station is on the bus: the lamps are off"));
}

TEST(DpctlDoctor, PrintsAllRulesWithoutADaemon)
{
    const Ran ran = dpctl({"doctor", "--rules", "--socket", "/nonexistent/control.sock"});

    EXPECT_EQ(ran.exit, 0);
    EXPECT_THAT(ran.out, HasSubstr("NETWORK off, MODULE short flash (FAULT is SELF TEST)\n"));
    EXPECT_EQ(Json::parse(dpctl({"doctor", "--rules", "--json"}).out)["lines"].size(), 7u);
}

// ---------------------------------------------------------------- hex

TEST(DpctlHex, TakesNumbersAndRanges)
{
    EXPECT_EQ(dpctl({"hex", "288", "-300.00"}).out, test::lines(R"(
 NUMBER  DECIMAL  SIGNED  HEX   OCTETS
    288      288     288  0120  01 20
-300.00    35536  -30000  8AD0  8A D0
)"));
    const Ran table = dpctl({"hex", "0-559"});
    EXPECT_EQ(table.exit, 0);
    EXPECT_THAT(table.out, HasSubstr("\n550  0226  0227  0228  0229  022A  022B  022C  022D  022E  022F\n"));
    EXPECT_EQ(Json::parse(dpctl({"hex", "7-9", "--json"}).out)["numbers"].size(), 3u);
}

TEST(DpctlHex, EndsWith2WhenItIsNoNumber)
{
    const Ran ran = dpctl({"hex", "288", "speed"});

    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err, "dpctl: 'speed' is no number: write 288, -300.00, 0x120, >120, 120h or 0-559\n");
}

// ---------------------------------------------------------------- tag

TEST(DpctlTag, LooksInTheShippedTables)
{
    const Ran program =
        dpctl({"tag", "program", "1", "segment", "4", "type", "--profile", "2408f", "--profiles", kShipped});
    EXPECT_EQ(program.exit, 0) << program.err;
    EXPECT_THAT(program.out, StartsWith("2400.csv: tag 8360 (0x20A8) Program 1 segment 4: Segment type\n"));

    const Json json = Json::parse(dpctl({"tag", "270", "--profiles", kShipped, "--json"}).out);
    bool found = false;
    for (const Json& tag : json["tags"])
        found = found || (tag["table"] == "2400.csv" && tag["name"] == "Autotune enable");
    EXPECT_TRUE(found) << json;
}

TEST(DpctlTag, LooksInOneFile)
{
    const std::string table = source_path("config/tags/2400.csv");

    EXPECT_THAT(dpctl({"tag", "autotune", "--table", table}).out,
                HasSubstr("2400.csv: tag 270 (0x010E) Autotune enable\n"));
}

TEST(DpctlTag, ListsTheTablesAndTheDevicesWithoutOne)
{
    const Ran ran = dpctl({"tag", "--profiles", kShipped});

    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("\n2400.csv "));
    EXPECT_THAT(ran.out, HasSubstr("\n  590 "));
    EXPECT_EQ(ran.err, "");
}

TEST(DpctlTag, EndsWith1WhenNothingIsFound)
{
    const Ran nothing = dpctl({"tag", "wombat", "9", "--profiles", kShipped});
    EXPECT_EQ(nothing.exit, 1);
    EXPECT_EQ(nothing.out, "");
    EXPECT_THAT(nothing.err, StartsWith("dpctl: no table has 'wombat 9'"));

    const Ran no_tables = dpctl({"tag", "7", "--profiles", "/nonexistent/profiles"});
    EXPECT_EQ(no_tables.exit, 1);
    EXPECT_EQ(no_tables.err,
              "dpctl: /nonexistent/tags: No such file or directory; name the folder of profiles beside it "
              "with --profiles DIR\n");

    const Ran no_profile = dpctl({"tag", "7", "--profile", "591", "--profiles", kShipped});
    EXPECT_EQ(no_profile.exit, 1);
    EXPECT_THAT(no_profile.err, HasSubstr("591.toml"));
}

// ---------------------------------------------------------------- decode

TEST(DpctlDecode, EndsWith0ForASoundTelegramAnd1ForAFaultyOne)
{
    const Ran sound = dpctl({"decode", "10", "05", "02", "49", "50", "16"});
    EXPECT_EQ(sound.exit, 0);
    EXPECT_THAT(sound.out, StartsWith("SD1: request, FDL status\n"));

    const Ran faulty = dpctl({"decode", "100502495116"});
    EXPECT_EQ(faulty.exit, 1);
    EXPECT_THAT(faulty.out, HasSubstr("  wrong: FCS is 0x51 and should be 0x50\n"));

    EXPECT_EQ(Json::parse(dpctl({"decode", "E5", "--json"}).out)["parts"].size(), 1u);
    EXPECT_EQ(dpctl({"decode", "xyz"}).exit, 2);
}

TEST(DpctlDecode, TakesTheTripCodeOfAShippedDevice)
{
    const Ran ran =
        dpctl({"decode", "00 0C 00 01 16 49 04 01 6A B5", "--profile", "605", "--profiles", kShipped});

    EXPECT_EQ(ran.exit, 0) << ran.out << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("      8       7  0x01   trip code 1: LINK OVERVOLTS\n"));
    EXPECT_THAT(ran.out, HasSubstr("     10       9  0xB5   EXT DIAGNOSTIC, low octet: >6AB5\n"));
}

TEST(DpctlDecode, NamesTheBitsOfTheStatusWordOfAShippedDevice)
{
    const Ran ran =
        dpctl({"decode", "00 0C 00 24 24 08 03 40 30", "--profile", "2408f", "--profiles", kShipped});

    EXPECT_EQ(ran.exit, 0) << ran.out << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("Master_Add: owned by master 36\n"));
    EXPECT_THAT(ran.out, HasSubstr("Manual mode"));
    EXPECT_THAT(ran.out, HasSubstr("Sensor"));
    EXPECT_THAT(ran.out, HasSubstr("IP1 fault"));
}

} // namespace
} // namespace dpslave::test
