// SPDX-License-Identifier: Apache-2.0
/// Makes the view of the parameters of one drive that others see.
#pragma once

#include "drive_tags.hpp"
#include "parameter_set.hpp"

namespace dpslave::drive {

/// `repeats`: this many accesses in a row without an answer are corrected by a repetition as a rule; 0 of a
/// drive that is lost.
void show_parameters(DriveSnapshot& snapshot, const Layout& layout, const ParameterSet& parameters,
                     int repeats);
void show_watched(DriveSnapshot& snapshot, const DriveTags& tags, const ParameterSet& parameters,
                  int repeats);

void count(DriveSnapshot& snapshot, const Transaction& transaction, AccessError error);

/// The inputs of the layout, for the master, and whether the exchange may begin.
InputImage inputs(const Layout& layout, const ParameterSet& parameters, const DriveSettings& settings);

} // namespace dpslave::drive
