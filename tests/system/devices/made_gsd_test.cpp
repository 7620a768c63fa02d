// SPDX-License-Identifier: Apache-2.0
// A master that knows nothing but the GSD that `dpctl gsd make` wrote: the gateway takes exactly this.
// Only here: a file that goes from one program to another.
#include "support/paths.hpp"
#include "system/gateway.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

/// An order, and what shows that it was carried out.
struct Step {
    const char* order;
    const char* proof;
};

/// What devices of a kind have in common. Scaled integers: tag 56 has two decimals, tag 62 one.
struct Family {
    const char* list;          ///< parameters in the order of the telegram, whose directions alternate
    std::vector<Step> outputs; ///< order to the master, proof of the drive
    std::vector<Step> inputs;  ///< order to the drive, or none; proof of the master
};

const Family kOptionBoard{"out:56,in:55,out:62,in:61",
                          {{"out 1 = 300", "tag 56 written 3.00"}, {"out 2 = 400", "tag 62 written 40.0"}},
                          {{"set 55 12.50", "in 1 = 1250"}, {"set 61 33.3", "in 2 = 333"}}};
const Family kTechnologyBox{"out:56,in-out:62,in:55",
                            {{"out 1 = 300", "tag 56 written 3.00"}, {"out 2 = 400", "tag 62 written 40.0"}},
                            {{"", "in 1 = 400"}, {"set 55 12.50", "in 2 = 1250"}}};
const Family kController{"out:24,in:1,out:25,in:24",
                         {{"out 1 = 300", "tag 24 written 30.0"}, {"out 2 = 400", "tag 25 written 40.0"}},
                         {{"set 1 12.5", "in 1 = 125"}, {"", "in 2 = 300"}}};

struct Device {
    const char* profile;
    const Family& family;
    bool is_open; ///< its ident is in no source: any number stands for that of the site
};

bool is_controller(const Device& device)
{
    return &device.family == &kController;
}

Wiring wired(const Device& device)
{
    Wiring wiring;
    wiring.profile = device.profile;
    if (is_controller(device)) {
        wiring.protocol = "modbus-rtu";
        wiring.units = {"1"};
    } else {
        wiring.table = content(source_path("config/tags/example.csv")) + '\n';
    }
    if (device.is_open) wiring.keys = "ident = 0x0B0B\n";
    return wiring;
}

/// Options of a master that has the file which `dpctl gsd make` writes for these choices.
Arguments made(const Gateway& gateway, const Device& device, const Arguments& more)
{
    const std::string file = gateway.folder("MADE.GSD");
    Arguments make{"gsd",          "make",       "--profile",
                   device.profile, "--profiles", source_path("config/profiles"),
                   "--output",     file};
    if (device.is_open) make.insert(make.end(), {"--ident", "0x0B0B"});
    make.insert(make.end(), more.begin(), more.end());
    const Outcome outcome = gateway.dpctl(make);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return {"--gsd", file};
}

class MadeGsd : public ::testing::TestWithParam<Device> {};

TEST_P(MadeGsd, IsAcceptedByTheGatewayAsItStands)
{
    const Device device = GetParam();
    Gateway gateway{wired(device)};
    Master master{gateway,
                  made(gateway, device,
                       is_controller(device) ? Arguments{"--demand"}
                                             : Arguments{"--demand", "--in", "55,61", "--out", "56"})};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line(is_controller(device) ? "set 1 12.5" : "set 55 12.50");
    EXPECT_TRUE(master.does(is_controller(device) ? "wait 60s for in 1 = 125" : "wait 60s for in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = 300"));
    EXPECT_TRUE(gateway.drive().says(is_controller(device) ? "tag 24 written 30.0" : "tag 56 written 3.00"));
    EXPECT_TRUE(master.does("demand none"));
    EXPECT_TRUE(master.leaves());
}

TEST_P(MadeGsd, WhoseInputsAndOutputsAlternateHasEachValueInItsPlace)
{
    const Device device = GetParam();
    Gateway gateway{wired(device)};
    Master master{gateway, made(gateway, device, {"--order", device.family.list})};
    ASSERT_TRUE(master.does("start 60s"));
    for (const Step& output : device.family.outputs) {
        EXPECT_TRUE(master.does(output.order));
        EXPECT_TRUE(gateway.drive().says(output.proof));
    }
    for (const Step& input : device.family.inputs) {
        if (*input.order != '\0') gateway.drive().send_line(input.order);
        EXPECT_TRUE(master.does(std::string{"wait 60s for "} + input.proof));
    }
    EXPECT_TRUE(master.leaves());
}

INSTANTIATE_TEST_SUITE_P(
    OfEachProfile, MadeGsd,
    ::testing::Values(Device{"584s", kOptionBoard, false}, Device{"590", kOptionBoard, false},
                      Device{"620", kOptionBoard, false}, Device{"605", kTechnologyBox, false},
                      Device{"584sv", kTechnologyBox, true}, Device{"590plus", kTechnologyBox, true},
                      Device{"690plus", kTechnologyBox, true}, Device{"2408f", kController, true},
                      Device{"2404f", kController, true}),
    [](const auto& one) { return "Profile" + std::string{one.param.profile}; });

} // namespace
} // namespace dpslave::test
