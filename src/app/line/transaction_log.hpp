// SPDX-License-Identifier: Apache-2.0
/// What a drive line asks, in the log.
#pragma once

#include "app/links/links.hpp"

#include "dpslave/drive/poller.hpp"

#include <string>

namespace dpslave::app {

/// At level debug each request to a drive is a line of the log.
void log_transaction(const std::string& line, const DriveUnit& unit, const drive::Transaction& transaction,
                     const drive::Outcome& outcome);

} // namespace dpslave::app
