// SPDX-License-Identifier: Apache-2.0
/// Hears what layer 2 hears: for a view of the whole bus.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/fdl/telegram.hpp"

namespace dpslave::fdl {

class TelegramListener {
public:
    /// A valid telegram of any station, valid during the call; `at`: when its last octet was read. May not
    /// block.
    virtual void on_telegram(const Telegram& telegram, Instant at) = 0;

protected:
    ~TelegramListener() = default;
};

} // namespace dpslave::fdl
