// SPDX-License-Identifier: Apache-2.0
/// The driver enable of the RS-485 transceiver. Active only while a reply is on the line; inactive at start,
/// at the end, and when the port is closed. Source: wire reference 11.3; rows.
///
/// What makes it inactive after SIGKILL: with `gpio` the next start, or `dpslaved --release`, which the
/// service unit runs as ExecStopPost, for most chips keep the level of a line that was closed. With `kernel`
/// the UART's driver, at the end of what it still has to send. With `rts` the kernel, as it closes the port;
/// where RTS is low while sending, `dpslaved --release`.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace dpslave::io {

class Tty;

enum class Direction : std::uint8_t {
    none,   ///< the transceiver switches by itself
    gpio,   ///< the program, by a line of a GPIO chip
    kernel, ///< the UART's driver, by TIOCSRS485
    rts,    ///< the program, by the RTS line of the port
};
std::string_view text(Direction direction) noexcept;

struct DriverEnableSettings {
    Direction direction = Direction::none;
    std::string gpio_chip{}; ///< with Direction::gpio, as GpioRequest has it
    unsigned gpio_line = 0;
    /// Of the GPIO, or of RTS: RTS is asserted while sending, and with active_low it is not. (The pin of a
    /// bare UART is low while RTS is asserted.)
    bool active_low = false;
    /// With Direction::kernel: the receiver stays on while sending, so that the echo of a reply is read
    /// (echo = "on"). Off: the driver drops it.
    bool receive_own = false;
    friend bool operator==(const DriverEnableSettings&, const DriverEnableSettings&) = default;
};

class DriverEnable {
public:
    /// Takes the GPIO line, inactive, if there is one. The error is a sentence.
    static Result<DriverEnable, std::string> open(const DriverEnableSettings& settings);
    /// After a program that was killed: makes the line inactive that it may have left active, and closes it.
    /// At any time. `port`: the PROFIBUS tty. The error is a sentence, for example that a program has the
    /// line.
    static std::optional<std::string> release(const DriverEnableSettings& settings, const std::string& port);

    DriverEnable(DriverEnable&&) noexcept;
    DriverEnable& operator=(DriverEnable&&) noexcept;
    ~DriverEnable(); ///< inactive

    /// The port was opened, for the first time or again: sets its part of the switching, reads back whether
    /// the driver took it, and leaves the line inactive. `port` stays where it is until detach(). The error
    /// is a sentence that says which ways this port could do; the port is then not fit to send.
    std::optional<std::string> attach(const Tty& port);
    /// Before the port is closed.
    void detach() noexcept;

    /// True: set() has to be called around each reply. False: transceiver or kernel switch, and set() does
    /// nothing.
    bool by_hand() const noexcept;

    /// Before the first octet is written, and after the last stop bit has gone. No allocation; one system
    /// call. An error of set(true): nothing may be sent. An
    /// error of either but resource_unavailable_try_again (the guard is at work): the chip has gone, see
    /// works().
    std::error_code set(bool sending, Instant now) noexcept;

    /// False: an edge has failed. Nothing is sent until ready() says true. Any thread may ask.
    bool works() const noexcept;
    /// Like Port::ready(), for the thread that calls set(): true where it works. Where it does not, tries to
    /// get it back when the time for that has come: at once, then after 0.5, 1, 2, 4, 4 ... s. It may block
    /// as long as opening a GPIO chip does, and allocates: not between a request and its reply.
    bool ready(Instant now);
    /// When ready() will try again; kNever while it works. For the thread that calls ready().
    Instant next_try() const noexcept;

    /// Since when the line is active; nothing = it is not. Any thread may ask.
    std::optional<Instant> active_since() const noexcept;
    /// For another thread, when the bus thread hangs: makes the line inactive if it has been active for
    /// longer than `limit`. True: it had been, and is not any more. Never waits for the thread that calls
    /// set().
    bool drop_if_stuck(Instant now, std::chrono::nanoseconds limit) noexcept;

    /// At start, after attach() and before the first set(): whether the line can be switched, and how long an
    /// edge takes (the median of several, measured without making the line active: the bus may be in use).
    /// The error is a sentence.
    std::optional<std::string> self_check();
    /// For the log, after self_check(): which way works, how long an edge takes, and which other ways the
    /// port could do.
    std::string in_words() const;
    /// Duration of an edge as self_check() measured it; 0 = not by hand, or not measured.
    std::chrono::nanoseconds edge_time() const noexcept;
    /// A sentence if the edge is slow at this rate: longer than two bit times of the eleven within which the
    /// line has to be released (A-027). The rest is for the wake-up of the thread.
    std::optional<std::string> doubt(Baud baud) const;

private:
    struct Held;
    explicit DriverEnable(std::unique_ptr<Held> held);
    std::unique_ptr<Held> held_;
};

} // namespace dpslave::io
