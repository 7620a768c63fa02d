// SPDX-License-Identifier: Apache-2.0
/// Refusals, events and states as the control interface and the log have them.
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/dp/event_log.hpp"
#include "dpslave/report/replies.hpp"

#include <string>
#include <string_view>

namespace dpslave::report {

// The codes of the control interface: words that programs compare.
std::string_view code(AccessError error) noexcept;      ///< "no_answer", "invalid_tag" ...
std::string_view code(WordState state) noexcept;        ///< "good", "stale" ...
std::string_view code(dp::Refusal why) noexcept;        ///< "prm_ident", "cfg_too_few" ...
std::string_view code(dp::LeaveReason reason) noexcept; ///< "watchdog", "unlock" ...

/// "invalid tag", "read only" ...
std::string_view text(AccessError error) noexcept;

/// What a refused Set_Prm or Chk_Cfg was refused for, in a sentence and with an advice.
Refusal explain(const dp::RefusalDetail& refusal);

/// One line for the log.
std::string sentence(const std::string& station, const dp::Event& event);

} // namespace dpslave::report
