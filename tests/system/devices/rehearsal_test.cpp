// SPDX-License-Identifier: Apache-2.0
// A rehearsal before the plant: the gateway, and a master that has the plant's own GSD and its modules.
// Only here: a master of its own process that has the plant's file.
#include "support/paths.hpp"
#include "system/gateway.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

const std::string kGsd = source_path("gsd/590/590_0533.GSD");
const std::string kModules = "Demand-Data,Process-Data-Input,process-data-output";

TEST(Rehearsal, WithTheGsdOfThePlantAndItsTagsExchangesThem)
{
    Gateway gateway;
    Master master{gateway, {"--gsd", kGsd, "--modules", kModules, "--tags", "55,56"}};
    ASSERT_TRUE(master.says("10 input and 10 output octets"));
    ASSERT_TRUE(master.says("octets 0 to 3 of User_Prm_Data are 00 37 00 38"));

    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_TRUE(master.leaves());
}

/// A plant's file: one octet before the tags, and three words in one identifier.
const std::string kPlantGsd = source_path("tests/gsd/cases/LEAD2408.GSD");
const Arguments kPlantMaster{"--gsd",    kPlantGsd,    "--modules", "map",
                             "--family", "controller", "--master",  "36"};

Wiring plant(const std::string& keys)
{
    Wiring wiring;
    wiring.profile = "2408f";
    wiring.protocol = "modbus-rtu";
    wiring.units = {"1"};
    wiring.keys = "ident = 0x2408\ndisplay_decimals = 1\n" + keys;
    return wiring;
}

Outcome check(const Gateway& gateway)
{
    return gateway.dpctl(
        {"gsd", "check", kPlantGsd, "--station", "5", "--profiles", source_path("config/profiles")});
}

TEST(Rehearsal, WithAPlantsFileThatDiffersFromTheProfileExchangesByTheKeysOfTheStation)
{
    Gateway gateway{plant("tags_at = 1\nidentifiers = [\"52\", \"60\"]\n")};
    Master master{gateway, kPlantMaster};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 1 999.9");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 9999"));
    EXPECT_TRUE(master.does("out 1 = 605"));
    EXPECT_TRUE(gateway.drive().says("tag 24 written 60.5"));
    EXPECT_TRUE(master.leaves());

    const Outcome judged = check(gateway);
    EXPECT_THAT(judged.out, HasSubstr("the plant uses the modules map with the tags 1, 5, 3, 24."));
    EXPECT_THAT(judged.out, ::testing::Not(HasSubstr("would be refused")))
        << "only its MaxTsdr is that of a test";
}

TEST(Rehearsal, WithAPlantsFileIsRefusedWithoutTheKeysAsTheCheckOfTheFileSays)
{
    Gateway gateway{plant("")};
    Master master{gateway, kPlantMaster};
    master.send_line("start 5s");
    EXPECT_EQ(master.wait(), 5);
    ASSERT_TRUE(eventually([&] { return !gateway.diagnosis().at("refusal").is_null(); }));
    const auto refusal = gateway.diagnosis().at("refusal");
    EXPECT_EQ(refusal.at("code"), "prm_length");

    const Outcome judged = check(gateway);
    EXPECT_EQ(judged.status, 1);
    EXPECT_THAT(judged.out, HasSubstr("Set_Prm would be refused: " + refusal.at("what").get<std::string>()));
    EXPECT_THAT(judged.out, HasSubstr("expected " + refusal.at("expected").get<std::string>()));
}

TEST(Rehearsal, WithTheListingOfTheManualIsDoneWithDemandDataAlone)
{
    Gateway gateway;
    Master master{gateway, {"--gsd", source_path("gsd/manual/584s-590/EURO0533.GSD"), "--modules=#1"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("demand read 55"));
    EXPECT_TRUE(master.leaves());
}

TEST(Rehearsal, WithTheIdentOfAnotherDeviceIsRefusedAndTheMasterSaysSo)
{
    Gateway gateway;
    std::string text = content(kGsd);
    const std::size_t at = text.find("0x0533");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 6, "0x0534");
    const std::string file = gateway.folder("OTHER.GSD");
    write_file(file, text);
    Master master{gateway,
                  {"--gsd", file, "--modules", kModules, "--tags", "55,56", "--family", "controller"}};
    master.send_line("start 5s");
    EXPECT_TRUE(master.says("Set_Prm was refused: its ident is 0x0534, the slave's is 0x0533"));
    EXPECT_EQ(master.wait(), 5);
}

/// dpsim master with these options; it ends before it opens the port.
Outcome master_with(const Arguments& options)
{
    Arguments command{
        program_path("dpsim"), "master", "--port", "/dev/null", "--baud", "187500", "--slave", "5"};
    command.insert(command.end(), options.begin(), options.end());
    return run(command);
}

TEST(Rehearsal, WithoutModulesSaysWhichThereAreAndWhatToWrite)
{
    const Outcome outcome = master_with({"--gsd", kGsd});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("write --modules NAME,..."));
    EXPECT_THAT(outcome.err, HasSubstr("\n  #2 Process-Data-Input (50)\n"));
}

TEST(Rehearsal, TakesNothingBesideTheFileThatTheFileSays)
{
    for (const Arguments& more :
         {Arguments{"--ident", "0x0533"}, Arguments{"--prm", "none"}, Arguments{"--cfg", "73"},
          Arguments{"--tags", "1", "--no-demand"}, Arguments{"--tags", "1", "--prm-length", "24"}}) {
        Arguments options{"--gsd", kGsd, "--modules", kModules};
        options.insert(options.end(), more.begin(), more.end());
        const Outcome outcome = master_with(options);
        EXPECT_EQ(outcome.status, 2) << more[0];
        EXPECT_THAT(outcome.err, HasSubstr("exclude each other")) << more[0];
    }
    EXPECT_EQ(master_with({"--modules", kModules}).status, 2) << "they are modules of a file";
}

} // namespace
} // namespace dpslave::test
