// SPDX-License-Identifier: Apache-2.0
// One question of a search over EI-ASCII: what it takes for an answer, and that nothing is written.
#include "drive/fake_drive.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using test::FakeDrive;
using test::Fault;
using Kind = Sight::Kind;

class EiLook : public testing::Test {
protected:
    EiLook()
    {
        line.drives = {&dc};
        dc.parameters["II"].text = ">2650";
    }
    Sight look(const std::string& mnemonic, UnitAddress unit = {0, 0})
    {
        EiAsciiClient client{
            line, {.baud = 9600, .timeout = 200ms, .rules = {.echo = EchoMode::automatic}}, {}};
        return client.look(unit, {{mnemonic[0], mnemonic[1]}, 0});
    }
    test::SimulatedLine line;
    FakeDrive dc{'0', '0'};
};

TEST_F(EiLook, GivesTheTextOfAValue)
{
    EXPECT_EQ(look("II").kind, Kind::value);
    EXPECT_EQ(look("II").text, ">2650");
}

TEST_F(EiLook, IsOneQuestionThatWritesNothingAlsoWhereTheDriveDenies)
{
    EXPECT_EQ(look("zz").kind, Kind::denied);
    EXPECT_EQ(line.sent, "\x04"
                         "0000zz\x05");
}

TEST_F(EiLook, DistinguishesSilenceFromSomethingThatIsNoAnswer)
{
    EXPECT_EQ(look("II", {0, 1}).kind, Kind::silence);
    dc.faults = {Fault::bad_bcc};
    EXPECT_EQ(look("II").kind, Kind::damaged);
}

TEST_F(EiLook, TakesItsOwnEchoForNoAnswer)
{
    line.echoes = true;
    EXPECT_EQ(look("II").kind, Kind::value);
    dc.alive = false;
    EXPECT_NE(look("II").kind, Kind::value);
    EXPECT_NE(look("II").kind, Kind::denied);
}

} // namespace
} // namespace dpslave::drive
