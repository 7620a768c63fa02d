// SPDX-License-Identifier: Apache-2.0
#include "family.hpp"

namespace conformance {
namespace {

void append(Octets& octets, std::uint16_t tag)
{
    octets.push_back(static_cast<std::uint8_t>(tag / 256));
    octets.push_back(static_cast<std::uint8_t>(tag % 256));
}

/// The tags of the mapping, `head` before them, filled up with zeros to `length`.
Octets mapped(Octets head, std::size_t length)
{
    for (const std::uint16_t tag : kInputTags) append(head, tag);
    for (const std::uint16_t tag : kOutputTags) append(head, tag);
    head.resize(length);
    return head;
}

/// `count` tags from kFirstNumberedTag on.
Octets numbered(Octets head, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) append(head, static_cast<std::uint16_t>(kFirstNumberedTag + i));
    return head;
}

/// Demand Data, `inputs` and `outputs`.
Octets demand_and(std::size_t inputs, std::size_t outputs)
{
    Octets octets{0x73};
    octets.insert(octets.end(), inputs, 0x50);
    octets.insert(octets.end(), outputs, 0x60);
    return octets;
}

/// 30 parameters that are read and written.
Octets demand_and_both_ways()
{
    Octets octets{0x73};
    octets.insert(octets.end(), 30, 0x70);
    return octets;
}

/// HA389815: 24 octets of tags, 12 parameters, six octets of diagnosis.
Family option_board()
{
    return {.name = "option board",
            .suite = "OptionBoard",
            .profile = "590",
            .ident = 0x0533,
            .has_own_ident = false,
            .sync_and_freeze = true,
            .both_ways = false,
            .dpv1_status = false,
            .user_prm = mapped({}, 24),
            .bad_user_prm = mapped({0x08, 0x00}, 24), // tag 2048
            .all_user_prm = numbered({}, 12),
            .all_cfg = demand_and(6, 6),
            .healthy = {},
            .faulty = {},
            .most_diag = 6};
}

/// HA463561: DPV1_Status, then tags; 30 parameters; trip code and EXT DIAGNOSTIC in the diagnosis.
Family technology_box()
{
    return {.name = "technology box",
            .suite = "TechnologyBox",
            .profile = "605",
            .ident = 0x1649,
            .has_own_ident = false,
            .sync_and_freeze = true,
            .both_ways = true,
            .dpv1_status = true,
            .user_prm = mapped({0, 0, 0}, 15),
            .bad_user_prm = mapped({0x80, 0, 0}, 15), // DPV1_Enable
            .all_user_prm = numbered({0, 0, 0}, 30),
            .all_cfg = demand_and_both_ways(),
            .healthy = {0x04, 0x00, 0x00, 0x00},
            .faulty = {0x04, 0x01, 0x00, 0x00},
            .most_diag = 10};
}

/// HA026290: as many tags as identifiers, 117 words in both directions together, a status word in the
/// diagnosis.
Family controller()
{
    return {.name = "controller",
            .suite = "Controller",
            .profile = "2408f",
            .ident = 0x0A0B, // no source states the true one: any will do
            .has_own_ident = true,
            .sync_and_freeze = false,
            .both_ways = false,
            .dpv1_status = false,
            .user_prm = mapped({}, 12),
            .bad_user_prm = mapped({0x40, 0x00}, 14), // tag 16384
            .all_user_prm = numbered({}, kMostNumberedTags),
            .all_cfg = demand_and(54, 55),
            .healthy = {0x03, 0x00, 0x00},
            .faulty = {0x03, 0x00, 0x01},
            .most_diag = 9};
}

} // namespace

const std::array<Family, 3>& families()
{
    static const std::array<Family, 3> all{option_board(), technology_box(), controller()};
    return all;
}

Octets cfg()
{
    return {0x50, 0x50, 0x60, 0x60, 0x60, 0x60};
}

Lengths lengths_of(const Octets& cfg)
{
    Lengths sum;
    for (const std::uint8_t identifier : cfg) { // wire reference 4.5, general format
        const std::size_t length = ((identifier & 0x0Fu) + 1u) * ((identifier & 0x40u) != 0 ? 2 : 1);
        if ((identifier & 0x10) != 0) sum.inputs += length;
        if ((identifier & 0x20) != 0) sum.outputs += length;
    }
    return sum;
}

} // namespace conformance
