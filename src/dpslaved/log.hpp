// SPDX-License-Identifier: Apache-2.0
/// The log of the program.
#pragma once

namespace dpslave {

/// From now on spdlog writes to standard error: with the time, or with the level for the journal. Not into
/// the journal's own socket: what a program says there right before its end is not found under its unit.
///
/// No thread ever waits for what reads it. Lines for which there is no room are lost, and their number is
/// written as soon as there is room again.
void set_up_log();

} // namespace dpslave
