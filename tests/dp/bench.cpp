// SPDX-License-Identifier: Apache-2.0
#include "bench.hpp"

#include <algorithm>

namespace test {

using namespace dpslave;
using dp::Personality;

Personality example_device()
{
    Personality device;
    device.ident = 0x4711;
    device.max_tsdr = kClassMaxTsdr;
    device.identifiers = {{0x11, true, false}, {0x21, false, true}};
    device.max_parameters = 8;
    device.prm = {.max_length = 237, .may_be_absent = true, .list = dp::TagList::none};
    device.sync = true;
    device.freeze = true;
    device.max_diag_length = 32;
    return device;
}

Personality option_board()
{
    Personality device;
    device.ident = 0x0533;
    device.max_tsdr = kClassMaxTsdr;
    device.identifiers = {{0x50, true, false}, {0x60, false, true}};
    device.demand_identifier = 0x73;
    device.max_parameters = 12;
    device.prm = {.min_length = 24, .max_length = 24};
    device.demand = dp::DemandForm::basic;
    device.sync = true;
    device.freeze = true;
    return device;
}

Personality technology_box()
{
    Personality device = option_board();
    device.ident = 0x1649;
    device.identifiers.push_back({0x70, true, true});
    device.max_parameters = 30;
    device.prm = {.tags_at = 3,
                  .min_length = 3,
                  .max_length = 63,
                  .may_be_absent = true,
                  .dpv1_status = true,
                  .list = dp::TagList::zeros_at_end};
    device.max_diag_length = 10;
    device.diag_octets = 3;
    return device;
}

Personality controller()
{
    Personality device = option_board();
    device.ident = 0x2408;
    device.max_parameters = 117;
    device.max_words = 117;
    device.prm = {.min_length = 0, .max_length = 234, .max_tag = 16'383, .list = dp::TagList::exact};
    device.demand = dp::DemandForm::extended;
    device.sync = false;
    device.freeze = false;
    device.max_diag_length = 9;
    device.diag_octets = 2;
    return device;
}

std::string board_prm(const std::vector<std::uint16_t>& tags, std::string_view header)
{
    Octets all = octets(header);
    for (std::size_t i = 0; i < 12; ++i) {
        const unsigned tag = i < tags.size() ? tags[i] : 0u;
        all.push_back(static_cast<std::uint8_t>(tag / 256));
        all.push_back(static_cast<std::uint8_t>(tag % 256));
    }
    return show(all);
}

DpBench::DpBench(Personality device) : personality(std::move(device))
{
    slave.start(bus.now());
    station.attach(kUs, slave, personality.max_tsdr);
    slave.take_event(); // Wait_Prm
}

void DpBench::start_up(std::string_view prm, std::string_view cfg)
{
    ASSERT_EQ(master.set_prm(prm), "SC");
    ASSERT_EQ(state(), dp::State::wait_cfg) << text(seen().refusal.why);
    ASSERT_EQ(master.chk_cfg(cfg), "SC");
    ASSERT_EQ(state(), dp::State::data_exch) << text(seen().refusal.why);
}

void DpBench::inputs_are(const std::vector<std::uint16_t>& words)
{
    InputImage image{.generation = generation(), .every_input_tried = true};
    std::copy(words.begin(), words.end(), image.words.begin());
    slave.set_inputs(image);
}

std::vector<dp::Event> DpBench::events()
{
    std::vector<dp::Event> all;
    while (const auto event = slave.take_event()) all.push_back(*event);
    return all;
}

std::vector<Generation> DpBench::left()
{
    std::vector<Generation> all;
    while (const auto one = slave.take_left()) all.push_back(one->generation);
    return all;
}

void ExampleSlave::exchanges(std::string_view prm)
{
    start_up(prm, kCfg);
    inputs_are({0x1234});
    diagnosis_is_read();
    ASSERT_FALSE(seen().stat_diag);
    ASSERT_FALSE(seen().diag_pending);
}

} // namespace test
