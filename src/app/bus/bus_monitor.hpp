// SPDX-License-Identifier: Apache-2.0
/// The view of the whole bus (dp/bus_members), made behind the replies: what is heard is only noted at once.
#pragma once

#include "dpslave/dp/bus_members.hpp"
#include "dpslave/fdl/telegram.hpp"
#include "dpslave/fdl/telegram_listener.hpp"

#include <array>
#include <cstddef>

namespace dpslave::app {

class BusMonitor final : public fdl::TelegramListener {
public:
    /// Telegrams that wait at most. One more makes room for itself by counting them.
    static constexpr std::size_t kMost = 32;

    /// Also for what our own stations send.
    void on_telegram(const fdl::Telegram& telegram, Instant at) override;
    /// Counts what was noted. To be called when no reply waits.
    void catch_up();
    /// As of the last catch_up().
    const dp::BusMembers& members() const { return members_; }

private:
    struct Noted {
        fdl::Telegram telegram; ///< its data: in `data`
        Instant at{};
        fdl::Frame data;
    };
    std::array<Noted, kMost> noted_{};
    std::size_t count_ = 0;
    dp::BusMembers members_;
};

} // namespace dpslave::app
