// SPDX-License-Identifier: Apache-2.0
// Keys that only some device types have, and drive lines of Modbus RTU.
#include "config_bench.hpp"

namespace dpslave {
namespace {

using config::Config;
using config::StationConfig;
using input::Faults;
using test::BadChange;
using test::kGood;
using test::short_forms;
using test::with;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// A 605 on EI-ASCII at address 5: the lines are those of kGood.
const std::string kBox = with(kGood, "\"590\"", "\"605\"");

/// A 2408f on Modbus RTU: also 19 lines.
const std::string kController =
    with(with(with(kGood, "\"590\"", "\"2408f\""), "protocol = \"ei-ascii\"", "protocol = \"modbus-rtu\""),
         "unit = \"00\"", "unit = \"1\"") +
    "ident = 0x0A0B\n";

class ModbusLine : public test::ConfigFile {};

TEST_F(ModbusLine, has_8_data_bits_no_parity_and_1_stop_bit_unless_said_otherwise)
{
    const config::LineConfig line = good(kController).lines.at(0);
    EXPECT_EQ(line.protocol, config::kModbusRtu);
    EXPECT_EQ(line.format.data_bits, 8);
    EXPECT_EQ(line.format.parity, 'N');
    EXPECT_EQ(line.format.stop_bits, 1);
    EXPECT_EQ(line.timeout, std::chrono::milliseconds{600}) << "block functions take up to 500 ms";
    EXPECT_EQ(good(kGood).lines.at(0).timeout, std::chrono::milliseconds{200});
    EXPECT_EQ(
        good(with(kController, "protocol = \"modbus-rtu\"", "timeout_ms = 50\nprotocol = \"modbus-rtu\""))
            .lines.at(0)
            .timeout,
        std::chrono::milliseconds{50});

    const Config even =
        good(with(kController, "protocol = \"modbus-rtu\"", "protocol = \"modbus-rtu\"\nformat = \"8E1\""));
    EXPECT_EQ(even.lines.at(0).format.parity, 'E');
}

TEST_F(ModbusLine, with_7_data_bits_is_refused)
{
    const std::string seven =
        with(kController, "protocol = \"modbus-rtu\"", "protocol = \"modbus-rtu\"\nformat = \"7E1\"");

    EXPECT_THAT(short_forms(bad(seven)),
                ElementsAre(AllOf(StartsWith("13:10: "), HasSubstr("Modbus RTU has 8 data bits"))));
}

TEST_F(ModbusLine, has_units_1_to_247_in_decimal)
{
    for (const auto& [text, address] : {std::pair{"1", 1}, {"10", 10}, {"247", 247}}) {
        const Config config = good(with(kController, "unit = \"1\"", "unit = \"" + std::string{text} + "\""));
        EXPECT_EQ(config.stations.at(0).unit, (drive::UnitAddress{0, static_cast<std::uint8_t>(address)}));
    }
    for (const char* text : {"0", "248", "254", "256", "0A", "-1", "1 "})
        EXPECT_THAT(
            short_forms(bad(with(kController, "unit = \"1\"", "unit = \"" + std::string{text} + "\""))),
            ElementsAre(AllOf(StartsWith("19:8: "), HasSubstr("\"1\" to \"247\""))))
            << text;
}

TEST_F(ModbusLine, does_not_serve_a_drive_that_speaks_ei_ascii_and_the_other_way_round)
{
    EXPECT_THAT(short_forms(bad(with(kController, "\"2408f\"", "\"590\""))),
                ElementsAre(AllOf(StartsWith("18:8: "), HasSubstr("speaks modbus-rtu"))));
    EXPECT_THAT(
        short_forms(bad(with(with(kController, "\"modbus-rtu\"", "\"ei-ascii\""), "\"1\"", "\"01\""))),
        ElementsAre(AllOf(StartsWith("18:8: "), HasSubstr("is reached by \"modbus-rtu\""))));
}

TEST_F(ModbusLine, may_stand_beside_a_line_of_ei_ascii)
{
    const Config config = good(kBox + R"(
[[line]]
name = "modbus"
port = "/dev/null-modbus"
protocol = "modbus-rtu"

[[station]]
name = "oven"
address = 9
profile = "2404f"
line = "modbus"
unit = "18"
ident = 0x0A0B
)");

    EXPECT_EQ(config.lines.at(config.stations.at(0).line).protocol, config::kEiAscii);
    EXPECT_EQ(config.lines.at(config.stations.at(1).line).protocol, config::kModbusRtu);
    EXPECT_EQ(config.stations.at(1).unit, (drive::UnitAddress{0, 18}));
}

class OpenIdent : public test::ConfigFile {};

TEST_F(OpenIdent, is_never_invented_and_the_message_says_where_to_find_it)
{
    for (const char* profile : {"2408f", "2404f"})
        EXPECT_THAT(short_forms(bad(with(with(kController, "ident = 0x0A0B\n", ""), "2408f", profile))),
                    ElementsAre(AllOf(StartsWith("14:1: 'ident' is missing"), HasSubstr("key Ident_Number"),
                                      HasSubstr("GSD of the plant's PLC project"))));
    for (const char* profile : {"584sv", "590plus", "690plus"})
        EXPECT_THAT(short_forms(bad(with(kBox, "605", profile))),
                    ElementsAre(HasSubstr("of the key Ident_Number in the GSD of the plant's PLC project")));
    EXPECT_EQ(good(kBox).stations.at(0).personality->ident, 0x1649);
}

class TecKeys : public test::ConfigFile {
protected:
    StationConfig box(const std::string& tec = "") const { return good(kBox + tec).stations.at(0); }
};

TEST_F(TecKeys, left_out_mean_the_defaults_of_the_manual)
{
    const StationConfig station = box();

    ASSERT_TRUE(station.tec);
    EXPECT_EQ(station.tec->start, (tec::Settings{.address = 5})) << "the address is that of the station";
    EXPECT_EQ(station.tec->start.type, tec::kProfibusDp);
    EXPECT_EQ(station.tec->trip, profile::TripSource{});
    EXPECT_EQ(station.tec->ext_diagnostic_tag, 0);
    EXPECT_EQ(station.tec->health, station.profile->health);
    EXPECT_EQ(station.tec->run, station.profile->run);
    EXPECT_EQ(station.zero_after, std::chrono::nanoseconds{0});
}

TEST_F(TecKeys, are_all_read)
{
    const StationConfig station = box(R"([station.tec]
type = 2
ext_diagnostic = 0x6AB5
int_diag_select = 100
ride_through = 5
unused_1 = 7
trip_tag = 4
ext_diagnostic_tag = 31
health = "272.3"
run = "!272.4"
)");

    ASSERT_TRUE(station.tec);
    EXPECT_EQ(station.tec->start, (tec::Settings{.type = 2,
                                                 .address = 5,
                                                 .ext_diagnostic = 0x6AB5,
                                                 .int_diag_select = 100,
                                                 .ride_through = 5,
                                                 .unused_1 = 7}));
    EXPECT_EQ(station.tec->trip.bit.tag, 4);
    EXPECT_TRUE(station.tec->trip.is_code);
    EXPECT_EQ(station.tec->ext_diagnostic_tag, 31);
    EXPECT_EQ(station.tec->health, (profile::MirroredLamp{.tag = 272, .mask = 0x0008, .inverted = false}));
    EXPECT_EQ(station.tec->run, (profile::MirroredLamp{.tag = 272, .mask = 0x0010, .inverted = true}));
    EXPECT_EQ(station.zero_after, std::chrono::seconds{5});
    EXPECT_THAT(station.watched, ElementsAre(4, 31, 272)) << "each tag once";
}

TEST_F(TecKeys, of_a_590plus_name_its_trip_by_a_bit_or_its_contrary)
{
    const std::string dc = with(with(kBox, "605", "590plus"), "line = ", "ident = 0x0A0B\nline = ");
    const auto trip = [&](const std::string& value) {
        return good(dc + "[station.tec]\ntrip_tag = " + value + "\n").stations.at(0);
    };

    const StationConfig not_healthy = trip("\"!537.11\"");
    EXPECT_EQ(not_healthy.tec->trip.bit,
              (profile::MirroredLamp{.tag = 537, .mask = 0x0800, .inverted = true}));
    EXPECT_FALSE(not_healthy.tec->trip.is_code);
    EXPECT_THAT(not_healthy.watched, ElementsAre(537));
    EXPECT_EQ(trip("\"!12\"").tec->trip.bit, (profile::MirroredLamp{.tag = 12, .inverted = true}));
    EXPECT_EQ(trip("12").tec->trip.bit, profile::MirroredLamp{.tag = 12}) << "any bit is a trip";
    EXPECT_THAT(trip("\"none\"").watched, IsEmpty());
    EXPECT_THAT(trip("0").watched, IsEmpty());
    EXPECT_THAT(short_forms(bad(dc + "[station.tec]\ntrip_tag = \"537.16\"\n")),
                ElementsAre(AllOf(StartsWith("22:12: "), HasSubstr("as in \"272.3\""))));
}

TEST_F(TecKeys, of_every_box_may_name_the_trip_by_a_bit)
{
    const StationConfig station = box("[station.tec]\ntrip_tag = \"272.3\"\n");
    EXPECT_EQ(station.tec->trip.bit, (profile::MirroredLamp{.tag = 272, .mask = 0x0008}));
    EXPECT_FALSE(station.tec->trip.is_code);
}

TEST_F(TecKeys, of_a_690plus_and_a_590plus_have_their_trip_from_the_profile)
{
    const std::string ac = with(with(kBox, "605", "690plus"), "line = ", "ident = 0x0A0B\nline = ");
    const std::string dc = with(with(kBox, "605", "590plus"), "line = ", "ident = 0x0A0B\nline = ");
    const profile::TripSource tripped{{.tag = 272, .mask = 0x0008, .inverted = false}, false};
    const profile::TripSource not_healthy{{.tag = 537, .mask = 0x0800, .inverted = true}, false};

    EXPECT_EQ(good(ac).stations.at(0).tec->trip, tripped);
    EXPECT_EQ(good(dc).stations.at(0).tec->trip, not_healthy);
    EXPECT_EQ(good(ac + "[station.tec]\ntrip_tag = 0\n").stations.at(0).tec->trip, profile::TripSource{});
}

TEST_F(TecKeys, that_name_no_trip_are_warned_of_at_the_start)
{
    const auto says_so = testing::Contains(HasSubstr("trips of station \"unwinder\" are not known"));
    const std::string ac = with(with(kBox, "605", "690plus"), "line = ", "ident = 0x0A0B\nline = ");

    EXPECT_THAT(short_forms(good(kBox).warnings), says_so);
    EXPECT_THAT(short_forms(good(kBox + "[station.tec]\ntrip_tag = 4\n").warnings), Not(says_so));
    EXPECT_THAT(short_forms(good(ac).warnings), Not(says_so));
    EXPECT_THAT(short_forms(good(ac + "[station.tec]\ntrip_tag = 0\n").warnings), says_so);
}

TEST_F(TecKeys, of_the_lamps_of_a_box_that_has_none_say_so)
{
    const std::string frame_c = with(with(kBox, "605", "690plus"), "line = ", "ident = 0x0A0B\nline = ");

    const StationConfig mirrors = good(frame_c).stations.at(0);
    EXPECT_EQ(mirrors.tec->health, (profile::MirroredLamp{.tag = 272, .mask = 0x0008, .inverted = true}));
    EXPECT_THAT(mirrors.watched, ElementsAre(272));
    const StationConfig none =
        good(frame_c + "[station.tec]\nhealth = \"none\"\nrun = \"none\"\ntrip_tag = 0\n").stations.at(0);
    EXPECT_EQ(none.tec->health, profile::MirroredLamp{});
    EXPECT_EQ(none.tec->run, profile::MirroredLamp{});
    EXPECT_THAT(none.watched, testing::IsEmpty()) << "nothing is polled for them";
}

TEST_F(TecKeys, take_what_a_pc_tool_may_set_for_fault_reports_it)
{
    const auto type = [this](const char* value) {
        return box(std::string{"[station.tec]\ntype = "} + value + "\n").tec->start.type;
    };
    EXPECT_EQ(type("-32768"), -32768);
    EXPECT_EQ(type("65535"), 65535);
    EXPECT_EQ(box("[station.tec]\nride_through = 61\n").tec->start.ride_through, 61);
    EXPECT_THAT(short_forms(bad(kBox + "[station.tec]\ntype = 65536\n")),
                ElementsAre(AllOf(StartsWith("21:8: "), HasSubstr("from -32768 to 65535"))));
}

TEST_F(TecKeys, of_another_kind_are_refused)
{
    EXPECT_THAT(short_forms(bad(kBox + "[station.tec]\ntype = \"PROFIBUS DP\"\n")),
                ElementsAre(AllOf(StartsWith("21:8: "), HasSubstr("a whole number"))));
    EXPECT_THAT(short_forms(bad(kBox + "[station.tec]\nhealth = \"272.16\"\n")),
                ElementsAre(AllOf(StartsWith("21:10: "), HasSubstr("as in \"272.3\""))));
    EXPECT_THAT(short_forms(bad(kBox + "[station.tec]\ntrip_tag = 65536\n")),
                ElementsAre(HasSubstr("from 0 to 65535")));
    EXPECT_THAT(short_forms(bad(kBox + "[station.tec]\nride_trough = 1\n")),
                ElementsAre(HasSubstr("did you mean 'ride_through'?")));
    EXPECT_THAT(short_forms(bad(kController + "[station.tec]\ntype = 2\n")),
                ElementsAre(HasSubstr("no TEC OPTION function block")));
}

TEST_F(TecKeys, make_output_loss_an_error_because_ride_through_alone_decides)
{
    for (const char* loss : {"zero", "hold"})
        EXPECT_THAT(short_forms(bad(kBox + "output_loss = \"" + loss + "\"\n")),
                    ElementsAre(AllOf(StartsWith("20:15: "), HasSubstr("RIDE THROUGH alone"),
                                      HasSubstr("remove 'output_loss'"))));
}

TEST_F(TecKeys, warn_of_every_ride_through_but_0)
{
    EXPECT_THAT(good(kBox + "[station.tec]\ntrip_tag = 4\nride_through = 0\n").warnings, IsEmpty());
    for (const char* seconds : {"-1", "1", "60"}) {
        const Config config = good(kBox + "[station.tec]\nride_through = " + seconds + "\ntrip_tag = 4\n");
        EXPECT_THAT(short_forms(config.warnings),
                    ElementsAre(AllOf(StartsWith("21:16: "), HasSubstr(seconds),
                                      HasSubstr("anything other than 0 could compromise safety"))));
    }
    EXPECT_EQ(box("[station.tec]\nride_through = -1\n").zero_after, std::nullopt) << "never to zero";
}

class DiagnosisKeys : public test::ConfigFile {};

TEST_F(DiagnosisKeys, name_the_status_word_of_a_controller)
{
    const StationConfig by_profile = good(kController).stations.at(0);
    EXPECT_EQ(by_profile.status_tag, 75);
    EXPECT_THAT(by_profile.watched, ElementsAre(75));

    const StationConfig own = good(kController + "[station.diagnosis]\nstatus_tag = 76\n").stations.at(0);
    EXPECT_EQ(own.status_tag, 76);
    EXPECT_THAT(own.watched, ElementsAre(76));
}

TEST_F(DiagnosisKeys, are_no_keys_of_a_device_that_reports_its_trip)
{
    EXPECT_THAT(short_forms(bad(kBox + "[station.diagnosis]\nstatus_tag = 75\n")),
                ElementsAre(AllOf(StartsWith("20:1: "), HasSubstr("no status word"))));
    EXPECT_THAT(short_forms(bad(kController + "[station.diagnosis]\nstatus_tag = 0\n")),
                ElementsAre(HasSubstr("from 1 to 65535")));
}

TEST_F(DiagnosisKeys, switch_the_bit_ext_diag_on_where_there_is_an_extended_diagnosis)
{
    EXPECT_FALSE(good(kBox).stations.at(0).ext_diag_bit);
    EXPECT_TRUE(good(kBox + "ext_diag_bit = true\n").stations.at(0).ext_diag_bit);
    EXPECT_TRUE(good(kController + "ext_diag_bit = true\n").stations.at(0).ext_diag_bit);
}

TEST_F(DiagnosisKeys, of_demand_data_choose_the_extended_reply)
{
    const auto reply = [this](const std::string& more) {
        return good(kController + more).stations.at(0).personality->extended_reply;
    };
    EXPECT_EQ(reply(""), dp::ExtendedReply::table);
    EXPECT_EQ(reply("[station.demand]\nextended_reply = \"table\"\n"), dp::ExtendedReply::table);
    EXPECT_EQ(reply("[station.demand]\nextended_reply = \"example\"\n"), dp::ExtendedReply::example);
    EXPECT_THAT(short_forms(bad(kController + "[station.demand]\nextended_reply = \"sample\"\n")),
                ElementsAre(HasSubstr("Did you mean \"example\"?")));
}

class WriteLimits : public test::ConfigFile {
protected:
    WriteLimits()
    {
        folder_.write("tags/limited.csv", R"(tag,name,type,decimals,min,max,values,confirmed
8,RAMP,INT,1,0.0,600.0,,
9,TRIM,INT,2,,,,
10,MASK,WORD,,,,,
11,MODE,ENUM,,,,0=off;1=local;2=remote,
12,BARE,INT,,,,,
13,FOUND,INT,1,,,,no
)");
    }

    std::string file(const std::string& limits) const
    {
        return std::string{test::kGood} + "tags = \"../tags/limited.csv\"\n[station.write_limits]\n" + limits;
    }
    void expect_refused(const std::string& limits, const std::string& words) const
    {
        EXPECT_THAT(short_forms(bad(file(limits))), ElementsAre(HasSubstr(words))) << limits;
    }
};

TEST_F(WriteLimits, are_values_as_the_drive_displays_them)
{
    const auto limits = good(file("8 = [\"10.5\", \"50.0\"]\n9 = [\"-1.25\", \"0.00\"]\n"
                                  "10 = [\">0001\", \"0x8000\"]\n11 = [\"off\", \"local\"]\n"))
                            .stations.at(0)
                            .write_limits;
    using L = drive::Limits;
    EXPECT_THAT(limits,
                ElementsAre(std::pair{std::uint16_t{8}, L{105, 500}}, std::pair{std::uint16_t{9}, L{-125, 0}},
                            std::pair{std::uint16_t{10}, L{1, 0x8000}},
                            std::pair{std::uint16_t{11}, L{0, 1}}));
    EXPECT_THAT(good(test::kGood).stations.at(0).write_limits, IsEmpty());
}

TEST_F(WriteLimits, that_are_no_values_of_the_tag_are_refused)
{
    const std::string wrong = "write the smallest and the largest value";
    for (const char* const pair :
         {R"(["10.5"])", R"(["1.0", "2.0", "3.0"])", R"(["50.0", "10.5"])", R"(["0.05", "1.0"])",
          R"(["-0.1", "1.0"])", R"(["0.0", "600.1"])", R"(["low", "1.0"])"})
        expect_refused("8 = " + std::string{pair} + "\n", wrong);
}

TEST_F(WriteLimits, of_a_tag_whose_scale_is_not_known_are_refused)
{
    for (const char* const tag : {"12", "13", "14", "70000", "RAMP", "-1"})
        expect_refused(std::string{tag} + " = [\"1\", \"2\"]\n", "has no limits that can be checked");
}

class Resolution : public test::ConfigFile {
protected:
    Resolution()
    {
        folder_.write("etc/own.csv", R"(tag,name,type,decimals,min,max,register,values
1,PV,INT,display,,,,
3,OP,REAL,1,-100.0,100.5,,
8,TI,INT,0,0,65535,,
15,SSEL,ENUM,,,,,0=SP1;1=SP2
20,LOG,REAL,2,,,32776,
30,FAR,REAL,1,,,20000,
75,STAT,WORD,,,,,
16384,HIGH,REAL,1,,,,
)");
    }
    std::shared_ptr<const drive::TagTable> tags(const std::string& more) const
    {
        return good(kController + "tags = \"own.csv\"\n" + more).stations.at(0).tags;
    }
};

TEST_F(Resolution, full_is_the_default_and_leaves_the_table_as_it_is)
{
    for (const char* more : {"", "resolution = \"full\"\n"}) {
        const auto table = tags(more);
        EXPECT_EQ(table->find(1)->decimals, 0) << "display_decimals is 0 by default";
        EXPECT_EQ(table->find(3)->decimals, 1);
        EXPECT_FALSE(table->find(3)->modbus_register);
    }
    EXPECT_FALSE(good(kController).stations.at(0).integer_resolution);
}

TEST_F(Resolution, full_with_display_decimals_gives_them_to_what_follows_the_display)
{
    const auto table = tags("display_decimals = 2\n");

    EXPECT_EQ(table->find(1)->decimals, 2);
    EXPECT_EQ(table->find(3)->decimals, 1);
    EXPECT_EQ(table->find(75)->decimals, 0);
}

TEST_F(Resolution, integer_reads_numbers_from_the_ieee_area_without_decimals)
{
    const auto table = tags("resolution = \"integer\"\ndisplay_decimals = 1\n");

    EXPECT_EQ(table->find(1)->modbus_register, 0x8002);
    EXPECT_EQ(table->find(1)->decimals, 0);
    EXPECT_EQ(table->find(3)->modbus_register, 0x8006);
    EXPECT_EQ(table->find(3)->decimals, 0);
    EXPECT_EQ(table->find(3)->min, -100) << "limits go with the decimals";
    EXPECT_EQ(table->find(3)->max, 100) << "100.5 would be above the limit as a whole number";
    EXPECT_EQ(table->find(20)->modbus_register, 32776) << "it exists already";
    EXPECT_EQ(table->find(20)->decimals, 0);
}

TEST_F(Resolution, full_has_a_number_without_decimals_in_counts_and_integer_in_its_unit)
{
    const auto full = good(kController).stations.at(0).tags;
    EXPECT_EQ(drive::displayed(*full->find(3), 50), "50 counts") << "Output power %: nobody says 5.0 or 50";
    EXPECT_EQ(drive::displayed(*full->find(1), 50), "50 counts") << "nobody says the decimals of the display";
    EXPECT_EQ(drive::displayed(*full->find(22), 50), "50") << "a whole number";

    const auto integer = good(kController + "resolution = \"integer\"\n").stations.at(0).tags;
    EXPECT_EQ(drive::displayed(*integer->find(3), 50), "50");

    const auto display = good(kController + "display_decimals = 0\n").stations.at(0).tags;
    EXPECT_EQ(drive::displayed(*display->find(1), 50), "50");
    EXPECT_EQ(drive::displayed(*tags("")->find(3), 50), "5.0") << "an own table that gives decimals";
}

TEST_F(Resolution, integer_leaves_words_names_and_what_is_not_in_the_ieee_area)
{
    const auto table = tags("resolution = \"integer\"\n");

    EXPECT_FALSE(table->find(15)->modbus_register);
    EXPECT_FALSE(table->find(75)->modbus_register);
    EXPECT_FALSE(table->find(16384)->modbus_register);
    EXPECT_EQ(table->find(16384)->decimals, 1);
    EXPECT_EQ(table->find(30)->modbus_register, 20000);
}

TEST_F(Resolution, integer_leaves_whole_numbers_and_times_where_they_are_whole)
{
    EXPECT_FALSE(tags("resolution = \"integer\"\n")->find(8)->modbus_register);

    const auto shipped = good(kController + "resolution = \"integer\"\n").stations.at(0).tags;
    for (const auto& [tag, modbus_register] : {std::pair{1, 0x8002}, {3, 0x8006}, {24, 0x8030}}) {
        EXPECT_EQ(shipped->find(static_cast<std::uint16_t>(tag))->modbus_register, modbus_register) << tag;
        EXPECT_EQ(shipped->find(static_cast<std::uint16_t>(tag))->decimals, 0);
    }
    for (const int tag : {8, 22, 36, 8202}) // time, number, time, time or rate
        EXPECT_FALSE(shipped->find(static_cast<std::uint16_t>(tag))->modbus_register) << tag;
    for (const drive::Tag& tag : shipped->all()) {
        const bool is_time = tag.notes.find("time type") != std::string::npos;
        EXPECT_FALSE(is_time && (tag.modbus_register || !tag.is_unsigned)) << tag.number;
    }
}

TEST_F(Resolution, of_a_word_that_is_none_of_the_two_is_refused)
{
    EXPECT_THAT(short_forms(bad(kController + "resolution = \"int\"\n")),
                ElementsAre(AllOf(StartsWith("21:14: "), HasSubstr("\"full\" or \"integer\""))));
    EXPECT_THAT(short_forms(bad(kController + "display_decimals = 5\n")),
                ElementsAre(HasSubstr("from 0 to 4")));
    EXPECT_THAT(short_forms(bad(kBox + "resolution = \"full\"\n")),
                ElementsAre(HasSubstr("one resolution only")));
}

TEST_F(Resolution, does_not_change_the_table_of_another_station)
{
    const Config config = good(kController + "resolution = \"integer\"\n" + R"([[station]]
name = "second"
address = 6
profile = "2408f"
line = "p3"
unit = "2"
ident = 0x0A0B
)");

    EXPECT_TRUE(config.stations.at(0).tags->find(24)->modbus_register);
    EXPECT_FALSE(config.stations.at(1).tags->find(24)->modbus_register);
}

class LossOfTheMaster : public test::ConfigFile {};

TEST_F(LossOfTheMaster, leaves_the_outputs_of_a_controller_unless_the_station_says_zero)
{
    EXPECT_EQ(good(kController).stations.at(0).zero_after, std::nullopt);
    EXPECT_EQ(good(kController + "output_loss = \"zero\"\n").stations.at(0).zero_after,
              std::chrono::nanoseconds{0});
}

class DeviceLamps : public test::ConfigFile {};

TEST_F(DeviceLamps, have_the_names_of_their_device)
{
    const StationConfig box = good(kBox + R"([station.leds]
network = "gpio:1"
module = "gpio:2"
health = "gpio:3"
run = "led:run"
)")
                                  .stations.at(0);
    ASSERT_EQ(box.leds.size(), 4U);
    EXPECT_EQ(box.leds[0].lamp, "network");

    const StationConfig controller = good(kController + "[station.leds]\nrem = \"gpio:1\"\n").stations.at(0);
    ASSERT_EQ(controller.leds.size(), 1U);
    EXPECT_EQ(controller.leds[0].lamp, "rem");
    EXPECT_THAT(short_forms(bad(kBox + "[station.leds]\nblue = \"gpio:1\"\n")),
                ElementsAre(HasSubstr("known here are network, module, health, run")));
}

} // namespace
} // namespace dpslave
