// SPDX-License-Identifier: Apache-2.0
/// Refusals, events and states as the control interface and the log have them.
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/dp/pending_events.hpp"
#include "dpslave/report/replies.hpp"

#include <string>
#include <string_view>

namespace dpslave::report {

// The codes of the control interface: words that programs compare.
std::string_view code(AccessError error) noexcept;      ///< "no_answer", "invalid_tag" ...
std::string_view code(WordState state) noexcept;        ///< "good", "stale" ...
std::string_view code(dp::LeaveReason reason) noexcept; ///< "watchdog", "unlock" ...

/// "invalid tag", "read only" ...
std::string_view text(AccessError error) noexcept;

/// Begins the reason of a call that its drive line did not serve in time. The drive has not refused it.
inline constexpr std::string_view kLineDidNotServe = "the drive line has not come to it";

/// Why the start is held: "the drive denies a tag"; empty: it is not.
std::string_view text(StartHold hold) noexcept;

/// What a refused Set_Prm or Chk_Cfg was refused for, in a sentence and with an advice.
Refusal explain(const dp::RefusalDetail& refusal);

/// One line for the log.
std::string sentence(const std::string& station, const dp::Event& event);

} // namespace dpslave::report
