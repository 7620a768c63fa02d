// SPDX-License-Identifier: Apache-2.0
#include "device_bench.hpp"

#include "dpslave/led/pattern.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using app::BusOrders;
using app::EmulatedDevice;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

auto says(const char* text)
{
    return Field(&app::Sentence::text, HasSubstr(text));
}

class Box : public testing::Test {
protected:
    Box() { bench.is_a_box(); }

    /// What the device makes of what is the case now.
    EmulatedDevice& looked()
    {
        if (!device) device.emplace(bench.station);
        bench.update(*device);
        return *device;
    }
    std::vector<app::Sentence> news()
    {
        looked();
        return bench.news.take();
    }
    std::int32_t value(std::string_view row)
    {
        for (const tec::Row& one : looked().tec()->rows())
            if (one.name == row) return one.value;
        ADD_FAILURE() << "no row " << row;
        return 0;
    }
    std::vector<std::uint8_t> block()
    {
        const BusOrders orders = looked().bus_orders();
        const Bytes bytes = orders.ext_diag.bytes();
        return {bytes.begin(), bytes.end()};
    }

    test::DeviceBench bench;
    std::optional<EmulatedDevice> device;
};

TEST_F(Box, SendsItsBlockAlsoWhenThereIsNothingToSay)
{
    EXPECT_THAT(block(), ElementsAre(0x04, 0x00, 0x00, 0x00));
}

TEST_F(Box, SendsTheBlockOfTheGoldenTelegram)
{
    bench.station.tec->start.ext_diagnostic = 0x6AB5;
    bench.drive_reads({1, 0});

    EXPECT_THAT(block(), ElementsAre(0x04, 0x01, 0x6A, 0xB5));
    EXPECT_EQ(device->trip(), "1: LINK OVERVOLTS");
}

TEST_F(Box, Of590PlusReportsATripWithoutItsReason)
{
    bench.is_a_box(profile::DiagForm::tripped);
    bench.drive_reads({0x0004, 0});

    EXPECT_THAT(block(), ElementsAre(0x04, 31, 0x00, 0x00));
    EXPECT_EQ(device->trip(), "31: TRIPPED");
}

TEST_F(Box, Of590PlusIsTrippedWhileItIsNotHealthy)
{
    bench.is_a_box(profile::DiagForm::tripped);
    bench.station.tec->trip.bit.mask = 0x0800; // "!4.11"
    bench.station.tec->trip.bit.inverted = true;
    EXPECT_THAT(block(), ElementsAre(0x04, 0x00, 0x00, 0x00)) << "a bit that was never read is no trip";
    EXPECT_EQ(device->tripped(), std::nullopt);

    bench.drive_reads({0x0900, 0}); // healthy and running
    EXPECT_THAT(block(), ElementsAre(0x04, 0x00, 0x00, 0x00));
    EXPECT_EQ(device->tripped(), false);
    bench.drive_reads({0x1000, 0});
    EXPECT_THAT(block(), ElementsAre(0x04, 31, 0x00, 0x00));
    EXPECT_EQ(device->tripped(), true);
}

TEST_F(Box, OfAnyDeviceReportsABitOfATripAs31)
{
    bench.station.tec->trip = {{.tag = 4, .mask = 0x0008}, false}; // "4.3"
    bench.drive_reads({0x0008, 0});
    EXPECT_THAT(block(), ElementsAre(0x04, 31, 0x00, 0x00));
    EXPECT_EQ(device->trip(), "31: TRIPPED");
    bench.drive_reads({0x0001, 0}); // as a code it would be LINK OVERVOLTS
    EXPECT_THAT(block(), ElementsAre(0x04, 0x00, 0x00, 0x00));
}

TEST_F(Box, SaysThatTripsAreNotKnownWhereNoTagReportsThem)
{
    bench.station.tec->trip = {};
    EXPECT_THAT(*looked().trip(), StartsWith("not known"));
    EXPECT_EQ(device->trip_tag(), std::nullopt);
    EXPECT_EQ(device->tripped(), std::nullopt);
    EXPECT_THAT(block(), ElementsAre(0x04, 0x00, 0x00, 0x00));
}

TEST_F(Box, DoesNotKnowTheTripBeforeItsTagWasRead)
{
    EXPECT_EQ(looked().trip(), "unknown: tag 4 was never read");
    EXPECT_EQ(device->tripped(), std::nullopt);

    bench.drive_reads({0, 0});
    bench.view.drive.watched[0].state = WordState::invalid_tag;
    EXPECT_EQ(looked().trip(), "unknown: tag 4 was never read");
    EXPECT_THAT(bench.news.take(), Not(Contains(says("trip"))));

    bench.drive_reads({0, 0});
    EXPECT_EQ(looked().trip(), "0: NO TRIP");
    EXPECT_EQ(device->tripped(), false);
}

/// A reload that the running exchange takes.
TEST_F(Box, KeepsWhatWasSetByHandUnlessTheFileSaysSomethingElseThanBefore)
{
    looked();
    EXPECT_EQ(device->tec()->set("RIDE THROUGH", "7"), std::nullopt);
    EXPECT_EQ(device->tec()->set("INT DIAG SELECT", "100"), std::nullopt);
    config::StationConfig other = bench.station;
    other.tec->start.int_diag_select = 500;
    device->adopt(other);
    EXPECT_EQ(device->tec()->settings().ride_through, 7);
    EXPECT_EQ(device->tec()->settings().int_diag_select, 500);
}

TEST_F(Box, DoesNotTakeAWordOfAnotherTagForItsTripAfterAReload)
{
    bench.drive_reads({0, 5});
    looked();
    config::StationConfig other = bench.station;
    other.tec->trip.bit.tag = other.watched[1]; // read until now for something else
    std::swap(other.watched[0], other.watched[1]);
    device->adopt(other);
    bench.view.drive.watched[0].word = 9; // of the tag that stood first before
    looked();
    EXPECT_EQ(device->trip(), "5: EXTERNAL TRIP");
}

TEST_F(Box, SaysThatATripIsTheLastOneKnownWhileTheDriveIsLost)
{
    bench.drive_reads({5, 0});
    EXPECT_EQ(looked().trip(), "5: EXTERNAL TRIP");
    bench.drive_is_lost();
    EXPECT_EQ(looked().trip(), "5: EXTERNAL TRIP (the drive does not answer)");
    EXPECT_EQ(device->tripped(), true);

    bench.drive_reads({0, 0});
    bench.view.line_open = false;
    EXPECT_EQ(looked().trip(), "0: NO TRIP (the drive does not answer)");
    bench.view.line_open = true;
    bench.view.drive.watched[0].state = WordState::invalid_tag;
    EXPECT_EQ(looked().trip(), "0: NO TRIP (tag 4 can no longer be read)");
}

TEST_F(Box, KeepsLampsAndDiagnosisWhileALostAnswerIsOnlyRepeated)
{
    bench.drive_reads({5, 0x0008});
    const auto before = block();
    for (drive::Watched& one : bench.view.drive.watched) {
        one.state = WordState::stale;
        one.repeated = true;
    }
    EXPECT_EQ(block(), before);
    EXPECT_TRUE(looked().condition().health);
    EXPECT_EQ(device->trip(), "5: EXTERNAL TRIP");
    EXPECT_THAT(bench.news.take(), Not(Contains(says("trip 0"))));

    for (drive::Watched& one : bench.view.drive.watched) one.repeated = false;
    EXPECT_EQ(block(), before) << "a word that is held is the last one known";
    EXPECT_FALSE(looked().condition().health) << "off is bad";
    EXPECT_THAT(*looked().trip(), HasSubstr("can no longer be read"));
}

TEST_F(Box, WithAFailedSelfTestIsSilentAndItsModuleLampFlashesShortly)
{
    device.emplace(bench.station, false);
    EXPECT_FALSE(device->bus_orders().enabled) << "before anything was looked at";

    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::self_test));
    EXPECT_FALSE(device->bus_orders().enabled);
    EXPECT_THAT(device->notes(), Contains(HasSubstr("SELF TEST")));
    const auto lamps = led::lamps(led::Language::technology_box, device->condition());
    const led::Pattern short_flash{std::chrono::seconds{1}, std::chrono::milliseconds{100}};
    EXPECT_EQ(lamps[1].name, "module");
    EXPECT_EQ(lamps[1].pattern, short_flash);
}

TEST_F(Box, KeepsTheLastTripWhileTheDriveIsLost)
{
    bench.drive_reads({5, 0});
    EXPECT_THAT(block(), ElementsAre(0x04, 0x05, 0x00, 0x00));

    bench.drive_is_lost();
    EXPECT_THAT(block(), ElementsAre(0x04, 0x05, 0x00, 0x00));
    EXPECT_THAT(bench.news.take(), Contains(says("trip of the drive: 5: EXTERNAL TRIP")));
}

TEST_F(Box, SetsTheBitExtDiagOnlyForATripAndOnlyWhenConfigured)
{
    bench.drive_reads({1, 0});
    EXPECT_FALSE(looked().bus_orders().ext_diag_fault);

    bench.station.ext_diag_bit = true;
    EXPECT_TRUE(looked().bus_orders().ext_diag_fault);
    bench.drive_reads({0, 0});
    ASSERT_FALSE(looked().tec()->set("EXT DIAGNOSTIC", "1"));
    EXPECT_FALSE(looked().bus_orders().ext_diag_fault);
}

TEST_F(Box, TakesExtDiagnosticFromATagOfTheDrive)
{
    bench.station.tec->ext_diagnostic_tag = 31;
    bench.station.watched = {4, 31};
    bench.drive_reads({0, 0x1234});

    EXPECT_EQ(value("EXT DIAGNOSTIC"), 0x1234);
    EXPECT_THAT(block(), ElementsAre(0x04, 0x00, 0x12, 0x34));
    EXPECT_THAT(device->tec()->set("EXT DIAGNOSTIC", "1").value_or(""), HasSubstr("follows tag 31"));
    EXPECT_THAT(device->notes(), ElementsAre(HasSubstr("follows tag 31")));
}

TEST_F(Box, IsSilentWithATypeThatIsNotProfibusDp)
{
    EXPECT_TRUE(looked().bus_orders().enabled);

    ASSERT_FALSE(looked().tec()->set("type", "1"));
    EXPECT_FALSE(looked().bus_orders().enabled);
    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::type_mismatch));
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::disabled));
    EXPECT_EQ(device->condition().fault, OptionFault::type_mismatch);
    EXPECT_THAT(device->notes(), Contains(AllOf(HasSubstr("TYPE MISMATCH"), HasSubstr("set TYPE to 2"))));

    ASSERT_FALSE(looked().tec()->set("TYPE", "PROFIBUS DP"));
    EXPECT_TRUE(looked().bus_orders().enabled);
    EXPECT_THAT(device->notes(), IsEmpty());
}

TEST_F(Box, WithAWrongTypeInTheFileIsSilentFromTheStart)
{
    bench.station.tec->start.type = 3;

    EXPECT_FALSE(EmulatedDevice(bench.station).bus_orders().enabled) << "before anything was looked at";
}

TEST_F(Box, TakesAnyNumberOf16BitsAndSaysWhichInputIsOutOfRange)
{
    ASSERT_FALSE(looked().tec()->set("RIDE_THROUGH", "61"));

    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::parameter));
    EXPECT_FALSE(looked().bus_orders().enabled);
    EXPECT_THAT(device->notes(), Contains(HasSubstr("RIDE THROUGH is out of range")));
    EXPECT_EQ(device->zero_after_ms(), 0) << "a time that is none counts as 0";
}

TEST_F(Box, ChangesItsAddressWhileItRuns)
{
    EXPECT_EQ(looked().address(), 5);
    EXPECT_EQ(device->tec()->address_after("ADDRESS", "7"), 7);
    EXPECT_EQ(device->tec()->address_after("ADDRESS", "5"), std::nullopt) << "it has it already";
    EXPECT_EQ(device->tec()->address_after("ADDRESS", "126"), std::nullopt);
    EXPECT_EQ(device->tec()->address_after("TYPE", "7"), std::nullopt);

    ASSERT_FALSE(looked().tec()->set("ADDRESS", "7"));
    EXPECT_EQ(looked().address(), 7);
    EXPECT_EQ(device->bus_orders().address, 7);
    ASSERT_FALSE(looked().tec()->set("ADDRESS", "126"));
    EXPECT_EQ(looked().address(), 7) << "the last one that was an address";
    EXPECT_FALSE(device->bus_orders().enabled);
}

TEST_F(Box, HintsThatAddresses0To2AreUsuallyMasters)
{
    for (const char* address : {"0", "1", "2"}) {
        ASSERT_FALSE(looked().tec()->set("ADDRESS", address));
        EXPECT_THAT(looked().notes(), Contains(HasSubstr("usually reserved for PROFIBUS masters")));
    }
    ASSERT_FALSE(looked().tec()->set("ADDRESS", "3"));
    EXPECT_THAT(looked().notes(), Not(Contains(HasSubstr("usually reserved"))));
}

TEST_F(Box, PrintsTheSafetyWarningWheneverRideThroughIsNot0)
{
    EXPECT_THAT(looked().notes(), IsEmpty());
    for (const char* seconds : {"1", "60", "-1"}) {
        ASSERT_FALSE(looked().tec()->set("RIDE THROUGH", seconds));
        EXPECT_THAT(looked().notes(), Contains(HasSubstr("could compromise safety")));
    }
    ASSERT_FALSE(looked().tec()->set("RIDE THROUGH", "0"));
    EXPECT_THAT(looked().notes(), IsEmpty());
}

TEST_F(Box, WarnsInTheLogWheneverRideThroughIsSetToAnythingOtherThan0)
{
    news();
    const auto warns = AllOf(says("could compromise safety"), Field(&app::Sentence::is_warning, true));
    for (const char* seconds : {"5", "60", "-1"}) {
        ASSERT_FALSE(looked().tec()->set("RIDE THROUGH", seconds));
        EXPECT_THAT(news(), ElementsAre(warns)) << seconds;
        ASSERT_FALSE(looked().tec()->set("RIDE THROUGH", seconds));
        EXPECT_THAT(news(), IsEmpty()) << "the same again";
    }
    ASSERT_FALSE(looked().tec()->set("RIDE THROUGH", "0"));
    EXPECT_THAT(news(), ElementsAre(AllOf(says("RIDE THROUGH is 0 again"),
                                          Field(&app::Sentence::is_warning, false))));
}

TEST_F(Box, PublishesItsRideThroughToTheDriveLine)
{
    EXPECT_EQ(looked().zero_after_ms(), 0);
    ASSERT_FALSE(looked().tec()->set("RIDE THROUGH", "5"));
    EXPECT_EQ(looked().zero_after_ms(), 5000);
    ASSERT_FALSE(looked().tec()->set("RIDE THROUGH", "-1"));
    EXPECT_EQ(looked().zero_after_ms(), app::kNeverToZero);
}

TEST_F(Box, SaysThatASettingLastsUntilTheNextStartAndOnlyWhereItDiffersFromTheFile)
{
    ASSERT_FALSE(looked().tec()->set("INT DIAG SELECT", "100"));
    EXPECT_THAT(looked().notes(), ElementsAre(AllOf(HasSubstr("until the next start"), HasSubstr("file"))));
    ASSERT_FALSE(looked().tec()->set("INT DIAG SELECT", "0"));
    EXPECT_THAT(looked().notes(), IsEmpty());
}

TEST_F(Box, RefusesWhatIsNoInputAndNamesThoseThatAre)
{
    EXPECT_THAT(looked().tec()->set("FAULT", "0").value_or(""),
                AllOf(HasSubstr("is an output"), HasSubstr("TYPE")));
    EXPECT_THAT(looked().tec()->set("SPEED", "0").value_or(""), HasSubstr("no such input"));
    EXPECT_THAT(looked().tec()->set("ADDRESS", "five").value_or(""), HasSubstr("0 to 125"));
    EXPECT_EQ(looked().tec()->settings(), bench.station.tec->start) << "nothing was changed";
}

TEST_F(Box, TakesTheNamesOfItsInputsAsTheyAreTypedInAShell)
{
    for (const char* name : {" ride through ", "RIDE-THROUGH", "ride_through", "Input 4"}) {
        EXPECT_EQ(looked().tec()->set(name, "7"), std::nullopt) << name;
        EXPECT_EQ(looked().tec()->settings().ride_through, 7) << name;
        ASSERT_EQ(looked().tec()->set("RIDE THROUGH", "0"), std::nullopt);
    }
    EXPECT_THAT(looked().tec()->set("ext-diagnostic", "five").value_or(""), HasSubstr("0000 to FFFF"));
}

TEST_F(Box, FollowsTheBusWithItsNetworkState)
{
    bench.bus.last_telegram = {};
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::baud_search)) << "nothing was heard yet";
    bench.bus.last_telegram = Instant{} + std::chrono::seconds{1};
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::wait_param));
    bench.view.bus.state = dp::State::wait_cfg;
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::wait_config));
    bench.view.bus.state = dp::State::data_exch;
    bench.drive_reads({0, 0});
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::data_exchange));

    std::vector<std::string> said;
    for (const app::Sentence& news : bench.news.take()) said.push_back(news.text);
    EXPECT_THAT(said,
                ElementsAre("unwinder: NETWORK STATE is BAUD SEARCH", "unwinder: NETWORK STATE is WAIT PARAM",
                            "unwinder: NETWORK STATE is WAIT CONFIG",
                            "unwinder: NETWORK STATE is DATA EXCHANGE"));
    looked();
    EXPECT_THAT(bench.news.take(), IsEmpty()) << "only what has changed";
}

struct NoSignOfLife {
    Baud baud;
    std::chrono::seconds after;
};

class FixedRate : public Box, public testing::WithParamInterface<NoSignOfLife> {};

TEST_P(FixedRate, IsBaudSearchOnceNoTelegramCameForTheDwellAndTheExchangeStays)
{
    bench.bus.baud = GetParam().baud;
    bench.bus.baud_state = fdl::BaudState::fixed;
    bench.bus.last_telegram = Instant{std::chrono::seconds{100}};
    bench.view.bus.state = dp::State::data_exch; // watchdog off
    bench.drive_reads({0, 0});
    bench.bus.taken_at = bench.bus.last_telegram + GetParam().after - std::chrono::nanoseconds{1};
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::data_exchange));
    bench.bus.taken_at = bench.bus.last_telegram + GetParam().after;
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::baud_search));
    EXPECT_TRUE(looked().condition().data_exchange) << "state and outputs stay";
    EXPECT_TRUE(looked().bus_orders().enabled);
    bench.bus.last_telegram = bench.bus.taken_at;
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::data_exchange));
}

INSTANTIATE_TEST_SUITE_P(W2, FixedRate,
                         testing::Values(NoSignOfLife{Baud::k1500, std::chrono::seconds{2}},
                                         NoSignOfLife{Baud::k93_75, std::chrono::seconds{2}},
                                         NoSignOfLife{Baud::k45_45, std::chrono::seconds{4}},
                                         NoSignOfLife{Baud::k9_6, std::chrono::seconds{4}}));

TEST_F(Box, DoesNotTakeASearchedRateThatIsQuietForALostOne)
{
    bench.bus.baud_state = fdl::BaudState::baud_control;
    bench.bus.taken_at = bench.bus.last_telegram + std::chrono::hours{1};
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::wait_param));
    bench.bus.baud_state = fdl::BaudState::baud_search;
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::baud_search));
}

TEST_F(Box, HasNoFaultWhileOnlyThePortOfItsDriveIsGone)
{
    bench.view.line_open = false;
    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::none));
    EXPECT_TRUE(looked().bus_orders().enabled);
}

TEST_F(Box, HasNoPowerWhileItsDriveIsGone)
{
    bench.view.drive.known = true;
    bench.view.drive.presence = drive::DrivePresence::gone;
    bench.view.drive.away = true;
    bench.view.drive.departures = 1;
    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::hardware));
    EXPECT_EQ(value("NETWORK STATE"), static_cast<int>(NetworkState::disabled));
    EXPECT_TRUE(looked().bus_orders().enabled) << "the bus thread knows by itself that the station is away";
    EXPECT_FALSE(looked().condition().health);
    EXPECT_THAT(bench.news.take(), testing::ElementsAre(says("The drive is gone"))) << "one for each leave";
    EXPECT_THAT(device->silent_because(), testing::HasSubstr("The drive is gone"));

    bench.view.drive.away = false;
    bench.view.drive.presence = drive::DrivePresence::here;
    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::none));
    EXPECT_THAT(bench.news.take(), Contains(says("the station is on the bus again")));
}

TEST_F(Box, IsFaultyInItsHardwareWhileThePortOfTheBusIsGone)
{
    bench.bus.port_open = false;
    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::hardware));
    EXPECT_THAT(bench.news.take(),
                Contains(AllOf(says("FAULT is HARDWARE"), Field(&app::Sentence::is_warning, true))));
    bench.bus.port_open = true;
    bench.bus.driver_works = false;
    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::hardware))
        << "a reply that does not reach the bus";
    bench.bus.driver_works = true;
    EXPECT_EQ(value("FAULT"), static_cast<int>(OptionFault::none));
    EXPECT_THAT(bench.news.take(), Contains(says("FAULT is NONE again")));
}

TEST_F(Box, MirrorsHealthAndRunWhileTheDriveAnswers)
{
    bench.drive_reads({0, 0x0008});
    EXPECT_TRUE(looked().condition().health);
    EXPECT_TRUE(looked().condition().run) << "inverted: lit while bit 4 is 0";
    bench.drive_reads({0, 0x0010});
    EXPECT_FALSE(looked().condition().health);
    EXPECT_FALSE(looked().condition().run);
    bench.drive_reads({0, 0x0008});
    bench.drive_is_lost();
    EXPECT_FALSE(looked().condition().health) << "off is bad";
    EXPECT_FALSE(looked().condition().run);
}

TEST_F(Box, ShowsItsLampsAlsoWhileItIsSilentOnTheBus)
{
    bench.view.bus.state = dp::State::power_on;
    ASSERT_FALSE(looked().tec()->set("TYPE", "0"));

    EXPECT_TRUE(looked().condition().running);
    EXPECT_EQ(device->condition().fault, OptionFault::type_mismatch);
}

class Controller : public Box {
protected:
    Controller()
    {
        bench.station.tec.reset();
        bench.profile().has_tec = false;
        bench.is_a_controller();
    }
};

TEST_F(Controller, SendsItsStatusWordAlsoBeforeItWasRead)
{
    EXPECT_THAT(block(), ElementsAre(0x03, 0x00, 0x00));
}

TEST_F(Controller, SendsTheStatusWordOfTheHandbooksExample)
{
    bench.drive_reads({0x4030});

    EXPECT_THAT(block(), ElementsAre(0x03, 0x40, 0x30));
    EXPECT_THAT(bench.news.take(), ElementsAre(says("manual, sensor break, IP1 fault")));
}

TEST_F(Controller, ReportsAFaultOnlyForBitsThatAreFaultsAndOnlyWhenConfigured)
{
    bench.drive_reads({0x0030});
    EXPECT_FALSE(looked().bus_orders().ext_diag_fault);
    bench.station.ext_diag_bit = true;
    EXPECT_TRUE(looked().bus_orders().ext_diag_fault);
    bench.drive_reads({0x0010}); // manual operation is none
    EXPECT_FALSE(looked().bus_orders().ext_diag_fault);
}

TEST_F(Controller, HasNoFunctionBlockAndWritesNothingWhenTheMasterIsLost)
{
    EXPECT_EQ(looked().tec(), nullptr);
    EXPECT_THAT(looked().notes(), IsEmpty());
    EXPECT_EQ(looked().trip(), std::nullopt);
    EXPECT_TRUE(looked().bus_orders().enabled);
    EXPECT_EQ(looked().zero_after_ms(), app::kNeverToZero);
}

TEST(OptionBoard, WithAFailedSelfTestIsNotServed)
{
    test::DeviceBench bench;

    EXPECT_TRUE(EmulatedDevice(bench.station).bus_orders().enabled);
    EXPECT_FALSE(EmulatedDevice(bench.station, false).bus_orders().enabled);
}

TEST(OptionBoard, HasNoExtendedDiagnosis)
{
    test::DeviceBench bench;
    EmulatedDevice device{bench.station};
    bench.update(device);

    EXPECT_TRUE(device.bus_orders().ext_diag.empty());
    EXPECT_EQ(device.zero_after_ms(), 0);
    EXPECT_THAT(bench.news.take(), IsEmpty());
    EXPECT_TRUE(device.condition().running);
}

TEST(ZeroAfter, CrossesBetweenThreadsAsMilliseconds)
{
    using namespace std::chrono_literals;
    for (const drive::ZeroAfter after : {drive::ZeroAfter{}, drive::ZeroAfter{0s}, drive::ZeroAfter{60s}})
        EXPECT_EQ(app::from_ms(app::to_ms(after)), after);
}

} // namespace
} // namespace dpslave
