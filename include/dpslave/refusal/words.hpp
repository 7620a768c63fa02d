// SPDX-License-Identifier: Apache-2.0
/// A refusal in words: the same wherever a person reads why a Set_Prm or Chk_Cfg is refused.
#pragma once

#include "dpslave/dp/refusal.hpp"

#include <string>
#include <string_view>

namespace dpslave::refusal {

using dp::Refusal;
using dp::RefusalDetail;
using dp::Service;

/// The word that programs compare: "prm_ident", "cfg_too_few". It never changes.
std::string_view code(Refusal why) noexcept;
/// "Set_Prm" or "Chk_Cfg"; empty: none of them.
std::string_view name_of(Service service) noexcept;
/// Returns what to do, without a capital letter and a full stop.
std::string_view advice_for(Refusal why) noexcept;

/// The expected and the received value, with their units; empty if there is nothing to say.
struct ExpectedAndGot {
    std::string expected, got;
};
ExpectedAndGot expected_and_got(const RefusalDetail& refusal);

/// "the Ident_Number is that of another device, octet 5, expected Ident_Number 0x0533, got 0x1234; use the
/// GSD ...".
std::string clause(const RefusalDetail& refusal);

} // namespace dpslave::refusal
