// SPDX-License-Identifier: Apache-2.0
/// The driver enable of the RS-485 transceiver. Active only while a reply is on the line; inactive at start,
/// at the end, and when the port is closed. Source: wire reference 11.3; rows.
///
/// After SIGKILL it is made inactive as follows. With `gpio`: by the next start, or by `dpslaved --release`,
/// which the service unit runs as ExecStopPost, because most chips keep the level of a line that was closed.
/// With `kernel`: by the UART's driver, at the end of what it still has to send. With `rts`: by the kernel,
/// as it closes the port; where RTS is low while sending, by `dpslaved --release`.
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
    /// Inverts the GPIO or RTS: RTS is asserted while sending, and with active_low it is not.
    bool active_low = false;
    /// Keeps the receiver on while sending with Direction::kernel, so that the echo of a reply is read (echo
    /// = "on"). If it is false the driver drops the echo.
    bool receive_own = false;
    friend bool operator==(const DriverEnableSettings&, const DriverEnableSettings&) = default;
};

class DriverEnable {
public:
    /// Takes nothing yet: with `gpio` it does not work until take().
    explicit DriverEnable(const DriverEnableSettings& settings);
    /// Takes the GPIO line, inactive, if there is one and it was not taken. The error is a sentence. It may
    /// block as long as opening a GPIO chip does.
    std::optional<std::string> take();
    /// Both. The error is a sentence.
    static Result<DriverEnable, std::string> open(const DriverEnableSettings& settings);
    /// Makes the line inactive that a killed program may have left active, and closes it. Call it at any
    /// time. `port`: its tty. The error is a sentence, for example that a program has the line.
    static std::optional<std::string> release(const DriverEnableSettings& settings, const std::string& port);

    DriverEnable(DriverEnable&&) noexcept;
    DriverEnable& operator=(DriverEnable&&) noexcept;
    ~DriverEnable(); ///< inactive

    /// The port was opened, for the first time or again: sets its part of the switching, reads back whether
    /// the driver took it, and leaves the line inactive. But for Direction::kernel it ends an RS-485 mode
    /// of the UART that another program has left. `port` stays where it is until detach(). The error
    /// is a sentence that says which ways this port could do; the port is then not fit to send.
    std::optional<std::string> attach(const Tty& port);
    /// Call it before the port is closed.
    void detach() noexcept;

    Direction direction() const noexcept;
    /// Returns true if set() has to be called around each reply; false if transceiver or kernel switch, and
    /// set() does nothing.
    bool by_hand() const noexcept;

    /// Call it before the first octet is written, and after the last stop bit has gone. It allocates nothing
    /// and makes one system call. An error of set(true): nothing may be sent. An error of either but
    /// resource_unavailable_try_again (the guard is at work): the chip has gone, see works().
    std::error_code set(bool sending, Instant now) noexcept;

    /// Returns false if an edge has failed; then nothing is sent until ready() says true. Any thread may ask.
    bool works() const noexcept;
    /// Returns true if it works, like Port::ready(). Otherwise it tries to get it back when the time for that
    /// has come: at once, then after 0.5, 1, 2, 4, 4 ... s. It may block as long as opening a GPIO chip does,
    /// and allocates. Another thread than that of set() may call it.
    bool ready(Instant now);
    /// Returns when ready() will try again; kNever while it works. Only the thread that calls ready() may
    /// ask.
    Instant next_try() const noexcept;

    /// Returns since when the line is active; nullopt if it is not. Any thread may ask.
    std::optional<Instant> active_since() const noexcept;
    /// Makes the line inactive if it has been active for longer than `limit`: another thread calls this when
    /// the bus thread hangs. Returns true if the line was active for that long and has been made inactive. It
    /// never waits for the thread that calls set().
    bool drop_if_stuck(Instant now, std::chrono::nanoseconds limit) noexcept;

    /// Direction::rts: the kernel raises RTS whenever another program opens the port. Makes the line inactive
    /// if it should be and is not. Returns true if it was not. The same thread as that of drop_if_stuck()
    /// calls it; it asks the driver of the UART, which of a USB adapter takes a millisecond.
    bool release_if_raised() noexcept;

    /// Finds out whether the line can be switched, and how long an edge takes (the median of several,
    /// measured without making the line active: the bus may be in use). Call it at start, after attach() and
    /// before the first set(). The error is a sentence.
    std::optional<std::string> self_check();
    /// Returns for the log, after self_check(): which way works, how long an edge takes, and which other ways
    /// the port could do.
    std::string in_words() const;
    /// Duration of an edge as self_check() measured it; 0 = not by hand, or not measured.
    std::chrono::nanoseconds edge_time() const noexcept;
    /// A sentence if the edge is slow at this rate: longer than two bit times of the eleven within which the
    /// line has to be released (A-027). The rest is for the wake-up of the thread.
    std::optional<std::string> doubt(Baud baud) const;

private:
    struct Held;
    std::unique_ptr<Held> held_;
};

} // namespace dpslave::io
