// SPDX-License-Identifier: Apache-2.0
/// What can be seen of the parameters of one drive.
#pragma once

#include "parameter_set.hpp"
#include "unit_tags.hpp"

namespace dpslave::drive {

/// `repeats`: so many accesses in a row without an answer are mended by a repetition as a rule; 0 of a drive
/// that is lost.
void show_parameters(UnitSnapshot& snapshot, const Layout& layout, const ParameterSet& parameters,
                     int repeats);
void show_watched(UnitSnapshot& snapshot, const UnitTags& tags, const ParameterSet& parameters, int repeats);

void count(UnitSnapshot& snapshot, const Transaction& transaction, AccessError error);

/// The inputs of the layout, for the master.
InputImage inputs(const Layout& layout, const ParameterSet& parameters);

} // namespace dpslave::drive
