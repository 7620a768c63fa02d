// SPDX-License-Identifier: Apache-2.0
// Wireshark reads the captures of the real programs with config/wireshark, and calls each telegram as dpctl
// trace does. tests/wireshark has the dissector with packets written by hand.
// Only here: a file of the daemon in a program of others.
#include "support/paths.hpp"
#include "system/gateway.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace dpslave::test {
namespace {

constexpr const char* kTshark = "/usr/bin/tshark";

std::vector<std::string> lines_of(const std::string& text)
{
    std::istringstream stream{text};
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// tshark with the files of config/wireshark, on a capture.
Outcome tshark(const Gateway& gateway, const std::string& capture, const Arguments& more)
{
    Arguments command{kTshark, "-r", capture};
    for (const char* script : {"dpslaved_profibus.lua", "dpslaved_drive.lua"})
        command.insert(command.end(), {"-X", "lua_script:" + source_path("config/wireshark/") + script});
    command.insert(command.end(), more.begin(), more.end());
    return run(command, {{"HOME", gateway.folder("home").string()},
                         {"XDG_CONFIG_HOME", gateway.folder("home").string()}});
}

constexpr const char* kNoTelegram = "no telegram";

/// What dpctl trace has a packet for, each with the words that Wireshark must have for it too.
std::vector<std::string> services_of(const Gateway& gateway)
{
    std::vector<std::string> services;
    for (const std::string& line : lines_of(gateway.dpctl({"--json", "trace"}).out)) {
        const Json entry = Json::parse(line);
        const std::string what = entry.at("what");
        if (what == "telegram" || what == "reply") services.push_back(entry.at("service"));
        if (what == "piece") services.emplace_back(kNoTelegram);
        if (what == "unanswered") services.emplace_back(); // a comment, and no octets
    }
    return services;
}

/// A start-up, control commands, a refusal, a wrong FCS and a telegram that is cut off, then a silent bus.
void speak_on_the_bus(Gateway& gateway)
{
    Master master{gateway, {"--tags", "55,56w"}};
    for (const char* command : {"start 30s", "out 1 = 1250", "sync", "unsync", "freeze", "unfreeze", "clear",
                                "operate", "get-cfg", "diag", "demand read 55"})
        ASSERT_TRUE(master.does(command)) << command;
    for (const char* wrong : {"send 10 05 02 49 51 16", "send 68 05 05 68 85 82"}) {
        const std::uint64_t before = gateway.flaws();
        master.send_line(wrong);
        ASSERT_TRUE(eventually([&] { return gateway.flaws() > before; })) << wrong;
    }
    ASSERT_TRUE(master.does("unlock"));
    master.send_line("quit");
    ASSERT_TRUE(master.wait());
}

/// Of each packet that tshark shows its service and what it finds wrong, compared with those of dpctl trace.
void expect_services(const Outcome& shown, const std::vector<std::string>& services)
{
    ASSERT_EQ(shown.status, 0) << shown.err;
    const auto packets = lines_of(shown.out);
    ASSERT_EQ(packets.size(), services.size());
    for (std::size_t i = 0; i < packets.size(); ++i) {
        const std::size_t tab = packets[i].find('\t');
        ASSERT_NE(tab, std::string::npos) << packets[i];
        if (services[i] == kNoTelegram)
            EXPECT_NE(packets[i].substr(tab + 1), "") << "packet " << i + 1;
        else
            EXPECT_EQ(packets[i].substr(0, tab), services[i]) << "packet " << i + 1;
    }
}

TEST(Wireshark, CallsEachTelegramOfACaptureAsDpctlTraceDoesAndFindsNoneMalformed)
{
    if (!std::filesystem::exists(kTshark)) GTEST_SKIP() << "there is no tshark: apt-get install tshark";
    Gateway gateway;
    speak_on_the_bus(gateway);
    const std::vector<std::string> services = services_of(gateway);
    for (const char* service : {"Set_Prm", "Chk_Cfg", "Slave_Diag, reply", "Data_Exchange, reply",
                                "Global_Control", "Get_Cfg, reply", "SC", kNoTelegram})
        EXPECT_NE(std::find(services.begin(), services.end(), service), services.end()) << service;

    for (const std::string link_type : {"profibus", "user0"}) {
        const std::string capture = gateway.folder(link_type + ".pcapng").string();
        ASSERT_EQ(gateway.dpctl({"trace", "--output", capture, "--linktype", link_type}).status, 0);

        expect_services(tshark(gateway, capture,
                               {"-Y", "frame.interface_name == \"bus\"", "-T", "fields", "-E", "separator=/t",
                                "-e", "profibus.service", "-e", "_ws.expert.message"}),
                        services);
        const Outcome whole = tshark(gateway, capture, {"-V"});
        EXPECT_NE(whole.out.find("PROFIBUS DP, Data_Exchange"), std::string::npos) << link_type;
        for (const char* word : {"Malformed", "Lua Error", "WTAP_ENCAP", "User encapsulation"})
            EXPECT_EQ(whole.out.find(word), std::string::npos) << link_type << ": " << word;
    }
}

/// Questions and answers of a drive line, and whether each is marked as sent, as dpctl and as tshark show
/// them.
void expect_frames(const Gateway& gateway, const std::string& field, const Arguments& words)
{
    const std::string capture = gateway.folder("drive.pcapng").string();
    ASSERT_EQ(gateway.dpctl({"trace", "--line", "p3", "--output", capture}).status, 0);
    const Outcome shown = tshark(gateway, capture,
                                 {"-T", "fields", "-E", "separator=/t", "-e", "frame.interface_name", "-e",
                                  "frame.packet_flags_direction", "-e", field, "-e", "frame.comment"});
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_NE(shown.out.find("drive p3\t"), std::string::npos) << shown.out;
    for (const std::string& word : words)
        EXPECT_NE(shown.out.find(word), std::string::npos) << word << " in\n" << shown.out;
    const Outcome whole = tshark(gateway, capture, {"-V"});
    for (const char* word : {"Malformed", "Lua Error", "User encapsulation"})
        EXPECT_EQ(whole.out.find(word), std::string::npos) << word;
}

TEST(Wireshark, CallsTheFramesOfAnEiAsciiLineAsTheyAreWithTheirJudgement)
{
    if (!std::filesystem::exists(kTshark)) GTEST_SKIP() << "there is no tshark: apt-get install tshark";
    Gateway gateway{{.units = {"00", "01"}, .present = {"00"}}};
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    ASSERT_TRUE(eventually([&] {
        return gateway.dpctl({"trace", "--line", "p3", "--bad"}).out.find("no answer") != std::string::npos;
    }));

    expect_frames(
        gateway, "eiascii.service",
        {"\t0x00000002\tread II at 00\t\n", "\t0x00000001\tvalue II = ", "\ttaken\n", "01: no answer"});
}

TEST(Wireshark, HandsTheFramesOfAModbusLineToItsOwnDissector)
{
    if (!std::filesystem::exists(kTshark)) GTEST_SKIP() << "there is no tshark: apt-get install tshark";
    Gateway gateway{
        {.profile = "2408f", .units = {"1"}, .protocol = "modbus-rtu", .keys = "ident = 0x0A0B\n"}};
    Master master{gateway, {"--family", "controller", "--ident", "0x0A0B", "--tags", "1"}};
    ASSERT_TRUE(master.does("start 30s"));

    expect_frames(gateway, "modbus.func_code", {"\t0x00000002\t3\t\n", "\t0x00000001\t3\ttaken\n"});
}

} // namespace
} // namespace dpslave::test
