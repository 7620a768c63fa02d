// SPDX-License-Identifier: Apache-2.0
/// Error replies as sentences that say what to do, and as exit statuses.
#pragma once

#include "terminal.hpp"

#include "dpslave/control/protocol.hpp"

#include <string>

namespace dpslave::dpctl {

std::string explain(const control::ReplyMessage& error);
/// The exit status that an error reply demands.
Exit exit_of(const control::ReplyMessage& error);

} // namespace dpslave::dpctl
