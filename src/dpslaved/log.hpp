// SPDX-License-Identifier: Apache-2.0
/// The log of the program.
#pragma once

#include "dpslave/io/log_thread.hpp"

#include <memory>

namespace dpslave {

/// From now on spdlog writes to standard error: with the time, or with the level for the journal. Not into
/// the journal's own socket: what a program says there right before its end is not found under its unit.
///
/// Only the thread that is returned waits for what stands behind it. Lines for which there is no room are
/// lost, and their number is written as soon as there is room again. Throws std::system_error when the system
/// has no thread or no descriptor left.
std::shared_ptr<io::LogThread> set_up_log();

} // namespace dpslave
