// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"

#include <array>

namespace dpslave::dpctl {
namespace {

constexpr std::array kCommands{
    &kStatus,  &kShow,     &kIo,        &kDiag,    &kCounters,     &kRead,    &kBus,    &kDoctor, &kTune,
    &kVersion, &kTrace,    &kTop,       &kEvents,  &kPlot,         &kMetrics, &kWrite,  &kTec,    &kTecSet,
    &kSurvey,  &kLogLevel, &kReload,    &kTag,     &kIdentify,     &kHex,     &kDecode, &kGsd,    &kGsdCheck,
    &kGsdShow, &kGsdMake,  &kGsdImport, &kGsdDiff, &kGsdConfigure, &kGsdTypes};

} // namespace

std::span<const Command* const> commands()
{
    return kCommands;
}

} // namespace dpslave::dpctl
