// SPDX-License-Identifier: Apache-2.0
/// INT DIAGNOSTIC with every selection and code of the manual's list (B-085 to B-089, B-093, B-094).
#include "tec_bench.hpp"

namespace test {
namespace {

using dpslave::AccessError;

using TecIntDiagnostic = TecBench;

TEST_F(TecIntDiagnostic, NoErrorIs0000)
{
    EXPECT_EQ(int_diag(0), 0x0000);
    exchanges();
    EXPECT_EQ(int_diag(0), 0x0000);
}

struct RefusedPrm {
    const char* name;
    std::string user;
    std::uint16_t code;
};

std::string zeros(std::size_t count)
{
    return show(Octets(count));
}

class TecRefusedPrm : public TecBench, public testing::WithParamInterface<RefusedPrm> {};

TEST_P(TecRefusedPrm, HasTheCodeOfTheManual)
{
    master.set_prm(prm(GetParam().user));

    EXPECT_EQ(int_diag(0), GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(B085, TecRefusedPrm,
                         testing::Values(RefusedPrm{"TooLong", zeros(64), 0x0012},
                                         RefusedPrm{"TooLongAndOfAFormThatWouldFit", zeros(65), 0x0012},
                                         RefusedPrm{"TooLongAsATelegramCanBe", zeros(237), 0x0012},
                                         RefusedPrm{"BadLength1", "00", 0x0013},
                                         RefusedPrm{"BadLength2", "00 00", 0x0013},
                                         RefusedPrm{"BadLength4", zeros(4), 0x0013},
                                         RefusedPrm{"BadLength62", zeros(62), 0x0013},
                                         RefusedPrm{"ZeroTagFirst", "00 00 00 00 00 01 0F", 0x0014},
                                         RefusedPrm{"ZeroTagInside", "00 00 00 01 0F 00 00 01 10", 0x0014},
                                         RefusedPrm{"DpV1FunctionHasNone", "80 00 00", 0x0000},
                                         RefusedPrm{"TagTooLargeHasNone", "00 00 00 FF FF", 0x0000}),
                         [](const auto& one) { return std::string{one.param.name}; });

struct RefusedCfg {
    const char* name;
    std::string cfg;
    std::uint16_t code;
};

class TecRefusedCfg : public TecBench, public testing::WithParamInterface<RefusedCfg> {};

TEST_P(TecRefusedCfg, HasTheCodeOfTheManual)
{
    master.set_prm(prm("00 00 00 01 0F 01 0D")); // two tags
    master.chk_cfg(GetParam().cfg);

    EXPECT_EQ(int_diag(0), GetParam().code);
}

std::string reading(std::size_t count)
{
    return show(Octets(count, 0x50));
}

INSTANTIATE_TEST_SUITE_P(
    B085, TecRefusedCfg,
    testing::Values(RefusedCfg{"Empty", "", 0x0021}, RefusedCfg{"TooLong", reading(32), 0x0022},
                    RefusedCfg{"TooLongBeforeAnythingElse", show(Octets(32, 0x51)), 0x0022},
                    RefusedCfg{"ThirtyOneForeignIdentifiers", show(Octets(31, 0x51)), 0x0023},
                    RefusedCfg{"IdentifierZero", "00", 0x0023},
                    RefusedCfg{"OneForeignIdentifier", "51", 0x0023},
                    RefusedCfg{"IdentifierBeforeTheCount", "50 50 50 51", 0x0023},
                    RefusedCfg{"TooLongWithDemandData", "73 " + reading(31), 0x0022},
                    RefusedCfg{"Identifier", "50 51", 0x0023},
                    RefusedCfg{"DemandDataElsewhereThanFirst", "50 73", 0x0023},
                    RefusedCfg{"TooFew", "50", 0x0024}, RefusedCfg{"TooFewWithDemandData", "73 50", 0x0024},
                    RefusedCfg{"TooMany", "50 50 50", 0x0025},
                    RefusedCfg{"TooManyWithDemandData", "73 50 50 50", 0x0025},
                    RefusedCfg{"ThirtyOneAreNotTooLongButTooMany", reading(31), 0x0025}),
    [](const auto& one) { return std::string{one.param.name}; });

TEST_F(TecIntDiagnostic, AnotherIdentNumberHasNoCode)
{
    master.set_prm("88 14 01 0B 05 33 01");

    EXPECT_EQ(int_diag(0), 0x0000);
}

TEST_F(TecIntDiagnostic, KeepsTheCodeWhileStuckAndIsClearedOnceBothAreAccepted)
{
    master.set_prm(prm("00"));
    EXPECT_EQ(int_diag(0), 0x0013);
    master.slave_diag(); // the master looks, and tries again
    EXPECT_EQ(int_diag(0), 0x0013);

    master.set_prm(prm("00 00 00 01 0F 01 0D"));
    EXPECT_EQ(int_diag(0), 0x0000);
    master.chk_cfg("50");
    EXPECT_EQ(int_diag(0), 0x0024);
    master.set_prm(prm("00 00 00 01 0F 01 0D")); // in WAIT CONFIG, with the cause still there
    EXPECT_EQ(int_diag(0), 0x0024);
    master.chk_cfg("50 60");
    EXPECT_EQ(int_diag(0), 0x0000);
}

struct ChangedCfg {
    const char* name;
    const char* cfg;
    std::uint16_t code;
};

constexpr const char* kThirtyTwoForeign =
    "51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51 51";

class TecChangedCfg : public TecBench, public testing::WithParamInterface<ChangedCfg> {};

TEST_P(TecChangedCfg, InDataExchangeSaysHowItDiffersFromTheAcceptedOne)
{
    exchanges(); // 73 60 50 70 50
    master.chk_cfg(GetParam().cfg);

    EXPECT_EQ(int_diag(0), GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(B085, TecChangedCfg,
                         testing::Values(ChangedCfg{"Empty", "", 0x0021}, ChangedCfg{"Zero", "00", 0x0023},
                                         ChangedCfg{"OneForeignIdentifier", "51", 0x0023},
                                         ChangedCfg{"ForeignIdentifierBehindTheOthers", "73 60 50 70 50 51",
                                                    0x0023},
                                         ChangedCfg{"ZeroBehindTheOthers", "73 60 50 70 50 00", 0x0023},
                                         ChangedCfg{"TooLong", kThirtyTwoForeign, 0x0022},
                                         ChangedCfg{"OtherDirections", "73 60 60 70 50", 0x0023},
                                         ChangedCfg{"FewerOfOtherDirections", "73 50 50 70", 0x0024},
                                         ChangedCfg{"MoreOfOtherDirections", "73 50 50 70 60 60", 0x0025},
                                         ChangedCfg{"WithoutDemandData", "60 50 70 50", 0x0023},
                                         ChangedCfg{"Fewer", "73 60 50 70", 0x0024},
                                         ChangedCfg{"More", "73 60 50 70 50 50", 0x0025}),
                         [](const auto& one) { return std::string{one.param.name}; });

TEST_F(TecIntDiagnostic, From100TheTags)
{
    exchanges();

    EXPECT_EQ(int_diag(100), 271);
    EXPECT_EQ(int_diag(101), 269); // the manual's example: 101 is the second parameter
    EXPECT_EQ(int_diag(102), 272);
    EXPECT_EQ(int_diag(103), 255);
}

TEST_F(TecIntDiagnostic, From200TheAccessModes)
{
    exchanges();

    EXPECT_EQ(int_diag(200), 0x0002);
    EXPECT_EQ(int_diag(201), 0x0001);
    EXPECT_EQ(int_diag(202), 0x0003);
    EXPECT_EQ(int_diag(203), 0x0001);
}

struct Access {
    const char* name;
    AccessError error;
    std::uint16_t code;
};

class TecAccessError : public TecBench, public testing::WithParamInterface<Access> {};

TEST_P(TecAccessError, From300HasTheCodeOfTheManual)
{
    exchanges();
    for (std::size_t parameter = 0; parameter < 4; ++parameter) {
        drive.errors = {};
        drive.errors[parameter] = GetParam().error;
        for (std::size_t asked = 0; asked < 4; ++asked)
            EXPECT_EQ(int_diag(300 + static_cast<std::int32_t>(asked)),
                      asked == parameter ? GetParam().code : 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(B088, TecAccessError,
                         testing::Values(Access{"None", AccessError::none, 0},
                                         Access{"OutOfRange", AccessError::out_of_range, 1},
                                         Access{"ReadOnly", AccessError::read_only, 2},
                                         Access{"NotStopMode", AccessError::not_stopped, 3},
                                         Access{"NotConfigurationMode", AccessError::not_config_mode, 4},
                                         Access{"UnsupportedType", AccessError::unsupported_type, 5},
                                         Access{"ValueNotEncoded", AccessError::value_not_encoded, 5},
                                         Access{"InvalidTag", AccessError::invalid_tag, 6},
                                         Access{"SilenceHasNone", AccessError::no_answer, 0},
                                         Access{"NoiseHasNone", AccessError::not_understood, 0}),
                         [](const auto& one) { return std::string{one.param.name}; });

TEST_F(TecIntDiagnostic, From400TheValuesReadOfReadingParameters)
{
    exchanges();
    drive.words[0] = 0x1111; // written only
    drive.words[1] = 0x7530; // 300.00 %
    drive.words[2] = 0x8AD0; // -300.00 %
    drive.words[3] = 0x0001;

    EXPECT_EQ(int_diag(400), 0x0000);
    EXPECT_EQ(int_diag(401), 0x7530);
    EXPECT_EQ(int_diag(402), 0x8AD0);
    EXPECT_EQ(int_diag(403), 0x0001);
}

TEST_F(TecIntDiagnostic, From500TheValuesThatTheMasterWritesAnd0000BeforeItWrites)
{
    exchanges();
    for (std::int32_t select = 500; select < 504; ++select) EXPECT_EQ(int_diag(select), 0x0000);

    master_writes("12 34 56 78");

    EXPECT_EQ(int_diag(500), 0x1234);
    EXPECT_EQ(int_diag(501), 0x0000); // read only by its identifier
    EXPECT_EQ(int_diag(502), 0x5678);
    EXPECT_EQ(int_diag(503), 0x0000);
}

TEST_F(TecIntDiagnostic, AValueThatWasNeverAllowedToBeWrittenIs0000)
{
    exchanges();
    auto seen_without = seen();
    seen_without.outputs[0] = 0x1234;
    seen_without.may_write = false;

    EXPECT_EQ(dpslave::tec::int_diagnostic(500, seen_without, drive), 0x0000);
}

TEST_F(TecIntDiagnostic, OfThirtyParametersTheFirstAndTheLast)
{
    Octets user(3);
    for (std::uint8_t tag = 1; tag <= 30; ++tag) user.insert(user.end(), {0x02, tag});
    start_up(prm(show(user)), show(Octets(30, 0x70)));
    drive.generation = generation();
    for (std::size_t i = 0; i < 30; ++i) drive.words[i] = static_cast<std::uint16_t>(0x4000 + i);
    drive.errors[0] = drive.errors[29] = AccessError::read_only;
    Octets outputs(60);
    outputs[59] = 0x77;
    master.data_exchange(outputs);

    EXPECT_EQ(int_diag(100), 0x0201);
    EXPECT_EQ(int_diag(129), 0x021E);
    EXPECT_EQ(int_diag(229), 0x0003);
    EXPECT_EQ(int_diag(300), 0x0002);
    EXPECT_EQ(int_diag(329), 0x0002);
    EXPECT_EQ(int_diag(400), 0x4000);
    EXPECT_EQ(int_diag(429), 0x401D);
    EXPECT_EQ(int_diag(529), 0x0077);
}

TEST_F(TecIntDiagnostic, OfAParameterThatTheMasterDidNotConfigureIs0000)
{
    exchanges();
    master_writes("12 34 56 78");
    drive.words.fill(0x4711);
    drive.errors.fill(AccessError::read_only);

    for (std::int32_t group = 100; group <= 500; group += 100)
        for (std::int32_t parameter = 4; parameter < 30; ++parameter)
            EXPECT_EQ(int_diag(group + parameter), 0x0000) << group + parameter;
}

TEST_F(TecIntDiagnostic, OutsideTheListedGroupsIs0000)
{
    Octets user(3);
    for (std::uint8_t tag = 1; tag <= 30; ++tag) user.insert(user.end(), {0x02, tag});
    start_up(prm(show(user)), show(Octets(30, 0x70)));
    drive.generation = generation();
    drive.words.fill(0x4711);
    drive.errors.fill(AccessError::read_only);
    master.data_exchange(Octets(60, 0x55));
    const auto snapshot = seen();

    for (std::int32_t select = -32768; select <= 65535; ++select) {
        const bool listed = select >= 100 && select < 600 && select % 100 < 30;
        ASSERT_EQ(dpslave::tec::int_diagnostic(select, snapshot, drive) != 0, listed) << select;
    }
}

TEST_F(TecIntDiagnostic, OfALayoutThatTheDriveSideDoesNotHaveYetIs0000)
{
    exchanges();
    drive.words.fill(0x4711);
    drive.errors.fill(AccessError::read_only);
    drive.generation = generation() - 1;

    EXPECT_EQ(int_diag(300), 0x0000);
    EXPECT_EQ(int_diag(401), 0x0000);
    EXPECT_EQ(int_diag(101), 269); // what the master chose is known
}

TEST_F(TecIntDiagnostic, NothingIsShownOfALayoutThatHasEnded)
{
    exchanges();
    master_writes("12 34 56 78");
    drive.words.fill(0x4711);
    master_lets_go();

    for (const std::int32_t select : {100, 200, 401, 500}) EXPECT_EQ(int_diag(select), 0x0000) << select;
}

} // namespace
} // namespace test
