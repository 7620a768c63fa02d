// SPDX-License-Identifier: Apache-2.0
// Tests what the control socket shows of the device types.
#include "app/state/report.hpp"
#include "control/interface.hpp"
#include "device_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using nlohmann::json;
using report::json_of;
using testing::ElementsAre;
using testing::HasSubstr;

class Report : public testing::Test {
protected:
    /// A controller with a table of three tags.
    Report()
    {
        bench.is_a_controller();
        drive::Tag pv, select, program;
        pv.number = 1;
        pv.name = "Process variable";
        pv.decimals = 1;
        select.number = 15;
        select.name = "Setpoint select";
        select.type = drive::TagType::enumeration;
        select.labels = {{.is_bit = false, .number = 0, .text = "SP1"},
                         {.is_bit = false, .number = 1, .text = "SP2"}};
        program.number = 8328;
        program.name = "Program 1 segment 1 type";
        program.labels = {{.is_bit = false, .number = 3, .text = "Dwell"}};
        std::vector<drive::Tag> tags = bench.station.tags->all();
        tags.insert(tags.end(), {pv, select, program});
        bench.station.tags = std::make_shared<const drive::TagTable>(std::move(tags));
    }

    std::string demand(std::array<std::uint16_t, 4> request, std::array<std::uint16_t, 4> reply)
    {
        bench.view.bus.demand_data = true;
        bench.view.bus.demand_request = request;
        bench.view.bus.demand_reply = reply;
        return json_of(app::io_report(bench.view, Instant{})).at("demand").at("words");
    }
    json meanings(std::initializer_list<std::uint8_t> octets)
    {
        const std::vector<std::uint8_t> bytes{octets};
        const json all = json_of(app::diagnosis_octets(bench.station, bytes));
        json result = json::array();
        for (const json& one : all.at("octets")) result.push_back(one.at("meaning"));
        return result;
    }

    test::DeviceBench bench;
};

TEST_F(Report, OfDemandDataHasTheTagOfTheExtendedCommandsInRegister2)
{
    EXPECT_EQ(demand({0x3000, 8328, 0, 0}, {}), "read tag 8328: not answered yet");
    EXPECT_EQ(demand({0x3000, 8328, 0, 0}, {0x1000, 8328, 0, 3}), "read tag 8328: done, value 3 (Dwell)");
    EXPECT_EQ(demand({0x4000, 8328, 0, 3}, {0x1000, 8328, 0, 3}),
              "write 3 (Dwell) to tag 8328: done, value 3 (Dwell)");
    EXPECT_EQ(demand({0x4000, 8328, 0, 3}, {0x7000, 8328, 0, 1}),
              "write 3 (Dwell) to tag 8328: rejected with error code 1");
    EXPECT_EQ(demand({0x3000, 8329, 0, 0}, {0x1000, 8328, 0, 3}), "read tag 8329: not answered yet");
}

TEST_F(Report, OfDemandDataUnderstandsTheRepliesOfWorkedExample2)
{
    EXPECT_EQ(demand({0x3000, 8328, 0, 0}, {0x3000, 8328, 0, 3}), "read tag 8328: done, value 3 (Dwell)");
    EXPECT_EQ(demand({0x3000, 8328, 0, 0}, {37000, 8328, 0, 0}), "read tag 8328: rejected with error code 0");
}

TEST_F(Report, OfDemandDataShowsValuesAsTheTagTableHasThem)
{
    EXPECT_EQ(demand({0x1001, 0, 0, 0}, {0x1001, 0, 0, 9999}), "read tag 1: done, value 999.9");
    EXPECT_EQ(demand({0x200F, 0, 0, 1}, {0x100F, 0, 0, 1}), "write 1 (SP2) to tag 15: done, value 1 (SP2)");
}

TEST_F(Report, OfOneTagNamesItsValue) // as dpctl read and write show it
{
    EXPECT_EQ(app::shown_value(*bench.station.tags, 15, 1), "1 (SP2)");
    EXPECT_EQ(app::shown_value(*bench.station.tags, 1, 9999), "999.9");
    EXPECT_EQ(app::shown_value(*bench.station.tags, 4711, 0x12), ">0012") << "in no table";
}

TEST_F(Report, OfAParameterThatIsReadAndWrittenHasARowForEachDirection)
{
    bench.view.bus.layout.generation = bench.view.drive.generation = 1;
    bench.view.bus.layout.count = 2;
    bench.view.bus.layout.parameters[0] = {.tag = 15, .reads = true, .writes = true};
    bench.view.bus.layout.parameters[1] = {.tag = 1, .reads = true, .writes = false};
    bench.view.bus.inputs = {0, 250};
    bench.view.bus.outputs = {1, 0};

    const json words = json_of(app::words_report(bench.view, Instant{}));
    ASSERT_EQ(words.size(), 3U);
    EXPECT_EQ(words[0].at("direction"), "in");
    EXPECT_EQ(words[0].at("value"), "0 (SP1)");
    EXPECT_EQ(words[0].at("octet"), 0);
    EXPECT_EQ(words[1].at("direction"), "out");
    EXPECT_EQ(words[1].at("tag"), 15);
    EXPECT_EQ(words[1].at("value"), "1 (SP2)");
    EXPECT_EQ(words[1].at("octet"), 0);
    EXPECT_EQ(words[2].at("octet"), 2) << "the second input word";
}

TEST_F(Report, OfTheDiagnosisOfAControllerNamesTheBitsOfTheStatusWord)
{
    EXPECT_THAT(meanings({0x00, 0x0C, 0x00, 0x24, 0x0A, 0x0B, 0x03, 0x40, 0x30}),
                ElementsAre("Station_status_1", "Station_status_2", "Station_status_3",
                            "Master_Add: owned by master 36", "Ident_Number, high octet",
                            "Ident_Number, low octet: 0x0A0B",
                            "header: device-related diagnosis, 3 octets with this one",
                            "status word, high octet",
                            "status word, low octet: >4030 (manual, sensor break, IP1 fault)"));
}

TEST_F(Report, OfTheGoldenDiagnosisNamesTripAndExtDiagnostic)
{
    bench.is_a_box();
    EXPECT_THAT(meanings({0x00, 0x0C, 0x00, 0x01, 0x16, 0x49, 0x04, 0x01, 0x6A, 0xB5}),
                ElementsAre("Station_status_1", "Station_status_2", "Station_status_3",
                            "Master_Add: owned by master 1", "Ident_Number, high octet",
                            "Ident_Number, low octet: 0x1649",
                            "header: device-related diagnosis, 4 octets with this one",
                            "trip code 1: LINK OVERVOLTS", "EXT DIAGNOSTIC, high octet",
                            "EXT DIAGNOSTIC, low octet: >6AB5"));
    EXPECT_EQ(meanings({0, 0, 0, 1, 0x16, 0x49, 4, 0, 0, 0})[7], "trip code 0: NO TRIP");
    bench.profile().diagnosis = profile::DiagForm::tripped;
    EXPECT_EQ(meanings({0, 0, 0, 1, 0x16, 0x49, 4, 31, 0, 0})[7], "trip code 31: TRIPPED");
}

TEST_F(Report, OfADiagnosisThatWasCutOffReadsNothingBehindItsEnd)
{
    EXPECT_EQ(meanings({0, 0, 0, 1, 0x0A, 0x0B, 3, 0x40}).size(), 8U);
    bench.is_a_box();
    EXPECT_EQ(meanings({0, 0, 0, 1, 0x16, 0x49, 4, 1, 0x6A}).size(), 9U);
    EXPECT_EQ(meanings({0, 0, 0, 1, 0x16, 0x49, 4, 1, 0x6A, 0xB5, 0})[10], "extended diagnosis")
        << "too many";
}

TEST_F(Report, OfInfoHasTheCommsStatusAndTheResolutionOfAController)
{
    EXPECT_EQ(json_of(app::info_report(bench.view, std::nullopt, {})).at("comms_status"), "rdY");
    EXPECT_EQ(json_of(app::info_report(bench.view, std::nullopt, {})).at("resolution"), "full");
    EXPECT_TRUE(json_of(app::info_report(bench.view, std::nullopt, {})).at("option_software").is_null());

    bench.view.bus.state = dp::State::data_exch;
    bench.station.integer_resolution = true;
    EXPECT_EQ(json_of(app::info_report(bench.view, std::nullopt, {})).at("comms_status"), "run");
    EXPECT_EQ(json_of(app::info_report(bench.view, std::nullopt, {})).at("resolution"), "integer");
}

TEST_F(Report, OfInfoNamesTheSoftwareOfTheOptionAndTheAddressInForce)
{
    bench.is_a_box();
    bench.profile().selectable_resolution = false;
    bench.profile().option_software = "Version 3.x";
    bench.view.address = 7;

    const json info = json_of(app::info_report(bench.view, std::nullopt, {}));
    EXPECT_EQ(info.at("option_software"), "Version 3.x");
    EXPECT_TRUE(info.at("comms_status").is_null());
    EXPECT_TRUE(info.at("resolution").is_null());
    EXPECT_EQ(info.at("address_active"), 7);
    EXPECT_EQ(json_of(app::station_report(bench.view, Instant{})).at("address"), 7);
}

TEST_F(Report, OfInfoSaysWhereTheMnemonicsComeFrom)
{
    EXPECT_TRUE(json_of(app::info_report(bench.view, std::nullopt, {})).at("mnemonic_rule").is_null());

    bench.profile().mnemonics = drive::MnemonicRule::dc_590plus;
    bench.profile().mnemonic_source = "590+ formula";
    bench.profile().mnemonics_assumed = true;
    const json info = json_of(app::info_report(bench.view, std::nullopt, {}));
    EXPECT_EQ(info.at("mnemonic_rule"), "590plus");
    EXPECT_EQ(info.at("mnemonic_source"), "590+ formula");
    EXPECT_EQ(info.at("mnemonics_assumed"), true);
}

TEST_F(Report, OfInfoCountsNoMoreOctetsThanTheWordsOfTheDevice)
{
    bench.personality().max_parameters = 117;
    bench.personality().max_words = 117;

    EXPECT_EQ(json_of(app::info_report(bench.view, std::nullopt, {})).at("max_input_octets"), 234);
}

TEST_F(Report, OfInfoRepeatsWhatTheFunctionBlockWarnsOf)
{
    bench.is_a_box();
    bench.station.tec->start.ride_through = 5;
    const app::EmulatedDevice device{bench.station};

    const json info = json_of(app::info_report(bench.view, std::nullopt, device.notes()));
    EXPECT_EQ(control::reply_mismatch("GetInfo", {{"stations", json::array({info})}}), std::nullopt);
    ASSERT_EQ(info.at("notes").size(), 1U);
    EXPECT_THAT(info.at("notes")[0].get<std::string>(), HasSubstr("could compromise safety"));
    EXPECT_EQ(json_of(app::info_report(bench.view, std::nullopt, {})).at("notes"), json::array());
}

TEST_F(Report, OfLampsDistinguishesTheThreeFlashesOfABox)
{
    bench.is_a_box();
    const auto network = [this](NetworkState state) {
        led::Condition condition;
        condition.running = true;
        condition.network = state;
        return json_of(app::leds_report(bench.station, condition, Instant{})).at("leds")[0].at("pattern");
    };

    EXPECT_EQ(network(NetworkState::wait_param), "short flash (10 % of 1 s)");
    EXPECT_EQ(network(NetworkState::wait_config), "flash (50 % of 1 s)");
    EXPECT_EQ(network(NetworkState::data_ex_error), "long flash (90 % of 1 s)");
    EXPECT_EQ(network(NetworkState::data_exchange), "on");
    EXPECT_EQ(network(NetworkState::baud_search), "off");
}

TEST_F(Report, OfTheFunctionBlockIsAsTheInterfaceDescribesIt)
{
    bench.is_a_box();
    app::EmulatedDevice device{bench.station};
    bench.update(device);

    const json tec = json_of(app::tec_report("unwinder", device));
    EXPECT_EQ(control::reply_mismatch("GetTec", {{"stations", json::array({tec})}}), std::nullopt);
    EXPECT_EQ(tec.at("view"), "profibus");
    EXPECT_EQ(tec.at("trip"), "unknown: tag 4 was never read");
    EXPECT_TRUE(tec.at("tripped").is_null());
    ASSERT_EQ(tec.at("rows").size(), 10U);
    EXPECT_EQ(tec.at("rows")[0].at("name"), "TYPE");
    EXPECT_EQ(tec.at("rows")[0].at("shown"), "PROFIBUS DP");

    bench.drive_reads({1, 0});
    bench.update(device);
    EXPECT_EQ(json_of(app::tec_report("unwinder", device)).at("trip"), "1: LINK OVERVOLTS");
    EXPECT_EQ(json_of(app::tec_report("unwinder", device)).at("tripped"), true);

    ASSERT_FALSE(device.tec()->set("TYPE", "1"));
    EXPECT_EQ(json_of(app::tec_report("unwinder", device)).at("view"), "generic");
}

TEST_F(Report, OfTheFunctionBlockHasTheNonSpecificNameOfEachRowWhateverTypeIs)
{
    bench.is_a_box();
    app::EmulatedDevice device{bench.station};
    bench.update(device);
    const auto generic_names = [&] {
        std::vector<std::string> names;
        const json tec = json_of(app::tec_report("unwinder", device));
        for (const json& row : tec.at("rows")) names.push_back(row.at("generic_name"));
        return names;
    };
    const auto names = ElementsAre("TYPE", "INPUT 1", "INPUT 2", "INPUT 3", "INPUT 4", "INPUT 5", "FAULT",
                                   "VERSION", "OUTPUT 1", "OUTPUT 2");

    EXPECT_THAT(generic_names(), names) << "TYPE is PROFIBUS DP";
    ASSERT_FALSE(device.tec()->set("TYPE", "1"));
    EXPECT_THAT(generic_names(), names);
}

TEST_F(Report, OfAValueThatCannotBeWrittenNamesThoseThatCan)
{
    EXPECT_THAT(app::bad_value_words(*bench.station.tags->find(15), AccessError::value_not_encoded),
                HasSubstr("one of SP1, SP2"));
}

TEST_F(Report, OfAValueThatCannotBeWrittenCountsTheDecimalsAsTyped)
{
    drive::Tag tag;
    const auto words = [&](std::uint8_t decimals) {
        tag.decimals = decimals;
        return app::bad_value_words(tag, AccessError::value_not_encoded);
    };

    EXPECT_EQ(words(0), "takes an INT");
    EXPECT_EQ(words(1), "takes an INT with up to 1 decimal");
    EXPECT_EQ(words(2), "takes an INT with up to 2 decimals");
}

TEST(ReportOfTheBus, HasAnOpenPortBeforeItsThreadHasPublishedAnything)
{
    const config::Config config;
    app::View view;
    view.config = &config;
    const report::Bus bus = app::bus_report(view, {});
    EXPECT_TRUE(bus.port_open && bus.driver_works) << "else the doctor names a vanished port";
    view.bus.port_open = false;
    EXPECT_FALSE(app::bus_report(view, {}).port_open);
}

} // namespace
} // namespace dpslave
