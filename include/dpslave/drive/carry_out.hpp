// SPDX-License-Identifier: Apache-2.0
/// One transaction of the poller, made by a back-end.
#pragma once

#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/poller.hpp"

#include <cstdint>
#include <span>

namespace dpslave::drive {

/// Blocks as long as the back-end does. Words that are read lie in `words`, which has room for as many as the
/// transaction asks for.
Outcome carry_out(const Transaction& transaction, Backend& backend, const UnitAddress& drive,
                  std::span<std::uint16_t> words);

} // namespace dpslave::drive
