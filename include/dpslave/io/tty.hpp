// SPDX-License-Identifier: Apache-2.0
/// A serial port: raw octets at any rate, read without waiting. It does not interpret the octets. Source:
/// wire reference 11.1 and 11.4.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/io/changed_settings.hpp"
#include "dpslave/io/fd.hpp"

#include <bitset>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

namespace dpslave::io {

struct TtySettings {
    std::uint32_t baud = 0;   ///< bit/s, any number: what the UART makes of it is read back and judged
    int data_bits = 8;        ///< 7 or 8
    char parity = 'E';        ///< 'N', 'E', 'O'
    int stop_bits = 1;        ///< 1 or 2
    bool mark_errors = false; ///< report bad characters (parity, framing, break) by Chunk::bad_character;
                              ///< without it one with wrong parity reads as 00
    bool drop_rts_at_close = true; ///< open(2) raises RTS; the kernel drops it at close, also after a kill
    bool prompt = false;           ///< read() gives every octet as soon as it has come: receive trigger 1
    bool receive_only = false;     ///< opened for reading: the kernel refuses each write
};

/// The result of one read.
struct Chunk {
    std::span<std::uint8_t> octets; ///< good characters, in the caller's buffer; empty if none has come
    bool bad_character = false;     ///< right after these octets the UART received a bad character
    bool more = false; ///< call read() again before acting on it: more octets have come already, or may have
};

/// The rates of PROFIBUS that a port can do.
struct TtyBauds {
    std::bitset<kBauds.size()> can; ///< by index_of()
    /// A sentence without the path about those that a search has to leave out (45.45 kbit/s is never
    /// searched); empty = none.
    std::string why_not;
};

/// Returns why `path` cannot be opened as a port, as far as the file system shows: it is not there, is a
/// plain file, or this user may not. The text is a sentence with what to do; nothing is opened and nothing is
/// changed on the line.
std::optional<std::string> port_trouble(const std::string& path);

class KeptSettings; // src/io/tty/kept_settings.hpp
struct Uart;        // src/io/tty/uart.hpp

class Tty {
public:
    /// Opens and sets `path`, exclusively: a second opener is refused. Octets that came before are discarded.
    /// The error is a sentence with path, reason and what to do. `sysfs`: where it lies.
    static Result<Tty, std::string> open(const std::string& path, const TtySettings& settings,
                                         const std::filesystem::path& sysfs = "/sys");

    Tty(Tty&&) noexcept;
    Tty& operator=(Tty&&) noexcept;
    ~Tty();

    int fd() const { return fd_.get(); }
    /// Returns why `prompt` was not fully reached, and what that costs: sentences without the path, for the
    /// log.
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Returns how long a received octet may stay in the port before read() gives it, as far as is known; a
    /// USB adapter keeps it for up to 16 ms unless its driver can shorten that. As it was when the port was
    /// opened.
    std::chrono::nanoseconds hold_back() const;
    bool is_pty() const;

    /// Changes the rate. Octets that were not sent or read yet are discarded, and so are those that come
    /// within two characters, which it waits for: the one under way is half of each rate. The error is a
    /// sentence without the path; then the rate is whatever the driver took. It allocates nothing if there is
    /// no error.
    std::optional<std::string> set_baud(std::uint32_t baud);
    /// Tries all of them and goes back to the present one. Octets that come meanwhile are lost.
    TtyBauds bauds();

    /// The RS-485 mode in force is wanted. Who sets it, or has found it right, says so.
    void keep_rs485_mode() const noexcept;
    /// Returns how the settings differ from those that open(), set_baud() and keep_rs485_mode() left: another
    /// program has changed them. nullopt: they do not, or the port has gone. It waits for nothing but the
    /// change itself, and allocates nothing.
    std::optional<ChangedSettings> changed_settings() const noexcept;
    /// Sets them again. If octets were harmed, those that have come are discarded, and what waits to be sent.
    /// An error: the driver does not take them.
    std::error_code set_again(const ChangedSettings& changed) noexcept;

    /// It never waits. `out` has at least one place. After a hang-up (cable of a USB adapter pulled, other
    /// end of a pty closed) it always returns an error code.
    Result<Chunk, std::error_code> read(std::span<std::uint8_t> out);

    /// Everything in one write(2). A driver that takes less is waited for, not longer than twice the time
    /// that the octets need on the line and 20 ms; then std::errc::timed_out, and the rest is not sent.
    std::error_code write(Bytes octets);

    /// Sends a reply: everything in one write(2), never waiting and never in two pieces, because a gap in a
    /// telegram is not allowed. Octets that the driver does not accept in one piece are discarded:
    /// std::errc::no_buffer_space.
    std::error_code send(Bytes telegram);

    /// Discards what was written and has not left the kernel. Returns true if there was something.
    bool discard_unsent();

    /// The same, without the question: a pty never says that there is something.
    void discard_output();

    /// Discards the octets that have come and were not read yet.
    std::error_code discard_input();

    /// Waits until read() has octets or an error, a hang-up included. Returns false if the time is over.
    bool wait_readable(std::chrono::nanoseconds timeout);

    /// Returns whether the last stop bit of the written octets has gone. It is nullopt if the driver does not
    /// know (a pty, most USB adapters); the driver is not asked again then.
    std::optional<bool> transmitter_empty() const;
    /// The cable of a USB adapter was pulled, the other end of a pty closed.
    bool hung_up() const;

private:
    struct Marked; // octets read but not given out yet
    Tty(Fd fd, const TtySettings& settings, std::unique_ptr<Uart> uart);
    Result<std::size_t, std::error_code> fetch(std::span<std::uint8_t> out);
    Result<Chunk, std::error_code> read_marked(std::span<std::uint8_t> out);

    Fd fd_;
    TtySettings settings_;
    std::unique_ptr<Uart> uart_;
    std::unique_ptr<KeptSettings> kept_;
    std::vector<std::string> warnings_;
    std::chrono::nanoseconds character_{};
    mutable bool reports_empty_ = true;
    std::unique_ptr<Marked> marked_; // only with mark_errors
};

} // namespace dpslave::io
