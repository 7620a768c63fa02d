// SPDX-License-Identifier: Apache-2.0
// Slave_Diag: C-19 and C-20.
#include "case.hpp"
#include "simulated_slave.hpp"

namespace conformance {
namespace {

/// Slave_Diag with the device's own block; `standard`: octets 1 to 4.
std::string with_block(const Bench& b, const char* standard, const Octets& block)
{
    Octets data = test::octets(standard);
    data.push_back(static_cast<std::uint8_t>(b.family.ident / 256));
    data.push_back(static_cast<std::uint8_t>(b.family.ident % 256));
    data.insert(data.end(), block.begin(), block.end());
    return "DL " + test::show(data);
}
std::string healthy(const Bench& b)
{
    return with_block(b, kExchanging, b.family.healthy);
}
std::string faulty(const Bench& b)
{
    return with_block(b, "08 0C 00 02", b.family.faulty);
}

std::string cycle(Bench& b)
{
    return b.owner.data_exchange(words({1, 2, 3, 4}));
}

std::string pending()
{
    return dh({kInputsAtStart.begin(), kInputsAtStart.end()});
}

void C19_AppearsAndDisappears(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.owner.slave_diag(), healthy(b));
    b.slave.report_fault(true);
    EXPECT_EQ(cycle(b), pending()) << "the same inputs, with DH";
    EXPECT_EQ(cycle(b), pending()) << "until the owner has read";
    EXPECT_EQ(b.owner.slave_diag(), faulty(b));
    EXPECT_EQ(cycle(b), inputs_at_start());
    EXPECT_EQ(b.owner.slave_diag(), faulty(b)) << "reading clears no bit";
    b.slave.report_fault(false);
    EXPECT_EQ(cycle(b), pending()) << "what disappears is reported too";
    EXPECT_EQ(b.owner.slave_diag(), healthy(b));
    EXPECT_EQ(cycle(b), inputs_at_start());
}

void C19_ReadByAnotherMaster(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    b.slave.report_fault(true);
    EXPECT_EQ(b.foreign.slave_diag(), faulty(b));
    EXPECT_EQ(b.foreign.rd_inp(), inputs_at_start()) << "RD_Inp never has DH";
    EXPECT_EQ(cycle(b), pending());
    EXPECT_EQ(b.owner.slave_diag(), faulty(b));
    EXPECT_EQ(cycle(b), inputs_at_start());
    b.slave.report_fault(false);
}

void C19_ChangesBeforeItIsRead(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    b.slave.report_fault(true);
    EXPECT_EQ(cycle(b), pending());
    b.slave.report_fault(false);
    EXPECT_EQ(cycle(b), pending());
    EXPECT_EQ(b.owner.slave_diag(), healthy(b)) << "what is so now";
    EXPECT_EQ(cycle(b), inputs_at_start()) << "read once";
}

/// A fault that stands when a master comes is in its first diagnosis.
void C19_StandsAtStartUp(Bench& b)
{
    b.slave.report_fault(true);
    EXPECT_EQ(b.owner.slave_diag(), with_block(b, "0A 05 00 FF", b.family.faulty));
    EXPECT_EQ(b.owner.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.owner.slave_diag(), with_block(b, "0A 0C 00 02", b.family.faulty));
    b.slave.report_fault(false);
    EXPECT_EQ(b.owner.slave_diag(), with_block(b, kWaitCfg, b.family.healthy));
}

void C20_StatDiagAtStartUp(Bench& b)
{
    b.slave.drive_answers(false);
    EXPECT_EQ(b.owner.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.owner.chk_cfg(cfg()), "SC");
    EXPECT_EQ(b.diag(b.owner), "00 0E 00 02") << "the inputs are not there yet";
    EXPECT_EQ(cycle(b).substr(0, 2), "DH") << "pending as long as it stands";
    EXPECT_EQ(b.diag(b.owner), "00 0E 00 02") << "reading does not end it";
    EXPECT_EQ(cycle(b).substr(0, 2), "DH");
    b.slave.drive_answers(true);
    int polls = 0;
    for (; b.diag() == "00 0E 00 02" && polls < 300; ++polls) b.slave.pass(std::chrono::milliseconds{5});
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_EQ(cycle(b).substr(0, 2), "DH") << "its end is pending";
    EXPECT_EQ(b.diag(b.owner), kExchanging);
    EXPECT_EQ(cycle(b).substr(0, 2), "DL");
}

/// What stands behind a device that is not there must not keep the slave out of the exchange.
void C20_StatDiagEndsWithoutADrive(Bench& b)
{
    b.slave.drive_answers(false);
    EXPECT_EQ(b.owner.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.owner.chk_cfg(cfg()), "SC");
    ASSERT_TRUE(b.becomes_ready());
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), dl({0, 0}));
    b.slave.drive_answers(true);
}

void C20_Length(Bench& b)
{
    const auto length_of = [&] { return test::octets(b.foreign.slave_diag().substr(3)).size(); };
    EXPECT_EQ(length_of(), b.family.most_diag);
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(length_of(), b.family.most_diag);
    if (!b.family.has_diagnosis()) return;
    b.slave.report_fault(true);
    EXPECT_EQ(length_of(), b.family.most_diag);
    b.slave.report_fault(false);
}

/// More blocks than Max_Diag_Data_Len has room for: whole blocks, and Ext_Diag_Overflow.
void C20_Overflow(Bench& b, SimulatedSlave& slave)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    Octets two = b.family.faulty;
    two.insert(two.end(), b.family.faulty.begin(), b.family.faulty.end());
    slave.slave().set_ext_diag(two, true);
    EXPECT_EQ(cycle(b), pending());
    EXPECT_EQ(b.owner.slave_diag(), with_block(b, "08 0C 80 02", b.family.faulty)) << "cut between blocks";
    slave.slave().set_ext_diag(b.family.faulty, true);
    EXPECT_EQ(cycle(b), pending()) << "the end of the overflow is reported too";
    EXPECT_EQ(b.owner.slave_diag(), faulty(b));
}

const char* no_ext_diag(const Family& family)
{
    return family.has_diagnosis() ? nullptr : "The device has no extended diagnosis, only the six octets";
}

} // namespace

void add_diagnosis_cases(std::vector<Case>& all)
{
    all.push_back(
        {.name = "C19_AppearsAndDisappears",
         .asks = "A diagnosis that appears or disappears turns replies into DH until the owner has read it",
         .run = C19_AppearsAndDisappears,
         .not_applicable = no_ext_diag});
    all.push_back({.name = "C19_ReadByAnotherMaster",
                   .asks = "Another master that reads it does not end DH",
                   .run = C19_ReadByAnotherMaster,
                   .not_applicable = no_ext_diag});
    all.push_back({.name = "C19_ChangesBeforeItIsRead",
                   .asks = "A diagnosis that changes before it is read is read once, as it is",
                   .run = C19_ChangesBeforeItIsRead,
                   .not_applicable = no_ext_diag});
    all.push_back({.name = "C19_StandsAtStartUp",
                   .asks = "A fault that stands is in the first diagnosis, with Ext_Diag",
                   .run = C19_StandsAtStartUp,
                   .not_applicable = no_ext_diag});
    all.push_back({.name = "C20_StatDiagAtStartUp",
                   .asks = "Stat_Diag and DH from Chk_Cfg until the inputs are there; its end is reported",
                   .run = C20_StatDiagAtStartUp});
    all.push_back({.name = "C20_StatDiagEndsWithoutADrive",
                   .asks = "A drive that is not there does not keep the slave out of the exchange",
                   .run = C20_StatDiagEndsWithoutADrive});
    all.push_back({.name = "C20_Length",
                   .asks = "Slave_Diag is never longer than Max_Diag_Data_Len",
                   .run = C20_Length});
    all.push_back({.name = "C20_Overflow",
                   .asks = "Diagnosis that does not fit is cut between blocks, with Ext_Diag_Overflow",
                   .run_simulated = C20_Overflow,
                   .why_simulated = "The daemon composes one block, which always fits",
                   .not_applicable = no_ext_diag});
}

} // namespace conformance
