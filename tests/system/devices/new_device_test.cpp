// SPDX-License-Identifier: Apache-2.0
// A device type that is not shipped: a profile, a tag table and a GSD in a folder of the site. No
// line of C++ is written for it, and no program is built.
// Only here: a folder of a site, read by the programs as they are built.
#include "system/gateway.hpp"

#include <gmock/gmock.h>

#include <fstream>

namespace dpslave::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kProfile = R"(device = "Winder of the works of Miller and sons"
order_code = "M1"
firmware = "1.0"
manual = "none"
ident = 0x0C0D
protocols = ["ei-ascii"]
mnemonic_rule = "none"
tag_table = "miller.csv"
unlisted_tags = "refuse"
leds = "technology_box"
[tec]
health = "300.0"
run = "300.1"
[address]
min = 0
max = 125
[max_tsdr]
187500 = 60
[cfg_data]
identifiers = [0x50, 0x60, 0x70]
max_parameters = 4
may_have_no_parameters = true
[demand_data]
form = "none"
[user_prm_data]
tags_at = 3
min_length = 3
max_length = 11
may_be_absent = true
dpv1_status = true
max_tag = 999
tag_list = "zeros_at_end"
[global_control]
sync = false
freeze = false
fail_safe = false
[slave_diag]
max_length = 10
form = "trip_code"
[gsd]
vendor = "Miller"
model = "M1"
revision = "1"
hardware = "1"
software = "1"
min_slave_interval = 20
family = 1
repeater = 0
in_module = "Input"
out_module = "Output"
in_out_module = "Both"
)";

constexpr const char* kTags = R"(tag,name,type,decimals,min,max,access,mnemonic,start
300,State,WORD,,0000,FFFF,ro,s0,0001
301,Tension,INT,1,-100.0,100.0,ro,s1,0.0
302,Tension wanted,INT,1,-100.0,100.0,rw,s2,0.0
)";

class NewDevice : public ::testing::Test {
protected:
    NewDevice()
    {
        write_file(site / "profiles/miller.toml", kProfile);
        write_file(site / "tags/miller.csv", kTags);
    }
    Wiring wiring() const
    {
        Wiring wiring;
        wiring.profile = "miller";
        wiring.model = "605"; // an EI-ASCII drive; what it has is in the table
        wiring.drive = {};
        wiring.table = kTags;
        wiring.profiles = site / "profiles";
        return wiring;
    }

    Folder site;
};

TEST_F(NewDevice, NeedsAProfileATagTableAndAGsdOnly)
{
    Gateway gateway{wiring()};
    const Outcome made = gateway.dpctl({"gsd", "make", "--profiles", site / "profiles", "--profile", "miller",
                                        "--in", "301", "--out", "302", "--output", site / "MILL0C0D.GSD"});
    ASSERT_EQ(made.status, 0) << made.err;
    const Outcome checked = gateway.dpctl({"gsd", "check", site / "MILL0C0D.GSD"});
    EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
    EXPECT_THAT(content(site / "MILL0C0D.GSD"), HasSubstr("Ident_Number"));

    Master master{gateway,
                  {"--family", "technology-box", "--ident", "0x0C0D", "--tags", "301,302w", "--no-demand",
                   "--no-sync-freeze"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 301 12.5");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 125"));
    EXPECT_TRUE(master.does("out 1 = -300"));
    EXPECT_TRUE(gateway.drive().says("tag 302 written -30.0"));
    EXPECT_TRUE(master.does("wait 60s for diag ext 04000000"));
    EXPECT_TRUE(gateway.word_becomes(301, "name", "Tension"));
    EXPECT_EQ(gateway.station().at("device"), "Winder of the works of Miller and sons");
    EXPECT_EQ(gateway.tec("FAULT"), 0);
    EXPECT_TRUE(master.leaves());
}

TEST_F(NewDevice, WithAProfileThatIsWrongIsRefusedWithItsLine)
{
    std::string profile = kProfile;
    profile.replace(profile.find("max_parameters = 4"), 18, "max_parameters = 0");
    write_file(site / "profiles/miller.toml", profile);
    Wiring with = wiring();
    with.started = false;
    Gateway gateway{with};

    const Outcome refused = gateway.run_daemon({"--check"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.err, HasSubstr("miller.toml:"));
    EXPECT_THAT(refused.err, HasSubstr("max_parameters"));
}

} // namespace
} // namespace dpslave::test
