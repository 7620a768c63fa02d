// SPDX-License-Identifier: Apache-2.0
/// The tables of a profile that say how its device behaves on the bus.
#pragma once

#include "dpslave/dp/personality.hpp"
#include "dpslave/input/document.hpp"

namespace dpslave::profile {

/// [max_tsdr], [cfg_data], [demand_data], [user_prm_data] and [global_control]. A wrong value becomes a fault
/// of the document; `into` then keeps what it was.
void read_personality(input::Document& document, dp::Personality& into);

} // namespace dpslave::profile
