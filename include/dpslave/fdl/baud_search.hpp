// SPDX-License-Identifier: Apache-2.0
/// Finds the rate of the bus by listening. Characters and telegrams go in, rates come out; no clock, no tty.
/// Source: wire reference 7.
#pragma once

#include "dpslave/base/units.hpp"

#include <bitset>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dpslave::fdl {

enum class BaudState : std::uint8_t {
    fixed,        ///< the configuration says the rate
    baud_search,  ///< listening; the station is silent
    baud_control, ///< a rate is found; T_BC and then a dwell without evidence lead back to the search
    dp_control,   ///< the watchdog of at least one slave guards the line
};
std::string_view text(BaudState state) noexcept;

struct BaudSearchSettings {
    /// The rates that the UART can do, in the order of kBauds: the others are left out, because no telegram
    /// can be received at them.
    std::bitset<kBauds.size()> rates = std::bitset<kBauds.size()>{}.set();
    std::chrono::nanoseconds dwell_fast = std::chrono::seconds{2}; ///< per rate, from 93.75 kbit/s up
    std::chrono::nanoseconds dwell_slow = std::chrono::seconds{4}; ///< per rate below
    std::chrono::nanoseconds baud_control = std::chrono::milliseconds{320}; ///< T_BC = 2 * 16 * 10 ms
};

/// Returns how long the search waits for a valid telegram at this rate before it tries the next one.
constexpr std::chrono::nanoseconds dwell_at(Baud baud, const BaudSearchSettings& settings = {})
{
    return is_slow(baud) ? settings.dwell_slow : settings.dwell_fast;
}

/// Baud_Search, Baud_Control and DP_Control (wire reference 7.1). Begins in Baud_Search.
/// Precondition of the settings: at least one searched rate among `rates` (45.45 kbit/s is none).
class BaudSearch {
public:
    /// `begin_with`: the first rate to listen at (the one that was right the last time, say); a rate that is
    /// not searched stands for the highest. The first dwell begins with the first call that has the time.
    BaudSearch(const BaudSearchSettings& settings, Baud begin_with);

    /// The UART is another one from now on. Precondition: as of the settings. A rate that is none of them is
    /// left at once.
    void set_rates(const std::bitset<kBauds.size()>& rates);
    /// `good` characters came without and `bad` ones with a parity or framing error.
    void on_characters(std::size_t good, std::size_t bad, Instant at);
    /// An error-free SD1, SD2 or SD3 from any station; `to_us`: its DA is one of our addresses. Never SD4 or
    /// SC: those have no checksum.
    void on_telegram(bool to_us, Instant at);
    /// The state of our slaves: whether any is parameterised, and any with its watchdog on.
    void on_supervision(bool any_owned, bool any_supervised, Instant at);
    void on_time(Instant now);

    Instant next_deadline() const { return deadline_; } ///< kNever in DP_Control
    Baud baud() const { return baud_; }
    BaudState state() const { return state_; }
    /// T_BC has expired in Baud_Control: the search listens again, for one dwell at the rate it had found.
    /// Requests are answered meanwhile; the state changes only when the rate is left.
    bool in_doubt() const { return in_doubt_; }

private:
    void begin_if_new(Instant at);
    void search(Baud baud, Instant at);
    void control(Instant at);
    void doubt(Instant at);
    void listen(Instant at);
    Baud next_rate() const;

    BaudSearchSettings settings_;
    Baud baud_;
    BaudState state_ = BaudState::baud_search;
    bool begun_ = false;
    bool in_doubt_ = false;
    bool any_owned_ = false;
    bool any_supervised_ = false;
    Instant deadline_{}; // at once: the first call of on_time() begins the first dwell
    std::uint32_t characters_ = 0;
    std::uint32_t bad_ = 0;
};

} // namespace dpslave::fdl
