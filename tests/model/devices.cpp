// SPDX-License-Identifier: Apache-2.0
#include "devices.hpp"

namespace test {
namespace {

/// The slave of the examples in the wire reference: any User_Prm_Data, no tags.
model::Device example()
{
    model::Device device;
    device.name = "example";
    device.ident = 0x4711;
    device.identifiers = {{0x11, true, false}, {0x21, false, true}};
    device.most_parameters = 8;
    device.longest_prm = 237;
    device.prm_may_be_absent = true;
    device.sync = device.freeze = true;
    device.longest_diag = 32;
    return device;
}

/// HA389815.
model::Device option_board()
{
    model::Device device;
    device.name = "option board";
    device.ident = 0x0533;
    device.identifiers = {{0x50, true, false}, {0x60, false, true}};
    device.demand_identifier = 0x73;
    device.most_parameters = 12;
    device.list = model::first_zero_ends;
    device.shortest_prm = device.longest_prm = 24;
    device.sync = device.freeze = true;
    return device;
}

/// HA463561.
model::Device technology_box()
{
    model::Device device = option_board();
    device.name = "technology box";
    device.ident = 0x1649;
    device.identifiers.push_back({0x70, true, true});
    device.most_parameters = 30;
    device.list = model::zeros_at_end;
    device.tags_at = 3;
    device.shortest_prm = 3;
    device.longest_prm = 63;
    device.prm_may_be_absent = true;
    device.dpv1_status = true;
    device.longest_diag = 10;
    device.own_diag_octets = 3;
    return device;
}

/// 2408f/2404f handbook.
model::Device controller()
{
    model::Device device = option_board();
    device.name = "controller";
    device.ident = 0x2408;
    device.most_parameters = 117;
    device.most_words = 117;
    device.list = model::exact;
    device.shortest_prm = 0;
    device.longest_prm = 234;
    device.highest_tag = 16'383;
    device.extended_demand = true;
    device.sync = device.freeze = false;
    device.longest_diag = 9;
    device.own_diag_octets = 2;
    return device;
}

std::vector<model::Device> make_devices()
{
    std::vector<model::Device> all{example(), option_board(), technology_box(), controller()};
    model::Device fail_safe = example();
    fail_safe.name = "example with Fail_Safe, without Freeze";
    fail_safe.fail_safe = true;
    fail_safe.freeze = false;
    all.push_back(fail_safe);
    model::Device scales = option_board();
    scales.name = "option board that has to find scales";
    scales.tries_outputs = true;
    scales.error_base = 1;
    all.push_back(scales);
    model::Device as_example = controller();
    as_example.name = "controller with replies as in the example, short max T_SDR";
    as_example.replies_as_example = true;
    as_example.most_words = 30;
    as_example.max_tsdr = 150;
    all.push_back(as_example);
    model::Device box = technology_box();
    box.name = "technology box with Fail_Safe that has to find scales";
    box.fail_safe = true;
    box.tries_outputs = true;
    box.longest_diag = 20;
    all.push_back(box);
    model::Device waits = example();
    waits.name = "example that waits for its drive";
    waits.waits_for_drive = true;
    all.push_back(waits);
    return all;
}

dpslave::dp::TagList tag_list_of(model::TagList list)
{
    switch (list) {
        case model::first_zero_ends: return dpslave::dp::TagList::first_zero_ends;
        case model::zeros_at_end: return dpslave::dp::TagList::zeros_at_end;
        case model::exact: return dpslave::dp::TagList::exact;
        case model::no_tags: break;
    }
    return dpslave::dp::TagList::none;
}

} // namespace

const std::vector<model::Device>& model_devices()
{
    static const std::vector<model::Device> all = make_devices();
    return all;
}

dpslave::dp::Personality personality_of(const model::Device& device)
{
    using namespace dpslave;
    dp::Personality p;
    p.ident = static_cast<std::uint16_t>(device.ident);
    p.max_tsdr.fill(Tbit{static_cast<std::uint32_t>(device.max_tsdr)});
    for (const model::Identifier& one : device.identifiers)
        p.identifiers.push_back({static_cast<std::uint8_t>(one.octet),
                                 one.reads ? std::uint8_t{1} : std::uint8_t{0},
                                 one.writes ? std::uint8_t{1} : std::uint8_t{0}});
    p.demand_identifier = static_cast<std::uint8_t>(device.demand_identifier);
    p.max_parameters = static_cast<std::size_t>(device.most_parameters);
    p.max_words = static_cast<std::size_t>(device.most_words);
    p.tries_outputs = device.tries_outputs;
    p.waits_for_drive = device.waits_for_drive;
    p.prm = {.tags_at = static_cast<std::size_t>(device.tags_at),
             .min_length = static_cast<std::size_t>(device.shortest_prm),
             .max_length = static_cast<std::size_t>(device.longest_prm),
             .may_be_absent = device.prm_may_be_absent,
             .dpv1_status = device.dpv1_status,
             .max_tag = static_cast<std::uint16_t>(device.highest_tag),
             .list = tag_list_of(device.list)};
    p.demand = device.demand_identifier == 0 ? dp::DemandForm::none
               : device.extended_demand      ? dp::DemandForm::extended
                                             : dp::DemandForm::basic;
    p.demand_error_base = static_cast<std::uint16_t>(device.error_base);
    p.extended_reply = device.replies_as_example ? dp::ExtendedReply::example : dp::ExtendedReply::table;
    p.sync = device.sync;
    p.freeze = device.freeze;
    p.fail_safe = device.fail_safe;
    p.max_diag_length = static_cast<std::size_t>(device.longest_diag);
    p.diag_octets = static_cast<std::uint8_t>(device.own_diag_octets);
    return p;
}

} // namespace test
