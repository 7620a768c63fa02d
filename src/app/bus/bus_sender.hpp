// SPDX-License-Identifier: Apache-2.0
/// Replies onto the line: the driver on, the write, and the driver off again within one character after the
/// last stop bit. The bus thread's own; never waits longer than BusSender::kSpin. Source: wire reference 1.3,
/// 11.3; rows.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/fdl/transmission.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/tty.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace dpslave::app {

class BusSender {
public:
    /// A wait shorter than this is spun: a blocking wait takes longer.
    static constexpr std::chrono::microseconds kSpin{25};

    /// `driver` outlives the sender.
    explicit BusSender(io::DriverEnable& driver) : driver_(driver) {}

    /// Why a reply was not sent.
    enum class Unsent : std::uint8_t {
        no_driver, ///< the driver enable does not work
        too_late,  ///< its window closed while the driver was made active
        not_taken, ///< the port did not take it whole
        port_gone, ///< the port did not take it, and has gone
    };
    /// The reply leaves now and whole, if it can begin by `not_after`: an edge of the driver may take long.
    /// Gives the moment after the write.
    Result<Instant, Unsent> send(Bytes telegram, io::Tty& tty, Baud baud, Instant not_after);

    /// Whether the driver is active because of a reply that goes out.
    bool is_sending() const { return transmission_.is_running(); }
    /// When finish() has something to do; kNever = nothing goes out, or no driver is switched here.
    Instant next_deadline() const { return transmission_.ends_at(); }
    /// Makes the driver inactive if the reply is over, or will be within kSpin: that is spun for. Call it
    /// until is_sending() is false.
    void finish(const io::Tty& tty);
    /// Before the port is closed: the driver goes inactive at once, whatever is on its way.
    void abort();

    std::uint64_t write_errors() const { return write_errors_; }   ///< replies that the port did not accept
    std::uint64_t driver_errors() const { return driver_errors_; } ///< edges that failed
    std::uint64_t driver_guarded() const { return transmission_.guarded(); }

private:
    bool make_active(const io::Tty& tty);
    void make_inactive(Instant now);
    std::optional<bool> shift_register(const io::Tty& tty) const;

    io::DriverEnable& driver_;
    fdl::Transmission transmission_;
    std::uint64_t write_errors_ = 0;
    std::uint64_t driver_errors_ = 0;
};

} // namespace dpslave::app
