// SPDX-License-Identifier: Apache-2.0
// A master that knows nothing but the GSD that `dpctl gsd make` wrote: the gateway takes exactly this.
#include "system/gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

/// What a master's tool takes from the file for this slave.
struct Gsd {
    std::string ident; ///< "0x1649"
    std::string prm;   ///< User_Prm_Data, hexadecimal
    std::string cfg;   ///< of its one module, hexadecimal
};

/// The octets behind `from`: "0x00,0x37,\ 0x01" becomes "003701".
std::string octets(const std::string& text, std::size_t from)
{
    std::string hex;
    while (from < text.size()) {
        from = text.find_first_not_of(" \t\r\n\\,=", from);
        if (from == std::string::npos || text.compare(from, 2, "0x") != 0) break;
        hex += text.substr(from + 2, 2);
        from += 4;
    }
    return hex;
}

Gsd parsed(const std::string& text)
{
    const auto behind = [&](const std::string& key) {
        const auto at = text.find(key);
        return at == std::string::npos ? text.size() : at + key.size();
    };
    Gsd gsd;
    gsd.ident = text.substr(text.find("0x", behind("Ident_Number")), 6);
    gsd.prm = octets(text, behind("\nUser_Prm_Data "));
    const auto module = behind("\nModule");
    gsd.cfg = octets(text, text.find('"', text.find('"', module) + 1) + 1);
    return gsd;
}

struct Device {
    const char* profile;
    bool is_open; ///< its ident is in no source: any number stands for that of the site
};

class MadeGsd : public ::testing::TestWithParam<Device> {};

TEST_P(MadeGsd, IsAcceptedByTheGatewayAsItStands)
{
    const Device device = GetParam();
    const bool is_controller = std::string{device.profile}.starts_with("24");
    Wiring wiring;
    wiring.profile = device.profile;
    if (is_controller) {
        wiring.protocol = "modbus-rtu";
        wiring.units = {"1"};
    } else {
        wiring.table = content(std::filesystem::path{DPSLAVE_SOURCE_DIR} / "config/tags/example.csv") + '\n';
    }
    if (device.is_open) wiring.keys = "ident = 0x0B0B\n";
    Gateway gateway{wiring};
    Arguments make{"gsd",          "make",       "--profile",
                   device.profile, "--profiles", std::string{DPSLAVE_SOURCE_DIR} + "/config/profiles",
                   "--demand"};
    if (device.is_open) make.insert(make.end(), {"--ident", "0x0B0B"});
    if (!is_controller) make.insert(make.end(), {"--in", "55,61", "--out", "56"});
    const Outcome made = gateway.dpctl(make);
    ASSERT_EQ(made.status, 0) << made.err;

    const Gsd gsd = parsed(made.out);
    ASSERT_NE(gsd.prm, "") << made.out;
    ASSERT_NE(gsd.cfg, "") << made.out;
    Master master{gateway,
                  {"--family", is_controller ? "controller" : "option-board", "--ident", gsd.ident, "--prm",
                   gsd.prm, "--cfg", gsd.cfg, "--no-sync-freeze"}};
    ASSERT_TRUE(master.does("start 30s")) << gsd.ident << ' ' << gsd.prm << ' ' << gsd.cfg;
    gateway.drive().send_line(is_controller ? "set 1 12.5" : "set 55 12.50");
    EXPECT_TRUE(master.does(is_controller ? "wait 30s for in 1 = 125" : "wait 30s for in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = 300"));
    EXPECT_TRUE(gateway.drive().says(is_controller ? "tag 24 written 30.0" : "tag 56 written 3.00"));
    EXPECT_TRUE(master.does("demand none"));
    EXPECT_TRUE(master.leaves());
}
INSTANTIATE_TEST_SUITE_P(OfEachProfile, MadeGsd,
                         ::testing::Values(Device{"584s", false}, Device{"590", false}, Device{"620", false},
                                           Device{"605", false}, Device{"584sv", true},
                                           Device{"590plus", true}, Device{"690plus", true},
                                           Device{"2408f", true}, Device{"2404f", true}),
                         [](const auto& one) { return "Profile" + std::string{one.param.profile}; });

} // namespace
} // namespace dpslave::test
