// SPDX-License-Identifier: Apache-2.0
/// The extended diagnosis of the devices that have one, with the telegrams that their manuals print (B-080 to
/// B-082, C-015 to C-017, X-15, X-17).
#include "dp/bench.hpp"

namespace test {
namespace {

class TechnologyBoxDiagnosis : public DpBench {
protected:
    explicit TechnologyBoxDiagnosis(dpslave::dp::Personality device = technology_box())
        : DpBench(std::move(device))
    {}
    /// Demand Data alone: no input has to be waited for.
    void exchanges()
    {
        ASSERT_EQ(first.set_prm("88 14 01 0B 16 49 01"), "SC");
        ASSERT_EQ(first.chk_cfg("73"), "SC");
        ASSERT_EQ(exchange(), "DL");
    }
    /// Whether the reply announces a diagnosis: DH or DL.
    std::string exchange() { return first.data_exchange(Octets(8)).substr(0, 2); }

    Master first{bus, 1}; // the master address of the example
};

TEST_F(TechnologyBoxDiagnosis, GoldenTelegramOfTheManual)
{
    exchanges();
    slave.set_ext_diag(octets("04 01 6A B5"), false);

    EXPECT_EQ(first.slave_diag(), "DL 00 0C 00 01 16 49 04 01 6A B5");
}

TEST_F(TechnologyBoxDiagnosis, ATripSetsTheExtDiagBitWhereConfigured)
{
    exchanges();
    slave.set_ext_diag(octets("04 01 6A B5"), true);
    EXPECT_EQ(first.slave_diag(), "DL 08 0C 00 01 16 49 04 01 6A B5");

    slave.set_ext_diag(octets("04 00 6A B5"), false); // the trip is gone, the user's word stays
    EXPECT_EQ(first.slave_diag(), "DL 00 0C 00 01 16 49 04 00 6A B5");
}

TEST_F(TechnologyBoxDiagnosis, IsSentFromTheFirstMomentOnAsZeros)
{
    EXPECT_EQ(first.slave_diag(), "DL 02 05 00 FF 16 49 04 00 00 00");
    EXPECT_FALSE(seen().diag_pending);
}

TEST_F(TechnologyBoxDiagnosis, TheZerosOfTheStartAreNoEvent)
{
    exchanges(); // DL: nothing is pending
    slave.set_ext_diag(octets("04 00 00 00"), false);

    EXPECT_EQ(exchange(), "DL");
    EXPECT_EQ(first.slave_diag(), "DL 00 0C 00 01 16 49 04 00 00 00");
}

TEST_F(TechnologyBoxDiagnosis, EveryChangeOfTripCodeOrWordIsOneEvent)
{
    exchanges();
    for (const std::string_view block :
         {"04 01 00 00", "04 02 00 00", "04 02 6A 00", "04 02 6A B5", "04 00 6A B5"}) {
        slave.set_ext_diag(octets(block), false);
        EXPECT_EQ(exchange(), "DH") << block;
        EXPECT_EQ(first.slave_diag(), "DL 00 0C 00 01 16 49 " + std::string{block});
        EXPECT_EQ(exchange(), "DL") << block;
        slave.set_ext_diag(octets(block), false);
        EXPECT_EQ(exchange(), "DL") << block;
    }
}

TEST_F(TechnologyBoxDiagnosis, NoBlocksMeansTheZerosAgain)
{
    exchanges();
    slave.set_ext_diag(octets("04 01 6A B5"), true);
    first.slave_diag();
    slave.set_ext_diag({}, false);

    EXPECT_EQ(exchange(), "DH");
    EXPECT_EQ(first.slave_diag(), "DL 00 0C 00 01 16 49 04 00 00 00");
}

TEST_F(TechnologyBoxDiagnosis, OutlivesTheExchangeAndARestart)
{
    exchanges();
    slave.set_ext_diag(octets("04 01 6A B5"), false);
    slave.stop(bus.now());
    slave.start(bus.now());

    EXPECT_EQ(first.slave_diag(), "DL 02 05 00 FF 16 49 04 01 6A B5");
    exchanges();
}

class ControllerDiagnosis : public DpBench {
protected:
    ControllerDiagnosis() : DpBench(controller()) {}
    void exchanges()
    {
        ASSERT_EQ(at_36.set_prm("88 14 01 0B 24 08 01"), "SC");
        ASSERT_EQ(at_36.chk_cfg("73"), "SC");
    }
    std::string exchange() { return at_36.data_exchange(Octets(8)).substr(0, 2); }

    Master at_36{bus, 0x24}; // the 24 of the example is its master's address
};

TEST_F(ControllerDiagnosis, ExampleOfTheHandbook)
{
    exchanges();
    slave.set_ext_diag(octets("03 40 30"), false); // manual, sensor break, IP1 fault

    const std::string diagnosis = at_36.slave_diag();

    EXPECT_EQ(diagnosis, "DL 00 0C 00 24 24 08 03 40 30");
    const std::string from_the_second_octet = diagnosis.substr(6); // as printed: XX XX 24 XX XX 03 40 30
    EXPECT_EQ(from_the_second_octet.substr(6, 2), "24");
    EXPECT_EQ(from_the_second_octet.substr(15), "03 40 30");
}

TEST_F(ControllerDiagnosis, IsAlwaysSentAlsoWithoutAnAlarm)
{
    EXPECT_EQ(at_36.slave_diag(), "DL 02 05 00 FF 24 08 03 00 00");
    exchanges();
    EXPECT_EQ(exchange(), "DL");
    EXPECT_EQ(at_36.slave_diag(), "DL 00 0C 00 24 24 08 03 00 00");
}

TEST_F(ControllerDiagnosis, EveryBitThatComesOrGoesIsAnEvent)
{
    exchanges();
    for (unsigned bit = 0; bit < 16; ++bit)
        for (const unsigned word : {1u << bit, 0u}) {
            slave.set_ext_diag(
                Octets{3, static_cast<std::uint8_t>(word / 256), static_cast<std::uint8_t>(word % 256)},
                false);
            EXPECT_EQ(exchange(), "DH") << bit;
            at_36.slave_diag();
            EXPECT_EQ(exchange(), "DL") << bit;
        }
}

/// What a device type may ask for at most.
class LongestBlock : public DpBench {
protected:
    LongestBlock() : DpBench(device()) {}
    static dpslave::dp::Personality device()
    {
        auto device = technology_box();
        device.diag_octets = 62;
        device.max_diag_length = 69;
        return device;
    }
};

TEST_F(LongestBlock, FitsIntoTheSixBitsOfItsHeader)
{
    EXPECT_EQ(master.slave_diag(), "DL 02 05 00 FF 16 49 3F " + show(Octets(62)));
}

TEST_F(OptionBoard, OfADeviceWithoutABlockNothingIsSent)
{
    EXPECT_EQ(master.slave_diag(), "DL 02 05 00 FF 05 33");
}

} // namespace
} // namespace test
