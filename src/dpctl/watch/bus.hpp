// SPDX-License-Identifier: Apache-2.0
/// Who is on the bus, as text.
#pragma once

#include "dpctl/cli/table.hpp"

#include "dpslave/report/replies.hpp"

#include <string>

namespace dpslave::dpctl {

/// `reply`: the parameters of GetBus. One line for each address, then whom the masters ask without an answer.
std::string render_bus(const report::GetBusReply& reply, Look look);

} // namespace dpslave::dpctl
