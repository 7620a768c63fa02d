// SPDX-License-Identifier: Apache-2.0
/// Notes what is remarkable about the parameters of a mapping: twice, not writable, not known. It does not
/// judge whether the slave accepts their octets.
#pragma once

#include "gsd_device_facts.hpp"

namespace dpslave::profile {

bool reads(const GsdParameter& parameter);
bool writes(const GsdParameter& parameter);

/// Returns the identifier for words of parameters with this direction; nullptr if the device has none.
const dp::Identifier* identifier_for(const dp::Personality& personality, const GsdParameter& word);

/// Adds the notes of each parameter.
void note_parameters(const Profile& profile, const dp::Personality& personality,
                     const std::vector<GsdParameter>& words, Notes& notes);
/// Adds the notes of a tag whatever its direction. `name`: "tag 5".
void note_tag(const Profile& profile, std::uint16_t number, const std::string& name, Notes& notes);

} // namespace dpslave::profile
