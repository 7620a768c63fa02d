// SPDX-License-Identifier: Apache-2.0
#include "config_bench.hpp"

namespace dpslave {
namespace {

using config::Config;
using config::load_config;
using input::Faults;
using test::short_forms;
using test::with;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using BadChange = test::BadChange;
using test::ConfigFile;
using test::kGood;
using test::kSecondStation;
using test::kSource;

TEST_F(ConfigFile, with_the_required_keys_only_has_the_defaults_of_the_sample)
{
    const std::string without_group = with(kGood, "[control]\noperator_group = \"root\"\n", "");
    const Config config = good(with(with(without_group, "baud = 187500\n", ""), "direction = \"none\"\n",
                                    "gpio_chip = \"/dev/gpiochip0\"\ngpio_line = 17\n"));

    EXPECT_EQ(config.bus.port, "/dev/null-bus");
    EXPECT_EQ(config.bus.port_line, 2U);
    EXPECT_EQ(config.bus.baud, std::nullopt) << "auto";
    EXPECT_EQ(config.bus.driver_enable, (io::DriverEnableSettings{.direction = io::Direction::gpio,
                                                                  .gpio_chip = "/dev/gpiochip0",
                                                                  .gpio_line = 17,
                                                                  .active_low = false}));
    EXPECT_EQ(config.bus.echo, EchoMode::off);
    EXPECT_EQ(config.bus.max_tsdr, 0U);
    EXPECT_EQ(config.realtime.priority, 80);
    EXPECT_EQ(config.realtime.cpu, -1);
    EXPECT_TRUE(config.realtime.lock_memory);
    EXPECT_EQ(config.trace.bus_kib, 4096U);
    EXPECT_EQ(config.trace.samples_kib, 256U);
    EXPECT_EQ(config.trace.drive_kib, 128U);
    EXPECT_EQ(config.sysfs, "/sys");
    EXPECT_EQ(config.control.socket, "/run/dpslaved/control.sock");
    EXPECT_EQ(config.control.operator_group, "dpslaved");
    ASSERT_EQ(config.lines.size(), 1U);
    EXPECT_EQ(config.lines[0].baud, 9600U);
    EXPECT_EQ(config.lines[0].format.data_bits, 7);
    EXPECT_EQ(config.lines[0].format.parity, 'E');
    EXPECT_EQ(config.lines[0].format.stop_bits, 1);
    EXPECT_EQ(config.lines[0].timeout, std::chrono::milliseconds{200});
    EXPECT_EQ(config.lines[0].retries, 2);
    ASSERT_EQ(config.stations.size(), 1U);
    EXPECT_EQ(config.stations[0].output_refresh, std::chrono::seconds{1});
    EXPECT_EQ(config.stations[0].zero_after, std::chrono::nanoseconds{0});
    EXPECT_FALSE(config.stations[0].tec);
    EXPECT_FALSE(config.stations[0].ext_diag_bit);
    EXPECT_FALSE(config.stations[0].integer_resolution);
    EXPECT_THAT(config.stations[0].watched, IsEmpty());
    EXPECT_THAT(config.stations[0].leds, IsEmpty());
}

TEST_F(ConfigFile, a_station_has_the_personality_and_the_tags_of_its_profile)
{
    const Config config = good(kGood);
    const config::StationConfig& station = config.stations.at(0);

    EXPECT_EQ(station.name, "unwinder");
    EXPECT_EQ(station.address, 5);
    EXPECT_EQ(station.profile->name, "590");
    EXPECT_EQ(station.personality->ident, 0x0533);
    EXPECT_EQ(station.personality->max_tsdr, station.profile->personality.max_tsdr);
    EXPECT_EQ(station.personality->demand_error_base, 0);
    EXPECT_EQ(station.tags->find(55)->name, "SPEED");
    EXPECT_THAT(station.tag_file, EndsWith("tags/empty.csv"));
    EXPECT_EQ(station.line, 0U);
    EXPECT_EQ(station.unit, (drive::UnitAddress{0, 0}));
    EXPECT_EQ(station.unit_text, "00");
    EXPECT_THAT(config.warnings, IsEmpty());
}

TEST_F(ConfigFile, every_key_is_read)
{
    folder_.write("etc/own.csv", "tag,name\n56,LOAD\n");
    const Config config = good(R"([bus]
port = "/dev/null-bus"
baud = 45450
max_tsdr = 500
direction = "gpio"
gpio_chip = "/dev/gpiochip1"
gpio_line = 23
gpio_active_low = true
echo = "auto"
[realtime]
priority = 0
cpu = 1
lock_memory = false
[leds]
sysfs = "/tmp/sys"
[control]
socket = "/tmp/c.sock"
operator_group = "root"
[[line]]
name = "a"
port = "/dev/null-a"
protocol = "ei-ascii"
baud = 19200
format = "8N2"
timeout_ms = 50
retries = 0
[[line]]
name = "b"
port = "/dev/null-b"
protocol = "ei-ascii"
[[station]]
name = "s"
address = 125
profile = "620"
line = "b"
unit = "3f"
ident = 0x1649
tags = "own.csv"
output_refresh_s = 0.25
output_loss = "hold"
[station.demand]
error_base = 1
[station.leds]
red = "gpio:23"
green = "led:dpslaved-green"
)");

    EXPECT_EQ(config.bus.baud, Baud::k45_45);
    EXPECT_EQ(config.bus.max_tsdr, 500U);
    EXPECT_EQ(config.bus.driver_enable, (io::DriverEnableSettings{.direction = io::Direction::gpio,
                                                                  .gpio_chip = "/dev/gpiochip1",
                                                                  .gpio_line = 23,
                                                                  .active_low = true}));
    EXPECT_EQ(config.bus.echo, EchoMode::automatic);
    EXPECT_EQ(config.realtime.priority, 0);
    EXPECT_EQ(config.realtime.cpu, 1);
    EXPECT_FALSE(config.realtime.lock_memory);
    EXPECT_EQ(config.sysfs, "/tmp/sys");
    EXPECT_EQ(config.control.socket, "/tmp/c.sock");
    EXPECT_EQ(config.control.operator_group, "root");
    ASSERT_EQ(config.lines.size(), 2U);
    EXPECT_EQ(config.lines[0].name, "a");
    EXPECT_EQ(config.lines[0].port, "/dev/null-a");
    EXPECT_EQ(config.lines[0].protocol, "ei-ascii");
    EXPECT_EQ(config.lines[0].port_line, 21U);
    EXPECT_EQ(config.lines[0].baud, 19200U);
    EXPECT_EQ(config.lines[0].format.data_bits, 8);
    EXPECT_EQ(config.lines[0].format.parity, 'N');
    EXPECT_EQ(config.lines[0].format.stop_bits, 2);
    EXPECT_EQ(config.lines[0].timeout, std::chrono::milliseconds{50});
    EXPECT_EQ(config.lines[0].retries, 0);
    const config::StationConfig& station = config.stations.at(0);
    EXPECT_EQ(station.address, 125);
    EXPECT_EQ(station.line, 1U);
    EXPECT_EQ(station.unit, (drive::UnitAddress{3, 15}));
    EXPECT_EQ(station.personality->ident, 0x1649);
    EXPECT_EQ(station.profile->ident, 0x0533) << "the profile itself stays as it is";
    EXPECT_THAT(station.personality->max_tsdr, Each(500_tbit));
    EXPECT_EQ(station.personality->demand_error_base, 1);
    EXPECT_EQ(station.tags->find(56)->name, "LOAD");
    EXPECT_EQ(station.tags->find(55), nullptr);
    EXPECT_EQ(station.tag_file, folder_.path() / "etc/own.csv");
    EXPECT_EQ(station.output_refresh, std::chrono::milliseconds{250});
    EXPECT_EQ(station.zero_after, std::nullopt) << "hold: never to zero";
    ASSERT_EQ(station.leds.size(), 2U);
    EXPECT_EQ(station.leds[0].lamp, "red");
    EXPECT_EQ(station.leds[0].sink, "gpio:23");
    EXPECT_EQ(station.leds[1].sink, "led:dpslaved-green");
}

TEST_F(ConfigFile, output_refresh_0_means_in_every_cycle)
{
    EXPECT_EQ(good(std::string{kGood} + "output_refresh_s = 0\n").stations.at(0).output_refresh.count(), 0);
}

TEST_F(ConfigFile, a_max_tsdr_of_the_bus_leaves_rates_that_the_device_has_not_unsupported)
{
    change_profile("slow", "1500000 = 150", "");
    const Config config =
        good(with(with(kGood, "\"590\"", "\"slow\""), "baud = 187500", "baud = 187500\nmax_tsdr = 400"));

    EXPECT_EQ(config.stations.at(0).personality->max_tsdr[index_of(Baud::k187_5)], 400_tbit);
    EXPECT_EQ(config.stations.at(0).personality->max_tsdr[index_of(Baud::k1500)], 0_tbit);
}

TEST_F(ConfigFile, an_ident_that_the_profile_leaves_open_is_taken_from_the_station)
{
    change_profile("open", "ident = 0x0533", "");
    const std::string text = with(kGood, "\"590\"", "\"open\"");

    EXPECT_THAT(short_forms(bad(text)),
                ElementsAre(AllOf(StartsWith("14:1: 'ident' is missing"),
                                  HasSubstr("\"open\" has none, because no source states it"))));
    EXPECT_EQ(good(text + "ident = 0x1649\n").stations.at(0).personality->ident, 0x1649);
}

TEST_F(ConfigFile, two_stations_may_share_bus_line_profile_and_table)
{
    const Config config = good(std::string{kGood} + with(kSecondStation, "\"620\"", "\"590\""));

    ASSERT_EQ(config.stations.size(), 2U);
    EXPECT_EQ(config.stations[0].profile, config.stations[1].profile);
    EXPECT_EQ(config.stations[0].tags, config.stations[1].tags);
    EXPECT_EQ(config.stations[1].unit, (drive::UnitAddress{0, 1}));
}

TEST_F(ConfigFile, no_rate_above_1500000_is_served)
{
    for (const char* const rate : {"3000000", "6000000", "12000000"})
        EXPECT_THAT(short_forms(bad(with(kGood, "baud = 187500", std::string{"baud = "} + rate))),
                    ElementsAre(HasSubstr("not a supported rate")))
            << rate;
}

TEST_F(ConfigFile, baud_is_auto_or_one_of_the_seven_rates)
{
    EXPECT_EQ(good(with(kGood, "baud = 187500", "baud = \"auto\"")).bus.baud, std::nullopt);
    for (const Baud baud : kBauds) {
        const std::string rate = std::to_string(static_cast<std::uint32_t>(baud));
        EXPECT_EQ(good(with(kGood, "baud = 187500", "baud = " + rate)).bus.baud, baud);
    }
}

TEST_F(ConfigFile, each_direction_but_gpio_needs_no_further_key)
{
    for (const auto& [name, direction] :
         {std::pair{"none", io::Direction::none}, std::pair{"kernel", io::Direction::kernel},
          std::pair{"rts", io::Direction::rts}}) {
        const Config config = good(with(kGood, "\"none\"", '"' + std::string{name} + '"'));
        EXPECT_EQ(config.bus.driver_enable, (io::DriverEnableSettings{.direction = direction}));
        EXPECT_THAT(config.warnings, IsEmpty());
    }
}

TEST_F(ConfigFile, gpio_active_low_turns_rts_round_too)
{
    const Config config = good(with(kGood, "\"none\"", "\"rts\"\ngpio_active_low = true"));

    EXPECT_TRUE(config.bus.driver_enable.active_low);
    EXPECT_THAT(config.warnings, IsEmpty());
}

TEST_F(ConfigFile, keys_of_another_direction_are_a_warning_and_have_no_effect)
{
    const Config config =
        good(with(kGood, "\"none\"",
                  "\"none\"\ngpio_chip = \"/dev/gpiochip0\"\ngpio_line = 17\ngpio_active_low = true"));

    EXPECT_THAT(short_forms(config.warnings),
                ElementsAre(AllOf(StartsWith("5:13: 'gpio_chip' means nothing with direction = \"none\""),
                                  HasSubstr("remove it")),
                            StartsWith("6:13: 'gpio_line' means nothing"),
                            StartsWith("7:19: 'gpio_active_low' means nothing")));
    EXPECT_EQ(config.bus.driver_enable.gpio_chip, "");
    EXPECT_EQ(config.bus.driver_enable.direction, io::Direction::none);
}

TEST_F(ConfigFile, echo_is_off_on_or_found_out)
{
    for (const auto& [name, mode] : {std::pair{"off", EchoMode::off}, std::pair{"on", EchoMode::on},
                                     std::pair{"auto", EchoMode::automatic}})
        EXPECT_EQ(good(with(kGood, "\"none\"", "\"none\"\necho = \"" + std::string{name} + '"')).bus.echo,
                  mode);
}

TEST_F(ConfigFile, says_whether_characters_take_time_on_a_drive_line)
{
    using drive::WireTime;
    EXPECT_EQ(good(kGood).lines.front().wire_time, WireTime::automatic);
    for (const auto& [name, mode] : {std::pair{"auto", WireTime::automatic}, std::pair{"yes", WireTime::yes},
                                     std::pair{"no", WireTime::no}})
        EXPECT_EQ(good(with(kGood, "protocol = \"ei-ascii\"",
                            "protocol = \"ei-ascii\"\nwire_time = \"" + std::string{name} + '"'))
                      .lines.front()
                      .wire_time,
                  mode);
}

TEST_F(ConfigFile, an_echo_that_is_to_be_removed_is_asked_of_the_kernel_too)
{
    const auto receives_own = [&](const std::string& direction, const std::string& echo) {
        return good(with(kGood, "\"none\"", '"' + direction + "\"\necho = \"" + echo + '"'))
            .bus.driver_enable.receive_own;
    };
    EXPECT_TRUE(receives_own("kernel", "on"));
    EXPECT_FALSE(receives_own("kernel", "auto"));
    EXPECT_FALSE(receives_own("kernel", "off"));
    EXPECT_FALSE(receives_own("rts", "on"));
}

TEST_F(ConfigFile, without_direction_chip_and_line_of_the_gpio_are_asked_for_with_how_to_find_them)
{
    EXPECT_THAT(short_forms(bad(with(kGood, "direction = \"none\"\n", ""))),
                ElementsAre(AllOf(StartsWith("1:1: 'gpio_chip' is missing in [bus]: add gpio_chip = "),
                                  HasSubstr("`gpioinfo`"), HasSubstr("direction = \"none\"")),
                            AllOf(StartsWith("1:1: 'gpio_line' is missing in [bus]: add gpio_line = "),
                                  HasSubstr("`gpioinfo`"))));
}

TEST_F(ConfigFile, an_ident_copied_from_a_page_with_its_dots_is_refused_with_what_to_put_there)
{
    EXPECT_THAT(short_forms(bad(with(kGood, "profile = \"590\"", "profile = \"590\"\nident = 0x...."))),
                ElementsAre(HasSubstr("put your Ident_Number here")));
}

class BadConfigFile : public ConfigFile, public testing::WithParamInterface<BadChange> {};

TEST_P(BadConfigFile, is_refused_with_place_and_remedy)
{
    const BadChange& change = GetParam();

    const Faults faults = bad(with(kGood, change.from, change.to));

    ASSERT_EQ(faults.size(), 1U) << (faults.size() > 1 ? to_string(faults[1]) : "");
    EXPECT_THAT(faults[0].file, EndsWith("etc/dpslaved.toml"));
    EXPECT_THAT(test::short_form(faults[0]), AllOf(StartsWith(change.place), HasSubstr(change.sentence)));
}

INSTANTIATE_TEST_SUITE_P(
    bus, BadConfigFile,
    testing::Values(
        BadChange{"port = \"/dev/null-bus\"", "",
                  "1:1: ", "'port' is missing in [bus]: add port = \"/dev/ttyS1\""},
        BadChange{"port = \"/dev/null-bus\"", "port = 1", "2:8: ", "a text in quotes"},
        BadChange{"port = \"/dev/null-bus\"", "port = \"x\"\nprot = \"y\"", "3:1: ", "did you mean 'port'?"},
        BadChange{"baud = 187500", "baud = \"187500\"", "3:8: ", "without quotes"},
        BadChange{"baud = 187500", "baud = \"Auto\"",
                  "3:8: ", "'baud' \"Auto\" is not a rate: write \"auto\""},
        BadChange{"baud = 187500", "baud = \"\"", "3:8: ", "is empty"},
        BadChange{"baud = 187500", "baud = 38400",
                  "3:8: ", "38400 is not a supported rate: write \"auto\", or a rate in bit/s"},
        BadChange{"baud = 187500", "baud = 12000000", "3:8: ", "not a supported rate"},
        BadChange{"baud = 187500", "baud = true", "3:8: ", "not true"},
        BadChange{"direction = \"none\"", "direction = \"gpio\"\ngpio_line = 17",
                  "1:1: ", "'gpio_chip' is missing in [bus]: add gpio_chip = \"/dev/gpiochip0\""},
        BadChange{"direction = \"none\"", "direction = \"gpio\"\ngpio_chip = \"/dev/gpiochip0\"",
                  "1:1: ", "'gpio_line' is missing in [bus]: add gpio_line = 17"},
        BadChange{"direction = \"none\"", "direction = \"gpio\"\ngpio_line = 17\ngpio_chip = \"\"",
                  "6:13: ", "is empty"},
        BadChange{"direction = \"none\"", "gpio_chip = \"/dev/gpiochip0\"\ngpio_line = -1",
                  "5:13: ", "from 0 to 65535"},
        BadChange{"direction = \"none\"", "direction = \"none\"\ngpio_active_low = 1",
                  "5:19: ", "true or false"},
        BadChange{"direction = \"none\"", "direction = \"nome\"", "4:13: ", "Did you mean \"none\"?"},
        BadChange{"direction = \"none\"", "direction = \"none\"\necho = true",
                  "5:8: ", "must be \"off\", \"on\" or \"auto\", not true"},
        BadChange{"direction = \"none\"", "direction = \"none\"\necho = \"onn\"",
                  "5:8: ", "Did you mean \"on\"?"},
        BadChange{"direction = \"none\"", "direction = \"none\"\nmax_tsdr = 10",
                  "5:12: ", "set 0 for the profile's value"},
        BadChange{"direction = \"none\"", "direction = \"none\"\nmax_tsdr = -1", "5:12: ", "from 0 to 65535"},
        BadChange{"[bus]", "leds = 1\n[bus]", "1:8: ", "a table"}));

INSTANTIATE_TEST_SUITE_P(
    machine, BadConfigFile,
    testing::Values(
        BadChange{"[control]", "[realtime]\npriority = 100\n[control]", "7:12: ", "from 0 to 99"},
        BadChange{"[control]", "[realtime]\ncpu = -2\n[control]", "7:7: ", "from -1 to 1023"},
        BadChange{"[control]", "[realtime]\nlock_memory = 1\n[control]", "7:15: ", "true or false"},
        BadChange{"[control]", "[realtime]\nprio = 1\n[control]",
                  "7:1: ", "unknown key 'prio' in [realtime]"},
        BadChange{"[control]", "[trace]\nbus_kib = -1\n[control]", "7:11: ", "from 0 to 1048576"},
        BadChange{"[control]", "[trace]\ndrive_kib = 1048577\n[control]", "7:13: ", "from 0 to 1048576"},
        BadChange{"[control]", "[leds]\nsysfs = \"\"\n[control]", "7:9: ", "is empty"},
        BadChange{"[control]", "[contorl]\na = 1\n[control]", "6:2: ", "did you mean 'control'?"},
        BadChange{"[control]",
                  "[control]\nsocket = \"/tmp/"
                  "012345678901234567890123456789012345678901234567890123456789012345678901234567"
                  "8901234567890123456789"
                  "012345\"",
                  "7:10: ", "longer than the 107 octets"}));

INSTANTIATE_TEST_SUITE_P(samples, BadConfigFile,
                         testing::Values(BadChange{"[control]", "[trace]\nsamples_kib = 4097\n[control]",
                                                   "7:15: ", "from 0 to 4096"}));

INSTANTIATE_TEST_SUITE_P(
    line, BadConfigFile,
    testing::Values(
        BadChange{"port = \"/dev/null-p3\"", "", "9:1: ", "'port' is missing in [[line]]"},
        BadChange{"port = \"/dev/null-p3\"", "port = \"/dev/null-bus\"",
                  "11:8: ", "is that of the bus on line 2"},
        BadChange{"port = \"/dev/null-p3\"", "port = \"/dev/../dev/null-bus\"",
                  "11:8: ", "is that of the bus"},
        BadChange{"protocol = \"ei-ascii\"", "", "9:1: ", "'protocol' is missing"},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-asci\"",
                  "12:12: ", "Did you mean \"ei-ascii\"?"},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nbaud = 0",
                  "13:8: ", "from 300 to 921600"},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nformat = \"9E1\"",
                  "13:10: ", "as in \"7E1\""},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nformat = \"7E\"",
                  "13:10: ", "format \"7E\""},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\ntimeout_ms = 0",
                  "13:14: ", "from 10 to 10000"},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nsettle_ms = -1",
                  "13:13: ", "from 0 to 600000"},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nsettle_ms = 199",
                  "13:13: ", "shorter than timeout_ms (200)"},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nsettle_ms = 400\ntimeout_ms = 500",
                  "13:13: ", "or 0 for ten timeouts"},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nretries = -1",
                  "13:11: ", "from 0 to 10"},
        BadChange{"protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nretires = 1",
                  "13:1: ", "did you mean 'retries'?"},
        BadChange{"[[station]]",
                  "[[line]]\nname = \"p3\"\nport = \"/dev/null-q\"\nprotocol = \"ei-ascii\"\n[[station]]",
                  "15:8: ", "line name \"p3\" is already on line 10"},
        BadChange{"[[station]]",
                  "[[line]]\nname = \"q\"\nport = \"/dev/null-p3\"\nprotocol = \"ei-ascii\"\n[[station]]",
                  "16:8: ", "port \"/dev/null-p3\" is already on line 11"}));

INSTANTIATE_TEST_SUITE_P(
    station, BadConfigFile,
    testing::Values(
        BadChange{"name = \"unwinder\"", "", "14:1: ", "'name' is missing in [[station]]"},
        BadChange{"address = 5", "", "14:1: ", "'address' is missing in [[station]]"},
        BadChange{"address = 5", "address = 126", "16:11: ", "choose one from 0 to 125"},
        BadChange{"address = 5", "address = 127", "16:11: ", "telegrams to all stations"},
        BadChange{"address = 5", "address = 128", "16:11: ", "from 0 to 127"},
        BadChange{"address = 5\nprofile = \"590\"", "address = 0\nprofile = \"620\"",
                  "16:11: ", "choose one from 1 to 125"},
        BadChange{"profile = \"590\"", "", "14:1: ", "'profile' is missing"},
        BadChange{"profile = \"590\"", "profile = \"591\"", "17:11: ", "\"584s\", \"584sv\", \"590\""},
        BadChange{"profile = \"590\"", "profile = \"../profiles/590\"", "17:11: ", "there is no profile"},
        BadChange{"line = \"p3\"", "", "14:1: ", "add line = \"p3\""},
        BadChange{"line = \"p3\"", "line = \"p4\"", "18:8: ", "there is no line \"p4\": write \"p3\""},
        BadChange{"unit = \"00\"", "", "14:1: ", "'unit' is missing"},
        BadChange{"unit = \"00\"", "unit = 0", "19:8: ", "a text in quotes"},
        BadChange{"unit = \"00\"", "unit = \"0\"", "19:8: ", "two hexadecimal digits"},
        BadChange{"unit = \"00\"", "unit = \"0G\"", "19:8: ", "two hexadecimal digits"},
        BadChange{"unit = \"00\"", "unit = \"000\"", "19:8: ", "two hexadecimal digits"},
        BadChange{"unit = \"00\"", "unit = \"00\"\nident = 0", "20:9: ", "from 1 to 65535"},
        BadChange{"unit = \"00\"", "unit = \"00\"\noutput_refresh_s = -1", "20:20: ", "from 0 to 86400"},
        BadChange{"unit = \"00\"", "unit = \"00\"\noutput_loss = \"keep\"",
                  "20:15: ", "\"zero\" or \"hold\""},
        BadChange{"unit = \"00\"", "unit = \"00\"\nresolution = \"full\"", "20:14: ", "remove 'resolution'"},
        BadChange{"unit = \"00\"", "unit = \"00\"\next_diag_bit = true", "20:16: ", "no extended diagnosis"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.tec]\ntype = 2",
                  "20:1: ", "no TEC OPTION function block"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.diagnosis]\nstatus_tag = 75",
                  "20:1: ", "remove [station.diagnosis]"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.demand]\nerror_base = 2",
                  "21:14: ", "from 0 to 1"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.demand]\nextended_reply = \"table\"",
                  "21:18: ", "no extended commands"},
        BadChange{"unit = \"00\"", "unit = \"00\"\ndisplay_decimals = 1", "20:20: ", "no tag of"},
        BadChange{"unit = \"00\"", "unit = \"00\"\nadress = 5", "20:1: ", "did you mean 'address'?"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.leds]\nblue = \"gpio:1\"",
                  "21:1: ", "known here are red, green"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.leds]\nred = \"gpio:x\"",
                  "21:7: ", "gpio:LABEL:OFFSET"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.leds]\nred = \"gpio:\"",
                  "21:7: ", "gpio:LABEL:OFFSET"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.leds]\nred = \"led:a/b\"",
                  "21:7: ", "name of a folder"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.leds]\nred = \"line:/dev/gpiochip0\"",
                  "21:7: ", "line:CHIP:LINE"},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.leds]\nred = \"23\"", "21:7: ", "\"led:NAME\""},
        BadChange{"unit = \"00\"", "unit = \"00\"\n[station.leds]\nred = \"gpio:1\"\ngreen = \"gpio:1\"",
                  "22:9: ", "sink \"gpio:1\" is already on line 21"}));

TEST_F(ConfigFile, a_lamp_may_be_a_line_of_a_GPIO_chip_but_not_that_of_the_driver_enable)
{
    const std::string lamp =
        with(kGood, "unit = \"00\"", "unit = \"00\"\n[station.leds]\nred = \"line:/dev/gpiochip0:24\"");
    const auto by_gpio = [&](const std::string& number) {
        return with(lamp, "direction = \"none\"",
                    "direction = \"gpio\"\ngpio_chip = \"/dev/gpiochip0\"\ngpio_line = " + number);
    };

    EXPECT_EQ(good(lamp).stations[0].leds[0].sink, "line:/dev/gpiochip0:24");
    EXPECT_EQ(good(by_gpio("23")).stations[0].leds.size(), 1U);
    EXPECT_THAT(short_forms(bad(by_gpio("24"))), ElementsAre(HasSubstr("switches the transceiver")));
}

TEST_F(ConfigFile, two_stations_with_one_address_are_a_fault_that_names_both_lines)
{
    const Faults faults = bad(std::string{kGood} + with(kSecondStation, "address = 6", "address = 5"));

    EXPECT_THAT(short_forms(faults), ElementsAre(AllOf(StartsWith("23:11: address 5 is already on line 16"),
                                                       HasSubstr("an address of its own"))));
}

TEST_F(ConfigFile, two_stations_with_one_name_or_one_drive_are_faults)
{
    const std::string text = with(with(kSecondStation, "\"winder\"", "\"unwinder\""), "\"01\"", "\"00\"");

    EXPECT_THAT(short_forms(bad(kGood + text)),
                ElementsAre(StartsWith("22:8: station name \"unwinder\" is already on line 15"),
                            AllOf(StartsWith("26:8: unit \"00\" of drive line \"p3\" is already on line 19"),
                                  HasSubstr("one drive serves one station only"))));
}

TEST_F(ConfigFile, two_names_of_one_tty_are_one_port)
{
    const auto tty = folder_.write("tty", "");
    std::filesystem::create_symlink(tty, folder_.path() / "by-id");
    const std::string text =
        with(with(kGood, "/dev/null-bus", tty.string()), "/dev/null-p3", (folder_.path() / "by-id").string());

    EXPECT_THAT(short_forms(bad(text)),
                ElementsAre(AllOf(StartsWith("11:8: "), HasSubstr("is that of the bus on line 2"))));
}

TEST_F(ConfigFile, a_file_without_any_station_says_what_to_add)
{
    const std::string text{kGood};

    EXPECT_THAT(short_forms(bad(text.substr(0, text.find("[[station]]")))),
                ElementsAre(AllOf(StartsWith("0:0: there is no station: add"),
                                  HasSubstr("name, address, profile, line and unit"),
                                  HasSubstr("To only listen on the bus: write listen = true"))));
}

TEST_F(ConfigFile, that_only_listens_has_no_station_and_needs_no_direction)
{
    const config::Config config = good("[bus]\nport = \"/dev/null-bus\"\nlisten = true\n");

    EXPECT_TRUE(config.bus.listen);
    EXPECT_TRUE(config.stations.empty());
    EXPECT_EQ(config.bus.baud, std::nullopt);
    EXPECT_EQ(config.bus.driver_enable.direction, io::Direction::none);
    EXPECT_FALSE(good(kGood).bus.listen);
}

TEST_F(ConfigFile, that_only_listens_keeps_the_driver_enable_inactive_that_it_names)
{
    const std::string text = "[bus]\nport = \"/dev/null-bus\"\nlisten = true\ngpio_line = 17\n";

    EXPECT_THAT(short_forms(bad(text)), ElementsAre(HasSubstr("'gpio_chip' is missing in [bus]")));
    const config::Config config = good(text + "gpio_chip = \"/dev/gpiochip0\"\n");
    EXPECT_EQ(config.bus.driver_enable.direction, io::Direction::gpio);
    EXPECT_EQ(config.bus.driver_enable.gpio_line, 17U);
}

TEST_F(ConfigFile, that_only_listens_with_a_station_or_a_line_is_a_fault_that_names_both_places)
{
    EXPECT_THAT(short_forms(bad(with(kGood, "direction = \"none\"", "listen = true"))),
                ElementsAre(AllOf(StartsWith("9:1: [[line]] is not allowed with listen = true on line 4"),
                                  HasSubstr("Remove each [[line]] and [[station]], or remove 'listen'")),
                            StartsWith("14:1: [[station]] is not allowed with listen = true on line 4")));
}

TEST_F(ConfigFile, that_only_listens_has_no_use_for_keys_about_answers)
{
    const config::Config config =
        good("[bus]\nport = \"/dev/null-bus\"\nlisten = true\nmax_tsdr = 2000\necho = \"on\"\n");

    EXPECT_THAT(short_forms(config.warnings),
                ElementsAre(StartsWith("4:12: 'max_tsdr' means nothing with listen = true"),
                            StartsWith("5:8: 'echo' means nothing with listen = true")));
    EXPECT_EQ(config.bus.echo, EchoMode::off);
    EXPECT_EQ(config.bus.max_tsdr, 0U);
}

TEST_F(ConfigFile, a_line_with_single_brackets_is_a_fault)
{
    EXPECT_THAT(short_forms(bad(with(kGood, "[[line]]", "[line]"))),
                ElementsAre(AllOf(StartsWith("9:1: "), HasSubstr("double brackets")),
                            StartsWith("18:8: there is no line")));
}

TEST_F(ConfigFile, an_empty_file_says_that_bus_and_station_are_missing)
{
    EXPECT_THAT(short_forms(bad("")),
                ElementsAre(HasSubstr("'bus' is missing in the file"), HasSubstr("there is no station")));
}

TEST_F(ConfigFile, what_is_no_toml_is_reported_with_its_place)
{
    EXPECT_THAT(short_forms(bad("[bus\nport = 1\n")),
                ElementsAre(AllOf(StartsWith("1:5: "), HasSubstr("not TOML"))));
}

TEST_F(ConfigFile, that_is_not_there_is_a_fault)
{
    const auto config = load_config(folder_.path() / "absent.toml", folder_.path() / "profiles");

    ASSERT_FALSE(config);
    EXPECT_THAT(to_string(config.error().at(0)),
                EndsWith("absent.toml: the file cannot be read: No such file or directory."));
}

TEST_F(ConfigFile, a_profile_folder_that_is_not_there_is_named)
{
    const auto file = folder_.write("etc/dpslaved.toml", kGood);
    const auto config = load_config(file, folder_.path() / "elsewhere");

    ASSERT_FALSE(config);
    EXPECT_THAT(short_forms(config.error()),
                ElementsAre(AllOf(StartsWith("17:11: "), HasSubstr("elsewhere"), HasSubstr("--profiles"))));
}

TEST_F(ConfigFile, a_rate_that_the_device_has_not_is_a_fault)
{
    change_profile("slow", "1500000 = 150", "");
    const std::string text = with(with(kGood, "\"590\"", "\"slow\""), "187500", "1500000");

    EXPECT_THAT(short_forms(bad(text)),
                ElementsAre(AllOf(StartsWith("17:11: "),
                                  HasSubstr("does not support the rate of the bus, 1500000 bit/s"))));
}

TEST_F(ConfigFile, a_protocol_that_the_device_has_not_is_a_fault)
{
    change_profile("modern", "[\"ei-ascii\"]", "[\"modbus-rtu\"]");

    EXPECT_THAT(short_forms(bad(with(kGood, "\"590\"", "\"modern\""))),
                ElementsAre(AllOf(StartsWith("18:8: "), HasSubstr("is reached by \"modbus-rtu\""))));
}

TEST_F(ConfigFile, an_error_base_without_demand_data_is_a_fault)
{
    const std::string none = with(test::content_of(kSource / "config/profiles/590.toml"),
                                  "form       = \"basic\"", "form = \"none\"");
    folder_.write("profiles/plain.toml", with(with(none, "identifier = 0x73", ""), "error_base = 0", ""));

    EXPECT_THAT(short_forms(bad(with(kGood, "\"590\"", "\"plain\"") + "[station.demand]\nerror_base = 1\n")),
                ElementsAre(AllOf(StartsWith("21:14: "), HasSubstr("has no Demand Data"))));
}

TEST_F(ConfigFile, all_faults_of_configuration_profiles_and_tables_are_reported_in_one_run)
{
    change_profile("broken", "ident = 0x0533", "ident = \"x\"");
    folder_.write("tags/empty.csv", "tag\nx\n");
    folder_.write("etc/own.csv", "tag\n1\n70000\n");
    std::string text = with(with(kGood, "baud = 187500", "baud = \"atuo\""), "direction", "directoin");
    text = with(with(text, "\"590\"", "\"broken\""), "unit = \"00\"", "unit = \"xx\"\ntags = \"own.csv\"");

    const Faults faults = bad(text + with(kSecondStation, "address = 6", "address = 5"));

    std::vector<std::string> seen;
    for (const auto& fault : faults)
        seen.push_back(std::filesystem::path{fault.file}.filename().string() + ":" + test::short_form(fault));
    EXPECT_THAT(
        seen,
        ElementsAre(AllOf(StartsWith("dpslaved.toml:1:1: "), HasSubstr("'gpio_chip' is missing")),
                    AllOf(StartsWith("dpslaved.toml:1:1: "), HasSubstr("'gpio_line' is missing")),
                    AllOf(StartsWith("dpslaved.toml:3:8: "), HasSubstr("\"auto\"")),
                    AllOf(StartsWith("dpslaved.toml:4:1: "), HasSubstr("did you mean 'direction'?")),
                    AllOf(StartsWith("dpslaved.toml:19:8: "), HasSubstr("two hexadecimal digits")),
                    AllOf(StartsWith("dpslaved.toml:24:11: "), HasSubstr("address 5 is already on line 16")),
                    AllOf(StartsWith("broken.toml:"), HasSubstr("'ident' must be a whole number")),
                    StartsWith("empty.csv:2:1: "), StartsWith("own.csv:3:1: ")));
}

/// A station with a table of its own.
std::string station_with(const char* name, const char* address, const char* unit, const char* table)
{
    return std::string{"\n[[station]]\nname = \""} + name + "\"\naddress = " + address +
           "\nprofile = \"590\"\nline = \"p3\"\nunit = \"" + unit + "\"\ntags = \"" + table + "\"\n";
}

TEST_F(ConfigFile, tag_tables_that_take_too_long_to_read_together_are_refused_once)
{
    const std::string large = "tag,name\n1,SPEED\n" + std::string(900 * 1024, '\n');
    for (const char* const name : {"a.csv", "b.csv", "c.csv", "d.csv"})
        folder_.write(std::string{"etc/"} + name, large);
    const std::string two =
        kGood + station_with("a", "6", "01", "a.csv") + station_with("b", "7", "02", "b.csv");

    EXPECT_EQ(good(two + station_with("c", "8", "03", "a.csv")).stations.size(), 4U)
        << "one table of two stations";
    EXPECT_THAT(
        short_forms(bad(two + station_with("c", "8", "03", "c.csv") + station_with("d", "9", "04", "d.csv"))),
        ElementsAre(HasSubstr("more than 2 MiB together")));
}

TEST_F(ConfigFile, a_table_that_is_too_large_by_itself_is_not_blamed_on_the_others)
{
    folder_.write("etc/a.csv", std::string(3 * 1024 * 1024, '\n'));
    folder_.write("etc/b.csv", "tag,name\n1,SPEED\n");

    EXPECT_THAT(short_forms(bad(kGood + station_with("a", "6", "01", "a.csv") +
                                station_with("b", "7", "02", "b.csv"))),
                ElementsAre(HasSubstr("larger than 1 MiB")));
}

TEST_F(ConfigFile, a_table_of_two_profiles_reports_its_faults_once)
{
    folder_.write("tags/empty.csv", "tag\nx\n");

    EXPECT_THAT(short_forms(bad(std::string{kGood} + kSecondStation)), ElementsAre(StartsWith("2:1: ")));
}

class ConfigWarning : public ConfigFile {
protected:
    /// What the profile 590 says of its mnemonics.
    const std::string kRule = R"(mnemonic_rule = "590plus")";
    void take_profile_as_shipped(const std::string& name)
    {
        folder_.write("profiles/" + name + ".toml",
                      test::content_of(kSource / "config/profiles" / (name + ".toml")));
    }
};

TEST_F(ConfigWarning, a_mnemonic_rule_that_is_assumed_is_named_with_its_source_for_each_station)
{
    for (const char* const name : {"584s", "590", "620"}) {
        take_profile_as_shipped(name);
        EXPECT_THAT(short_forms(good(with(kGood, "\"590\"", '"' + std::string{name} + '"')).warnings),
                    ElementsAre(AllOf(StartsWith("14:1: the mnemonic rule of profile"),
                                      HasSubstr("is assumed (590+ formula; no source for the"),
                                      HasSubstr("station \"unwinder\""))));
    }
}

TEST_F(ConfigWarning, a_mnemonic_rule_without_a_source_is_assumed)
{
    change_profile("plain", R"(mnemonic_source  = "590+ formula; no source for the 590"
mnemonic_assumed = false)",
                   "");

    EXPECT_THAT(short_forms(good(with(kGood, "\"590\"", "\"plain\"")).warnings),
                ElementsAre(HasSubstr("the mnemonic rule of profile \"plain\" is assumed: if the drive")));
}

TEST_F(ConfigWarning, an_assumed_rule_that_no_row_of_the_table_needs_is_not_warned_of)
{
    take_profile_as_shipped("590");
    folder_.write("tags/empty.csv", "tag,type,decimals,mnemonic\n1,INT,0,aa\n3,STRING,,\n");

    EXPECT_THAT(good(kGood).warnings, IsEmpty());
}

TEST_F(ConfigWarning, an_operator_group_that_the_system_has_not_leaves_root_alone)
{
    const Config config = good(with(kGood, "\"root\"", "\"no-such-group-here\""));

    EXPECT_EQ(config::operator_group_of(config.control), std::nullopt);
    EXPECT_THAT(
        short_forms({config::without_operator_group(config)}),
        ElementsAre(AllOf(StartsWith("7:18: "), HasSubstr("\"no-such-group-here\": only root may operate"))));
}

TEST_F(ConfigWarning, addresses_0_to_2_are_usually_those_of_masters)
{
    for (const char* address : {"address = 0", "address = 1", "address = 2"})
        EXPECT_THAT(short_forms(good(with(kGood, "address = 5", address)).warnings),
                    ElementsAre(AllOf(StartsWith("16:11: "), HasSubstr(address + 10), HasSubstr("masters"))));
    EXPECT_THAT(good(with(kGood, "address = 5", "address = 3")).warnings, IsEmpty());
}

TEST_F(ConfigWarning, a_620_is_recommended_9600_and_performs_worse_with_other_rates)
{
    const std::string at_9600 = with(kGood, "\"590\"", "\"620\"");

    EXPECT_THAT(good(at_9600).warnings, IsEmpty());
    EXPECT_THAT(
        short_forms(
            good(with(at_9600, "protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nbaud = 19200")).warnings),
        ElementsAre(AllOf(HasSubstr("runs at 19200 bit/s"), HasSubstr("9600 is recommended"))));
}

TEST_F(ConfigWarning, a_max_tsdr_above_1000_is_more_than_many_masters_wait)
{
    EXPECT_THAT(short_forms(good(with(kGood, "baud = 187500", "baud = 187500\nmax_tsdr = 1001")).warnings),
                ElementsAre(AllOf(StartsWith("4:12: "), HasSubstr("above 1000 bit times"))));
    EXPECT_THAT(good(with(kGood, "baud = 187500", "baud = 187500\nmax_tsdr = 1000")).warnings, IsEmpty());
}

TEST_F(ConfigWarning, tags_without_mnemonic_are_named_once_a_table)
{
    change_profile("plain", kRule, R"(mnemonic_rule = "none")");
    folder_.write("tags/empty.csv",
                  "tag,type,decimals,mnemonic\n1,INT,0,aa\n2,INT,0,\n3,STRING,,\n4,WORD,,\n");
    const std::string second = with(kSecondStation, "\"620\"", "\"plain\"");

    const Config config = good(with(kGood, "\"590\"", "\"plain\"") + second);

    ASSERT_EQ(config.warnings.size(), 1U);
    EXPECT_THAT(config.warnings[0].file, EndsWith("tags/empty.csv"));
    EXPECT_THAT(config.warnings[0].what, StartsWith("no mnemonic for tags 2, 4: they read as invalid tag"));
}

TEST_F(ConfigWarning, of_many_tags_without_mnemonic_the_first_sixteen_are_named)
{
    change_profile("plain", kRule, R"(mnemonic_rule = "none")");
    std::string table = "tag,decimals\n";
    for (int tag = 1; tag <= 19; ++tag) table += std::to_string(tag) + ",0\n";
    folder_.write("tags/empty.csv", table);

    EXPECT_THAT(short_forms(good(with(kGood, "\"590\"", "\"plain\"")).warnings),
                ElementsAre(HasSubstr("15, 16 and 3 more")));
}

TEST_F(ConfigWarning, numbers_without_decimals_are_named_once_a_table)
{
    folder_.write("tags/empty.csv", "tag,type,decimals\n1,INT,\n2,,\n3,WORD,\n4,REAL,0\n");

    const Config config = good(std::string{kGood} + kSecondStation);

    ASSERT_EQ(config.warnings.size(), 1U);
    EXPECT_THAT(config.warnings[0].file, EndsWith("tags/empty.csv"));
    EXPECT_THAT(config.warnings[0].what, StartsWith("tags 1, 2 are numbers without decimals"));
}

TEST_F(ConfigWarning, of_the_650v_sixteen_numbers_without_decimals_are_named)
{
    const Config config = good(std::string{kGood} + "tags = \"../tags/650v.csv\"\n");

    EXPECT_THAT(
        short_forms(config.warnings),
        Contains(HasSubstr("tags 64, 66, 67, 83, 84, 124, 247, 251, 258, 259, 265, 269, 299, 1158, 1159, "
                           "1160 are numbers without decimals")));
}

TEST_F(ConfigWarning, rows_that_wait_for_confirmation_are_named)
{
    folder_.write("tags/empty.csv",
                  "tag,type,decimals,confirmed\n1,INT,1,no\n2,INT,1,yes\n3,INT,1,\n4,WORD,,no\n");

    EXPECT_THAT(short_forms(good(kGood).warnings),
                ElementsAre(AllOf(HasSubstr("tags 1, 4 wait for confirmation"),
                                  HasSubstr("the scale is not known"))));
    change_profile("modern", "[\"ei-ascii\"]", "[\"modbus-rtu\"]");
    const std::string modbus =
        with(with(kGood, "\"590\"", "\"modern\""), "protocol = \"ei-ascii\"", "protocol = \"modbus-rtu\"");
    EXPECT_THAT(
        short_forms(good(with(modbus, "unit = \"00\"", "unit = \"1\"")).warnings),
        ElementsAre(AllOf(HasSubstr("tags 1, 4 wait for confirmation"), HasSubstr("in hexadecimal"))));
}

TEST_F(ConfigWarning, a_station_without_a_tag_table_is_named)
{
    folder_.write("tags/empty.csv", "tag\n");

    EXPECT_THAT(short_forms(good(kGood).warnings),
                ElementsAre(AllOf(HasSubstr("station \"unwinder\" has no tag table"),
                                  HasSubstr("data exchange does not start"))));
    EXPECT_THAT(short_forms(good(std::string{kGood} + "unlisted_decimals = 2\n").warnings),
                ElementsAre(HasSubstr("taken with 2 decimals")));
}

TEST_F(ConfigFile, what_becomes_of_denied_tags_is_that_of_the_profile_unless_the_station_says_it)
{
    using drive::DeniedHold;
    for (const char* const name : {"584s", "590", "620"}) {
        const std::string text = with(kGood, "\"590\"", '"' + std::string{name} + '"');
        EXPECT_EQ(good(text).stations[0].denied_holds, DeniedHold::where_one) << name;
        EXPECT_EQ(good(text + "denied_tags = \"zero\"\n").stations[0].denied_holds, DeniedHold::where_all);
        EXPECT_TRUE(good(text).stations[0].personality->tries_outputs);
    }
    for (const char* const name : {"2408f", "2404f"}) {
        std::string text = with(kGood, "\"590\"", '"' + std::string{name} + "\"\nident = 0x2400");
        text = with(with(text, "\"ei-ascii\"", "\"modbus-rtu\""), "unit = \"00\"", "unit = \"1\"");
        EXPECT_EQ(good(text).stations[0].denied_holds, DeniedHold::where_all) << name;
        EXPECT_EQ(good(text + "denied_tags = \"refuse\"\n").stations[0].denied_holds, DeniedHold::where_one);
        EXPECT_TRUE(good(text).stations[0].personality->tries_outputs);
    }
}

TEST_F(ConfigFile, a_technology_box_takes_denied_tags_zero_only)
{
    const std::string box = with(kGood, "\"590\"", "\"605\"");

    EXPECT_EQ(good(box).stations[0].denied_holds, drive::DeniedHold::never);
    EXPECT_EQ(good(box + "denied_tags = \"zero\"\n").stations[0].denied_holds, drive::DeniedHold::never);
    EXPECT_THAT(short_forms(bad(box + "denied_tags = \"refuse\"\n")),
                ElementsAre(StartsWith("20:15: a technology box (profile \"605\") exchanges data also")));
}

TEST_F(ConfigFile, what_becomes_of_tags_without_a_scale_is_read)
{
    const Config plain = good(kGood);
    EXPECT_EQ(plain.stations[0].unlisted_decimals, std::nullopt);
    EXPECT_TRUE(plain.stations[0].unscaled_holds);
    const Config zero = good(std::string{kGood} + "unlisted_decimals = 0\nunscaled_tags = \"zero\"\n");
    EXPECT_EQ(zero.stations[0].unlisted_decimals, 0);
    EXPECT_FALSE(zero.stations[0].unscaled_holds);
    EXPECT_THAT(short_forms(bad(std::string{kGood} + "unlisted_decimals = 5\n")),
                ElementsAre(HasSubstr("from 0 to 4")));
    EXPECT_THAT(short_forms(bad(std::string{kGood} + "unscaled_tags = \"hold\"\n")),
                ElementsAre(HasSubstr("\"refuse\"")));
}

TEST_F(ConfigFile, a_mnemonic_of_the_table_that_the_rule_gives_to_another_tag_is_refused)
{
    folder_.write("tags/empty.csv", "tag,type,mnemonic\n536,WORD,\n9,WORD,ow\n");

    EXPECT_THAT(short_forms(bad(kGood)),
                ElementsAre(AllOf(HasSubstr("tags 9 and 536"), HasSubstr("\"ow\""))));
}

TEST_F(ConfigFile, a_station_name_that_is_a_number_is_refused)
{
    for (const char* name : {"\"5\"", "\"0x1F\"", "\"-12\"", "\"1.5\""})
        EXPECT_THAT(short_forms(bad(with(kGood, "\"unwinder\"", name))),
                    ElementsAre(AllOf(StartsWith("15:8: "), HasSubstr("is a number"))))
            << name;
    EXPECT_EQ(good(with(kGood, "\"unwinder\"", "\"winder-5\"")).stations[0].name, "winder-5");
}

TEST_F(ConfigFile, a_station_name_has_letters_digits_and_three_signs_and_begins_with_no_minus)
{
    const std::string longest(32, 'x');
    for (const std::string& name : {std::string{" "}, std::string{"winder 5"}, std::string{"-h"},
                                    std::string{"a/b"}, std::string{"a=b"}, std::string{"a\u00A0b"},
                                    std::string{"a\u2003b"}, std::string{"a\u00D7"}, longest + "x"})
        EXPECT_THAT(short_forms(bad(with(kGood, "\"unwinder\"", "\"" + name + "\""))),
                    ElementsAre(AllOf(StartsWith("15:8: "),
                                      HasSubstr("letters, digits, '_', '-' and '.', 32 at most"))))
            << name;
    for (const std::string& name :
         {longest, std::string{"Abwickler_\u00FC.1"}, std::string{"\u0440\u043E\u043B\u0438\u043A"},
          std::string{"\u5DFB\u53D6"}})
        EXPECT_EQ(good(with(kGood, "\"unwinder\"", "\"" + name + "\"")).stations[0].name, name);
}

TEST_F(ConfigFile, a_control_character_in_a_name_is_refused)
{
    for (const char* name : {"\"a\\u001bb\"", "\"a\\u009bb\"", "\"a\\tb\""})
        EXPECT_THAT(short_forms(bad(with(kGood, "\"unwinder\"", name))),
                    ElementsAre(AllOf(StartsWith("15:8: "), HasSubstr("control character"))))
            << name;
    EXPECT_EQ(good(with(kGood, "\"unwinder\"", "\"Abwickler-\u00fc\"")).stations[0].name, "Abwickler-\u00fc");
}

/// A machine whose chip of 32 lines begins at 512 in sysfs.
class LampNames : public ConfigFile {
protected:
    LampNames()
    {
        folder_.write("sys/class/gpio/gpiochip512/base", "512\n");
        folder_.write("sys/class/gpio/gpiochip512/ngpio", "32\n");
        folder_.write("sys/class/gpio/gpiochip512/label", "lamps\n");
        folder_.write("sys/class/gpio/gpiochip512/device/gpiochip3/dev", "254:3\n");
    }
    std::string lamps(const std::string& red, const std::string& green) const
    {
        return std::string{kGood} + "[station.leds]\nred = \"" + red + "\"\ngreen = \"" + green +
               "\"\n[leds]\nsysfs = \"" + (folder_.path() / "sys").string() + "\"\n";
    }
};

TEST_F(LampNames, two_names_of_one_lamp_are_refused)
{
    for (const char* other : {"gpio:523", "gpio:0523", "gpio:lamps:11", "line:/dev/gpiochip3:11",
                              "line:gpiochip3:11", "line:lamps:11", "line:/dev/../dev/gpiochip3:11"})
        EXPECT_THAT(short_forms(bad(lamps("line:/dev/gpiochip3:11", other))),
                    ElementsAre(HasSubstr("is already on line 21")))
            << other;
    EXPECT_TRUE(load(lamps("line:/dev/gpiochip3:11", "gpio:524")));
    EXPECT_TRUE(load(lamps("line:/dev/gpiochip3:11", "line:/dev/gpiochip4:11")));
    EXPECT_THAT(short_forms(bad(lamps("led:x", "led:x"))), ElementsAre(HasSubstr("is already on line 21")));
}

class ShippedSample : public ConfigFile {
protected:
    const std::string sample_ = test::content_of(kSource / "config/dpslaved.toml");

    /// Settings that are switched off begin with # and no blank.
    static std::string switched_on(const std::string& text)
    {
        std::string out;
        std::istringstream lines{text};
        for (std::string line; std::getline(lines, line);) {
            const bool off = line.size() > 1 && line[0] == '#' && line[1] != ' ';
            out += (off ? line.substr(1) : line) + '\n';
        }
        return out;
    }
};

TEST_F(ShippedSample, as_it_is_asks_for_bus_and_station_and_has_no_other_fault)
{
    EXPECT_THAT(short_forms(bad(sample_)),
                ElementsAre(HasSubstr("'bus' is missing in the file"), HasSubstr("there is no station")));
}

TEST_F(ShippedSample, switched_on_is_a_good_configuration_with_the_shipped_profiles)
{
    const auto file = folder_.write("etc/dpslaved.toml", switched_on(sample_));
    const auto config = load_config(file, kSource / "config/profiles");

    ASSERT_TRUE(config) << to_string(config.error().at(0));
    EXPECT_EQ(config->bus.port, "/dev/ttyS1");
    ASSERT_EQ(config->lines.size(), 2U);
    ASSERT_EQ(config->stations.size(), 3U) << "one of each kind of device";
    EXPECT_EQ(config->stations[0].name, "unwinder");
    EXPECT_EQ(config->stations[0].leds.size(), 2U);
    EXPECT_TRUE(config->stations[1].tec);
    EXPECT_EQ(config->stations[1].leds.size(), 4U);
    EXPECT_EQ(config->stations[2].profile->diagnosis, profile::DiagForm::status_word);
    EXPECT_EQ(config->stations[2].leds.size(), 1U);
}

TEST_F(ShippedSample, shows_every_key_with_its_default)
{
    // The same file with every optional setting left out must mean the same.
    const Config shown = good(switched_on(sample_));
    const Config left_out = good(with(kGood, "[control]\noperator_group = \"root\"\n", ""));

    const Config left_out_bus = good(with(with(kGood, "baud = 187500\n", ""), "direction = \"none\"\n",
                                          "gpio_chip = \"/dev/gpiochip0\"\ngpio_line = 17\n"));
    EXPECT_EQ(shown.bus.baud, left_out_bus.bus.baud);
    EXPECT_EQ(shown.bus.driver_enable, left_out_bus.bus.driver_enable);
    EXPECT_EQ(shown.bus.echo, left_out_bus.bus.echo);
    EXPECT_EQ(shown.bus.max_tsdr, left_out.bus.max_tsdr);
    EXPECT_EQ(shown.realtime.priority, left_out.realtime.priority);
    EXPECT_EQ(shown.realtime.cpu, left_out.realtime.cpu);
    EXPECT_EQ(shown.realtime.lock_memory, left_out.realtime.lock_memory);
    EXPECT_EQ(shown.trace, left_out.trace);
    EXPECT_EQ(shown.sysfs, left_out.sysfs);
    EXPECT_EQ(shown.control.socket, left_out.control.socket);
    EXPECT_EQ(shown.control.operator_group, left_out.control.operator_group);
    EXPECT_EQ(shown.lines.at(0).baud, left_out.lines.at(0).baud);
    EXPECT_EQ(shown.lines.at(0).format.data_bits, left_out.lines.at(0).format.data_bits);
    EXPECT_EQ(shown.lines.at(0).timeout, left_out.lines.at(0).timeout);
    EXPECT_EQ(shown.lines.at(0).retries, left_out.lines.at(0).retries);
    EXPECT_EQ(shown.stations.at(0).output_refresh, left_out.stations.at(0).output_refresh);
    EXPECT_EQ(shown.stations.at(0).zero_after, left_out.stations.at(0).zero_after);
    EXPECT_EQ(shown.stations.at(0).personality->ident, left_out.stations.at(0).personality->ident);
    EXPECT_EQ(shown.stations.at(0).personality->demand_error_base,
              left_out.stations.at(0).personality->demand_error_base);
}

/// The same file without the settings that have a default, for the stations of other kinds.
TEST_F(ShippedSample, shows_the_defaults_of_the_other_devices_too)
{
    const Config shown = good(switched_on(sample_));
    const std::string second = with(with(kSecondStation, "\"620\"", "\"605\""), "\"01\"", "\"02\"");
    const std::string controller = R"(
[[line]]
name = "q"
port = "/dev/null-q"
protocol = "modbus-rtu"
[[station]]
name = "oven"
address = 7
profile = "2408f"
line = "q"
unit = "1"
ident = 1
)";
    const Config left_out = good(kGood + second + controller);

    ASSERT_TRUE(shown.stations.at(1).tec && left_out.stations.at(1).tec);
    EXPECT_EQ(shown.stations[1].tec->start, left_out.stations[1].tec->start);
    EXPECT_EQ(shown.stations[1].tec->trip, left_out.stations[1].tec->trip);
    EXPECT_EQ(shown.stations[1].tec->ext_diagnostic_tag, left_out.stations[1].tec->ext_diagnostic_tag);
    EXPECT_EQ(shown.stations[1].zero_after, left_out.stations[1].zero_after);
    for (const std::size_t station : {1U, 2U}) {
        EXPECT_EQ(shown.stations[station].ext_diag_bit, left_out.stations[station].ext_diag_bit);
        EXPECT_EQ(shown.stations[station].watched, left_out.stations[station].watched);
        EXPECT_EQ(shown.stations[station].status_tag, left_out.stations[station].status_tag);
    }
    EXPECT_EQ(shown.stations[2].integer_resolution, left_out.stations[2].integer_resolution);
    EXPECT_EQ(shown.stations[2].personality->extended_reply,
              left_out.stations[2].personality->extended_reply);
    EXPECT_EQ(shown.stations[2].tags->find(1)->decimals, left_out.stations[2].tags->find(1)->decimals);
    EXPECT_EQ(shown.lines.at(1).format.data_bits, left_out.lines.at(1).format.data_bits);
    EXPECT_EQ(shown.lines.at(1).format.parity, left_out.lines.at(1).format.parity);
}

} // namespace
} // namespace dpslave
