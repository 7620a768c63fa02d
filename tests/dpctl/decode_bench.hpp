// SPDX-License-Identifier: Apache-2.0
/// Octets as text, decoded; and two devices by hand.
#pragma once

#include "dpctl/decode/decode.hpp"

#include <string>
#include <vector>

namespace dpslave::dpctl {

inline std::vector<Decoded> decoded(const std::string& octets, const profile::Profile* device = nullptr)
{
    const auto read = read_octets({octets});
    if (!read) return {};
    return decode_all(*read, {.device = device, .tags = {}});
}

inline std::string picture(const std::string& octets, const profile::Profile* device = nullptr)
{
    return render_decoded(decoded(octets, device), false);
}

/// What the octet with this number means.
inline std::string meaning(const Decoded& part, std::size_t octet)
{
    for (const Decoded::Octet& one : part.octets)
        if (one.octet == octet) return one.meaning;
    return "no such octet";
}

/// A box as HA463561U002 describes it, with ident 0x1649.
inline profile::Profile technology_box()
{
    profile::Profile box;
    box.name = "box";
    box.ident = 0x1649;
    box.personality.ident = 0x1649;
    box.personality.identifiers = {{0x50, true, false}, {0x60, false, true}, {0x70, true, true}};
    box.personality.demand_identifier = 0x73;
    box.personality.demand = dp::DemandForm::basic;
    box.personality.max_parameters = 30;
    box.personality.prm = {.tags_at = 3,
                           .min_length = 3,
                           .max_length = 63,
                           .may_be_absent = true,
                           .dpv1_status = true,
                           .max_tag = 2047,
                           .list = dp::TagList::zeros_at_end};
    box.personality.sync = box.personality.freeze = true;
    box.personality.max_diag_length = 10;
    box.personality.diag_octets = 3;
    box.diagnosis = profile::DiagForm::trip_code;
    drive::Tag tag;
    tag.number = 271;
    tag.name = "COMMS COMMAND";
    box.tags = drive::TagTable{{tag}};
    return box;
}

/// An instrument as the 2408f/2404f handbook describes it.
inline profile::Profile controller()
{
    profile::Profile instrument;
    instrument.name = "instrument";
    instrument.diagnosis = profile::DiagForm::status_word;
    instrument.status_tag = 75;
    instrument.personality.max_diag_length = 9;
    drive::Tag status;
    status.number = 75;
    status.type = drive::TagType::word;
    status.labels = {{true, 4, "Manual"}, {true, 5, "Sensor break"}, {true, 14, "IP1 fault"}};
    instrument.tags = drive::TagTable{{status}};
    return instrument;
}

} // namespace dpslave::dpctl
