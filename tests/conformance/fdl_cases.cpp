// SPDX-License-Identifier: Apache-2.0
// Layer 2: C-01, C-02, C-05, C-06 and C-07.
#include "case.hpp"

namespace conformance {
namespace {

using test::kUs;
using test::sd1;
using test::sd2;

constexpr std::uint8_t kOtherSlave = 30;

void C01_FdlStatusInEveryState(Bench& b)
{
    EXPECT_EQ(b.owner.says("10 05 02 49 50 16"), "10 02 05 00 07 16") << "Wait_Prm";
    ASSERT_TRUE(b.parameterise());
    EXPECT_EQ(b.owner.says("10 05 02 49 50 16"), "10 02 05 00 07 16") << "Wait_Cfg";
    EXPECT_EQ(b.foreign.says("10 05 09 49 57 16"), "10 09 05 00 0E 16") << "asked by another master";
    ASSERT_TRUE(b.start_up());
    EXPECT_EQ(b.owner.says("10 05 02 49 50 16"), "10 02 05 00 07 16") << "Data_Exch";
    EXPECT_EQ(b.foreign.says("10 05 09 49 57 16"), "10 09 05 00 0E 16") << "asked by another master";
}

void C02_WhatIsNotForTheStation(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    const std::vector<Octets> all{
        sd1(127, 2, 0x49),                              // FDL status to all
        sd2(127, 2, 0x6D, words({9, 9, 9, 9})),         // Data_Exchange to all
        sd2(127, 2, 0x6D, Saps{60, 62}),                // Slave_Diag to all
        sd1(kOtherSlave, 2, 0x49),                      // another slave
        sd2(kOtherSlave, 2, 0x6D, words({9, 9, 9, 9})), // likewise
        sd1(kUs, 127, 0x49),                            // no station has the address 127
        sd2(kUs, 127, 0x6D, words({9, 9, 9, 9})),       // likewise
        sd1(kUs, kUs, 0x49),                            // its own address as sender
        sd2(kUs, kUs, 0x6D, Saps{60, 62}),              // likewise
        sd1(kUs, 2, 0x09),                              // FC bit 6 = 0: a reply
        sd2(kUs, 2, 0x08, words({9, 9, 9, 9})),         // likewise
        sd2(kUs, 2, 0x44, Saps{58, 62}, {0x00, 0x00}),  // SDN low and high
        sd2(kUs, 2, 0x46, Saps{58, 62}, {0x00, 0x00}),  //
        sd2(kUs, 2, 0x46, Saps{60, 62}),                // SDN to a SAP that has none
        test::token(kUs, 2),                            // a token to a slave
        test::sc(),                                     //
    };
    for (const Octets& one : all) EXPECT_TRUE(b.slave.is_silent_to(one));
    for (const std::uint8_t reserved : Octets{0x40, 0x41, 0x42, 0x48, 0x4A, 0x4B})
        EXPECT_TRUE(b.slave.is_silent_to(sd1(kUs, 2, reserved))) << "a function code that is reserved";
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), inputs_at_start());
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4})) << "nothing of it was taken for outputs";
}

/// A network in which DP and FMS stations, other slaves and a token live.
void C02_MixedNetwork(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    const std::vector<Octets> traffic{
        test::token(3, 2),
        sd2(kOtherSlave, 2, 0x7D, Octets(64, 0x68)),                     // octets that look like delimiters
        sd2(2, kOtherSlave, 0x08, Octets(64, 0xE5)),                     //
        sd2(2, kOtherSlave, 0x0A, {0x10, 0x05, 0x02, 0x49, 0x50, 0x16}), // FDL status to us inside of a reply
        sd2(kOtherSlave, 3, 0x65, Saps{20, 20}, Octets(32, 0xA2)),       // SDA of an FMS connection
        test::sc(),
        sd2(kOtherSlave, 3, 0x6C, Saps{33, 51}, {0x5E, 1, 2, 10}), // DP-V1 to another slave
        test::sd3(kOtherSlave, 3, 0x5D, {0xDC, 0x05, 0x02, 0x10, 0x05, 0x02, 0x49, 0x50}),
        sd1(3, 2, 0x49),
        sd1(2, 3, 0x20), // a master that is ready for the ring
        test::token(2, 3),
    };
    for (std::uint16_t cycle = 1; cycle <= 20; ++cycle) {
        for (const Octets& one : traffic) b.slave.send(one);
        EXPECT_EQ(b.owner.data_exchange(words({cycle, 2, 3, 4})), inputs_at_start()) << cycle;
    }
    EXPECT_EQ(b.foreign.rd_outp(), dl({20, 2, 3, 4}));
    EXPECT_EQ(b.diag(), kExchanging);
}

void C05_Sd3InsteadOfSd2(Bench& b)
{
    ASSERT_TRUE(b.parameterise());
    EXPECT_EQ(b.owner.sends(test::sd3(kUs, 2, b.owner.next_fc(), Saps{62, 62}, cfg())), "SC");
    ASSERT_TRUE(b.becomes_ready());
    EXPECT_EQ(b.owner.get_cfg(), "DL " + test::show(cfg()));
    EXPECT_EQ(b.owner.sends(test::sd3(kUs, 2, b.owner.next_fc(), words({0x11, 0x22, 0x33, 0x44}))),
              inputs_at_start());
    EXPECT_EQ(b.foreign.rd_outp(), dl({0x11, 0x22, 0x33, 0x44}));
}

/// DSAPs that are no SAP of a DP-V0 slave: 48 to 53 are those of DP-V1, 58 knows only SDN.
std::vector<std::uint8_t> unknown_saps()
{
    std::vector<std::uint8_t> all;
    for (std::uint8_t sap = 0; sap <= 54; ++sap) all.push_back(sap);
    all.push_back(58);
    all.push_back(63);
    return all;
}

void refuses_unknown_saps(Bench& b, const char* state)
{
    for (const std::uint8_t sap : unknown_saps()) {
        EXPECT_EQ(b.owner.asks(sap), "RS") << state << ", DSAP " << int{sap};
        EXPECT_EQ(b.owner.asks(sap, {0x01, 0x02}), "RS") << state << ", with data, DSAP " << int{sap};
    }
    for (const std::uint8_t sap : Octets{56, 57, 59, 60, 61, 62})
        EXPECT_EQ(b.owner.asks(sap, {}, 61), "RS") << state << ", SSAP 61, DSAP " << int{sap};
    // Only one of the two addresses has an extension: DSAP without SSAP, and the other way round.
    EXPECT_EQ(b.owner.sends(sd2(kUs | 0x80, 2, b.owner.next_fc(), Octets{60})), "RS") << state;
    EXPECT_EQ(b.owner.sends(sd2(kUs, 2 | 0x80, b.owner.next_fc(), Octets{62})), "RS") << state;
}

void C06_UnknownSaps(Bench& b)
{
    refuses_unknown_saps(b, "Wait_Prm");
    EXPECT_EQ(b.diag(), kWaitPrm);
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    refuses_unknown_saps(b, "Data_Exch");
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4}));
}

void refuses_other_services(Bench& b, const char* state)
{
    EXPECT_EQ(b.owner.sends(sd1(kUs, 2, 0x4E)), "RS") << state << ", Ident";
    EXPECT_EQ(b.owner.sends(sd1(kUs, 2, 0x4F)), "RS") << state << ", LSAP status";
    for (const std::uint8_t service : Octets{0x03, 0x05, 0x07}) { // SDA low, SDA high, MSRD
        const auto fc = [&] { return static_cast<std::uint8_t>((b.owner.next_fc() & 0xF0) | service); };
        EXPECT_EQ(b.owner.sends(sd2(kUs, 2, fc(), {0x01, 0x02})), "RS") << state << ", FC " << int{service};
        EXPECT_EQ(b.owner.sends(sd2(kUs, 2, fc(), Saps{60, 62})), "RS") << state << ", FC " << int{service};
    }
}

void C06_OtherServices(Bench& b)
{
    refuses_other_services(b, "Wait_Prm");
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    refuses_other_services(b, "Data_Exch");
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4}));
}

void C07_RepeatedRequests(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({0x11, 2, 3, 4}))); // FCB of the last request: whichever
    const std::string first = b.owner.data_exchange(words({0x22, 2, 3, 4}));
    EXPECT_EQ(first, inputs_at_start());
    b.slave.set_input(0, 0x4321);
    EXPECT_EQ(b.owner.repeats(), first) << "the stored reply, although the inputs have changed";

    // The same frame count bit with other outputs: a repetition is not carried out.
    const std::uint8_t same = b.owner.next_fc();
    const std::string live = dl({0x4321, kInputsAtStart[1]});
    EXPECT_EQ(b.owner.sends(sd2(kUs, 2, same, words({0x33, 2, 3, 4}))), live) << "FCB has changed: new";
    EXPECT_EQ(b.owner.sends(sd2(kUs, 2, same, words({0x44, 2, 3, 4}))), live) << "a repetition";
    const std::uint8_t next = b.owner.next_fc();
    EXPECT_EQ(b.owner.sends(sd2(kUs, 2, next, Saps{57, 62})), dl({0x33, 2, 3, 4})) << "another service";

    // FCV = 0 begins a sequence, whatever came before.
    EXPECT_EQ(b.owner.sends(sd2(kUs, 2, 0x6D, words({0x55, 2, 3, 4}))), live);
    EXPECT_EQ(b.owner.sends(sd2(kUs, 2, 0x6D, words({0x66, 2, 3, 4}))), live);
    EXPECT_EQ(b.owner.sends(sd2(kUs, 2, 0x5D, Saps{57, 62})), dl({0x66, 2, 3, 4}));

    // A second master has a frame count bit of its own.
    EXPECT_EQ(b.foreign.sends(sd2(kUs, 9, 0x5D, Saps{57, 62})), dl({0x66, 2, 3, 4}));
    EXPECT_EQ(b.owner.sends(sd2(kUs, 2, 0x5D, words({0x77, 2, 3, 4}))), live);
    EXPECT_EQ(b.foreign.sends(sd2(kUs, 9, 0x5D, Saps{57, 62})), dl({0x77, 2, 3, 4}));
}

} // namespace

void add_fdl_cases(std::vector<Case>& all)
{
    all.push_back({.name = "C01_FdlStatusInEveryState",
                   .asks = "FDL status is answered with SD1 and FC 00 in every state, to every master",
                   .run = C01_FdlStatusInEveryState});
    all.push_back({.name = "C02_WhatIsNotForTheStation",
                   .asks = "Silence to the address 127, other addresses, the own address as sender, replies, "
                           "tokens, SDN and reserved functions",
                   .run = C02_WhatIsNotForTheStation});
    all.push_back({.name = "C02_MixedNetwork",
                   .asks =
                       "Tokens, FMS, DP-V1 and replies of other stations between its own telegrams change "
                       "nothing",
                   .run = C02_MixedNetwork});
    add_corruption_cases(all);
    all.push_back({.name = "C05_Sd3InsteadOfSd2",
                   .asks = "Chk_Cfg and Data_Exchange of eight octets in SD3 have the effect of SD2",
                   .run = C05_Sd3InsteadOfSd2});
    all.push_back({.name = "C06_UnknownSaps",
                   .asks = "RS from each SAP that is not there, for another SSAP, and for one SAP alone",
                   .run = C06_UnknownSaps});
    all.push_back({.name = "C06_OtherServices",
                   .asks = "RS to SDA, MSRD, Ident and LSAP status",
                   .run = C06_OtherServices});
    all.push_back({.name = "C07_RepeatedRequests",
                   .asks = "An equal frame count bit brings the same octets and nothing is carried out; a "
                           "changed one, FCV = 0 and another master are new",
                   .run = C07_RepeatedRequests});
}

} // namespace conformance
