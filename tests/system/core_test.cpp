// SPDX-License-Identifier: Apache-2.0
// The core is enough for a slave: what a project needs that wants base, fdl and dp without the daemon.
// Only here: a program that is linked with the public libraries alone.
#include "gateway.hpp"
#include "support/paths.hpp"

namespace dpslave::test {
namespace {

TEST(Core, ASlaveOfBaseFdlAndDpAloneExchangesWithAMaster)
{
    Folder folder;
    Process line{
        {program_path("dpsim"), "line", "--baud", "19200", "--a", folder / "plc", "--b", folder / "slave"}};
    ASSERT_TRUE(line.says("ready"));
    Process slave{{built_path("tests/core_slave"), folder / "slave"}};
    Process master{{program_path("dpsim"), "master", "--port", folder / "plc", "--baud", "19200", "--slave",
                    "5", "--ident", "0x1234", "--no-sync-freeze", "--cfg", "70 70", "--script", "-"}};

    for (const char* const command : {"start 60s", "out 1 = 0x1234", "out 2 = 0xFEDC",
                                      "wait 60s for in 1 = 0x1234", "wait 60s for in 2 = 0xFEDC", "quit"})
        master.send_line(command);

    EXPECT_EQ(master.wait(), 0);
    EXPECT_FALSE(master.ever_said("not as the standard has it"));
}

} // namespace
} // namespace dpslave::test
