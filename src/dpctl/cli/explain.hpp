// SPDX-License-Identifier: Apache-2.0
/// Error replies as sentences that say what to do.
#pragma once

#include "dpslave/control/protocol.hpp"

#include <string>

namespace dpslave::dpctl {

std::string explain(const control::ReplyMessage& error);

} // namespace dpslave::dpctl
