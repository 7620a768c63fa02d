// SPDX-License-Identifier: Apache-2.0
/// Registers of a 2408f/2404f that mean something to the simulator. Private to this folder.
#pragma once

#include <cstdint>

namespace dpslave::sim {

/// Registers with a meaning (handbook chapter 8).
inline constexpr std::uint16_t kProcessValue = 1, kTargetSetpoint = 2, kOutputPower = 3, kWorkingSetpoint = 5,
                               kSelectSetpoint = 15, kProgramNumber = 22, kProgramStatus = 23,
                               kSetpoint1 = 24, kSetpoint2 = 25, kManualValve = 60, kFastStatus = 74,
                               kSummaryStatus = 75, kControlStatus = 76, kVersion = 107, kIdent = 122,
                               kSetpoint3 = 164, kMode = 199, kMostSegments = 211, kSkipReadOnly = 220,
                               kAutotune = 270, kManual = 273, kDecimals = 525, kResolution = 12550;

/// Each tag has two registers from here on: an IEEE single or 32 bits.
inline constexpr unsigned kIeeeArea = 0x8000;
constexpr std::uint16_t tag_at(unsigned address)
{
    return static_cast<std::uint16_t>(address < kIeeeArea ? address : (address - kIeeeArea) / 2);
}

/// Bits of the summary output status word and of the control status word.
inline constexpr unsigned kSummaryManual = 4, kSummaryTuning = 8, kTuneFailed = 3, kTuneCompleted = 8,
                          kTuning = 12, kControlManual = 15;

inline constexpr std::int32_t kReset = 1, kRun = 2, kHold = 4, kComplete = 16; ///< tag 23

/// The program store: the running program, then programs 1 to 4, a block of eight for the program and one for
/// each of 16 segments.
inline constexpr std::uint16_t kStore = 8192, kProgramWords = 136;
inline constexpr unsigned kPrograms = 4;
/// The eight words of a segment have its type, and a rate or a duration, as the type says.
inline constexpr unsigned kSegmentWords = 8, kSegmentType = 0, kDurationOrRate = 2;
inline constexpr std::int32_t kRampRate = 1, kRampTime = 2, kDwell = 3;

} // namespace dpslave::sim
