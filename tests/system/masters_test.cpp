// SPDX-License-Identifier: Apache-2.0
// Who may parameterise the slave, and what it says when it does not like the parameters.
// Only here: what a master did is what dpctl says of it.
#include "gateway.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

struct Refused {
    const char* name;
    Arguments settings; ///< of the master
    const char* finding;
    const char* telegram;
    Json octet; ///< counted from 1
    Json expected, got;
    const char* words; ///< of dpctl without --json
};

/// Twelve tags with the given one in the second place.
std::string user_prm_with(const char* second_tag)
{
    return std::string{"0037 "} + second_tag + " 0120 0000 0000 0000 0000 0000 0000 0000 0000 0000";
}

std::vector<Refused> refused()
{
    return {
        {"wrong ident",
         {"--ident", "0x1234", "--tags", "55"},
         "prm-fault",
         "Set_Prm",
         5,
         "Ident_Number 0x0533",
         "0x1234",
         "Set_Prm refused, octet 5 (offset 4): the Ident_Number is that of another device"},
        {"wrong length",
         {"--prm", "0037 0038 0120 0000 0000 0000 0000 0000 0000 0000 0000", "--cfg", "73 50 50 50"},
         "prm-fault",
         "Set_Prm",
         nullptr,
         "24 octets of User_Prm_Data",
         "22",
         "Set_Prm refused: User_Prm_Data has a wrong length"},
        {"tag too large",
         {"--prm", user_prm_with("0800"), "--cfg", "73 50 50 50"},
         "prm-fault",
         "Set_Prm",
         10,
         "a tag up to 2047",
         "2048",
         "Set_Prm refused, octet 10 (offset 9): a tag in User_Prm_Data is too large"},
        {"Demand Data not first",
         {"--tags", "55", "--cfg", "50 73"},
         "cfg-fault",
         "Chk_Cfg",
         2,
         "0x50",
         "0x73",
         "Chk_Cfg refused, octet 2 (offset 1): an identifier is not legal here"},
        {"too many identifiers",
         {"--tags", "55", "--cfg", "73 50 50"},
         "cfg-fault",
         "Chk_Cfg",
         3,
         "1 identifiers for as many tags",
         "2",
         "Chk_Cfg refused, octet 3 (offset 2): Cfg_Data has more identifiers than User_Prm_Data has tags"},
    };
}

TEST(Refusal, IsExplainedByDpctlWithOctetExpectedAndGot)
{
    Gateway gateway;
    for (const Refused& one : refused()) {
        SCOPED_TRACE(one.name);
        Master master{gateway, one.settings};
        EXPECT_TRUE(master.does("try start 60s"));
        EXPECT_TRUE(master.does("diag"));
        EXPECT_TRUE(master.does(std::string{"expect diag "} + one.finding));
        EXPECT_TRUE(master.does("expect diag prm-required"));
        EXPECT_TRUE(master.leaves());

        Json refusal; // dpctl may still show the one before for a moment
        EXPECT_TRUE(eventually([&] {
            refusal = gateway.diagnosis().at("refusal");
            return refusal.is_object() && refusal.at("got") == one.got;
        }));
        EXPECT_EQ(refusal.at("telegram"), one.telegram);
        EXPECT_EQ(refusal.at("octet"), one.octet);
        EXPECT_EQ(refusal.at("expected"), one.expected);
        EXPECT_EQ(refusal.at("got"), one.got);
        EXPECT_THAT(gateway.dpctl({"diag"}).out, HasSubstr(one.words));
        EXPECT_TRUE(gateway.exchange_ends_with(1));
    }
}

TEST(Refusal, IsForgottenWhenTheMasterComesWithGoodParameters)
{
    Gateway gateway;
    Master wrong{gateway, {"--ident", "0x1234", "--tags", "55"}};
    EXPECT_TRUE(wrong.does("try start 60s"));
    EXPECT_TRUE(wrong.leaves());
    EXPECT_TRUE(gateway.daemon().says("Set_Prm of master 2 refused"));

    Master right{gateway, {"--tags", "55"}};
    EXPECT_TRUE(right.does("start 60s"));
    EXPECT_TRUE(eventually([&] { return gateway.diagnosis().at("hex") == "00 0C 00 02 05 33"; }));
    EXPECT_TRUE(eventually([&] { return gateway.diagnosis().at("refusal").is_null(); }));
}

TEST(Owner, KeepsTheSlaveAgainstAnotherMasterUntilItReleasesIt)
{
    Gateway gateway;
    {
        Master owner{gateway, {"--tags", "55,56w", "--no-watchdog"}};
        ASSERT_TRUE(owner.does("start 60s"));
        EXPECT_TRUE(owner.does("out 1 = 500"));
        EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
        EXPECT_TRUE(owner.does("stop"));
        EXPECT_TRUE(owner.leaves());
    }

    Master other{gateway, {"--tags", "55,56w", "--master", "3"}};
    EXPECT_TRUE(other.does("try start 60s"));
    EXPECT_TRUE(other.ever_said("the slave belongs to master 2"));
    EXPECT_FALSE(other.ever_said("station is in data exchange"));
    EXPECT_TRUE(other.does("set-prm B8 01 64 0B 05 33 01" + std::string(48, '0')));
    EXPECT_TRUE(gateway.daemon().says("master 3 tried to parameterise a slave that another master owns"));
    EXPECT_TRUE(eventually([&] { return gateway.station().at("master") == 2; }));
    EXPECT_EQ(gateway.station().at("state"), "Data_Exch");
    EXPECT_TRUE(other.leaves());

    gateway.drive().skip();
    Master again{gateway, {"--tags", "55,56w"}};
    EXPECT_TRUE(again.does("unlock"));
    EXPECT_TRUE(again.leaves());
    EXPECT_TRUE(gateway.drive().says("tag 56 written 0.00"));
    EXPECT_TRUE(gateway.daemon().says("the master released the slave"));

    Master heir{gateway, {"--tags", "55,56w", "--master", "3"}};
    EXPECT_TRUE(heir.does("start 60s"));
    EXPECT_TRUE(heir.does("out 1 = 600"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 6.00"));
    EXPECT_TRUE(eventually([&] { return gateway.station().at("master") == 3; }));
}

/// The member of `dpctl bus --json` with this address; null: there is none.
Json member_of_bus(const Gateway& gateway, int address)
{
    const Json bus = gateway.json({"bus"});
    for (const Json& one : bus.at("members"))
        if (one.at("address") == address) return one;
    return nullptr;
}

TEST(BusMembers, AreTheMasterThisGatewayAndTheAddressThatNobodyHas)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    for (int i = 0; i < 5; ++i) // Slave_Diag of address 7 by master 2
        EXPECT_TRUE(master.does("send 68 05 05 68 87 82 6D 3C 3E F0 16"));

    Json ours;
    EXPECT_TRUE(eventually([&] {
        ours = member_of_bus(gateway, 5);
        return ours.is_object() && ours.at("cycle").is_object();
    })) << ours;
    EXPECT_EQ(ours.at("ours"), true);
    EXPECT_EQ(ours.at("state"), "Data_Exch");
    EXPECT_EQ(ours.at("ident"), 0x0533);
    EXPECT_EQ(ours.at("asked_by"), 2);
    EXPECT_GT(ours.at("load_percent"), 0);
    EXPECT_EQ(member_of_bus(gateway, 2).at("master"), true);
    EXPECT_TRUE(eventually([&] {
        const Json nobody = member_of_bus(gateway, 7);
        return nobody.is_object() && nobody.at("unanswered") >= 5 && nobody.at("slave") == false;
    }));
    EXPECT_THAT(gateway.dpctl({"bus"}).out, HasSubstr("Master 2 asks for address 7 and gets no answer"));
}

} // namespace
} // namespace dpslave::test
