// SPDX-License-Identifier: Apache-2.0
/// The port of a drive line with the driver enable of its transceiver, which is active from before the first
/// bit of a request until after its last stop bit. It does the same as the bus, but the thread may wait: it
/// sends and then it receives.
#pragma once

#include "dpslave/base/transmission.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/port.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>

namespace dpslave::io {

/// Counts of a transceiver that the program switches. Any thread may read them.
struct TransceiverCounts {
    std::atomic<std::uint64_t> requests{0}; ///< sent with the driver active
    std::atomic<std::uint64_t> late{0};     ///< of these, released later than SwitchedPort::late_after()
    std::atomic<std::uint64_t> guarded{0};  ///< released by a guard: the UART never said that it was empty
    std::atomic<std::uint64_t> errors{0};   ///< edges that failed
    std::atomic<std::uint64_t> raised{0};   ///< by another program that opened the port, and released
};

struct TransceiverSettings {
    DriverEnableSettings driver{};
    /// SCHED_FIFO from the write to the release, where the program switches; 0: ordinary.
    int priority = 0;
    TransceiverCounts* counts = nullptr; ///< outlives the port; null: not counted
};

class SwitchedPort {
public:
    /// Takes the driver enable, opens `path` and joins them: all or nothing. The error is a sentence that
    /// says which of the two it was.
    static Result<SwitchedPort, std::string> open(std::string path, const TtySettings& settings,
                                                  const TransceiverSettings& transceiver,
                                                  std::chrono::nanoseconds first_wait = Port::kFirstWait);

    const std::string& path() const { return port_.path(); }
    bool is_open() const { return port_.is_open(); }
    /// Precondition: is_open(). Use it to read; write() is that of the port.
    Tty& tty() { return port_.tty(); }
    /// The last guard watches it.
    DriverEnable& driver() { return driver_; }
    /// The longest time that the driver may be kept active: twice the longest request of the line.
    std::chrono::nanoseconds guard() const { return times_.guard; }
    /// Returns how long after the last stop bit the driver may be released without being counted as late.
    std::chrono::nanoseconds late_after() const;

    /// Port::ready(); a driver enable that does not work is a port that is closed.
    bool ready(Instant now);
    /// It has gone. The driver is inactive.
    void lose(Instant now);
    /// Port::reopen(). The driver is inactive.
    void reopen(Instant now);
    /// Why it could not be opened again: a sentence with the path, each reason once.
    std::optional<std::string> take_trouble() { return port_.take_trouble(); }

    /// Writes like Tty::write(); what an earlier call left in the kernel is discarded first, for its time is
    /// over. If the program switches the transceiver it returns when the driver is
    /// inactive again. A driver enable that fails closes the port: is_open(), take_trouble(). An error of
    /// resource_unavailable_try_again: the guard is at work, and nothing was sent. operation_canceled:
    /// this_thread_may_write() says no, and nothing was sent. timed_out also where the thread has stalled
    /// meanwhile (io/thread_sign.hpp): what has left is not known.
    /// Precondition: is_open().
    std::error_code write(Bytes octets);

private:
    SwitchedPort(Port port, DriverEnable driver, const TransceiverSettings& settings);
    std::optional<std::string> join();
    std::error_code write_switched(Bytes octets);
    std::error_code switch_driver(bool active);
    void wait_until_gone(std::size_t octets);
    void release(bool is_sent);
    void refuse(const std::error_code& why);

    Port port_;
    DriverEnable driver_; ///< after port_: it ends while the port is open
    TransceiverSettings settings_;
    Transmission::Times times_;
    Transmission transmission_;
};

} // namespace dpslave::io
