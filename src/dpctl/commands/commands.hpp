// SPDX-License-Identifier: Apache-2.0
/// The table of the commands.
#pragma once

#include "dpctl/cli/command.hpp"

#include <span>

namespace dpslave::dpctl {

// Each in the file of its name.
extern const Command kStatus, kShow, kIo, kDiag, kCounters, kRead, kBus, kDoctor, kTune, kVersion;
extern const Command kTrace, kTop, kEvents, kPlot, kMetrics;
extern const Command kWrite, kTec, kTecSet, kSurvey, kLogLevel, kReload;
extern const Command kTag, kIdentify, kHex, kDecode;
extern const Command kGsd, kGsdCheck, kGsdShow, kGsdMake, kGsdImport, kGsdDiff, kGsdConfigure, kGsdTypes;

/// In the order of the help; a command stands behind the one that it is below of.
std::span<const Command* const> commands();

} // namespace dpslave::dpctl
