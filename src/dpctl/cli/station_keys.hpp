// SPDX-License-Identifier: Apache-2.0
/// The keys of a station that runs, by which its slave differs from its profile.
#pragma once

#include "dpslave/profile/station_keys.hpp"
#include "dpslave/report/types.hpp"

namespace dpslave::dpctl {

inline profile::StationKeys keys_of(const report::Info& info)
{
    profile::StationKeys keys;
    if (info.ident >= 0 && info.ident <= 0xFFFF) keys.ident = static_cast<std::uint16_t>(info.ident);
    if (info.tags_at && *info.tags_at >= 0) keys.tags_at = static_cast<std::size_t>(*info.tags_at);
    for (const std::string& text : info.identifiers)
        if (const auto identifier = profile::read_identifier(text)) keys.identifiers.push_back(*identifier);
    return keys;
}

} // namespace dpslave::dpctl
