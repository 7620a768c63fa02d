// SPDX-License-Identifier: Apache-2.0
/// A serial port that is opened again, with back-off, after it has vanished: the one place where that is
/// done, for the bus, EI-ASCII and Modbus alike.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/io/tty.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace dpslave::io {

class Port {
public:
    static constexpr std::chrono::milliseconds kFirstWait{500};

    /// Opens `path`; the error is Tty::open's sentence.
    static Result<Port, std::string> open(std::string path, const TtySettings& settings,
                                          std::chrono::nanoseconds first_wait = kFirstWait);
    /// A port that is not open yet: the first ready() tries.
    Port(std::string path, const TtySettings& settings, std::chrono::nanoseconds first_wait = kFirstWait);

    const std::string& path() const { return path_; }
    bool is_open() const { return tty_.has_value(); }
    /// A moment before it was opened last, with nothing in it yet. Instant{}: it was never open.
    Instant opened() const { return opened_; }
    /// Precondition: is_open().
    Tty& tty() { return *tty_; }

    /// Returns true if it is open; false if its time to be tried again has not come, or it could not be
    /// opened. The waits are the first one, twice, four and then always eight times it: 0.5, 1, 2, 4, 4 ...
    /// s. It may block as long as open(2) does, and allocates.
    bool ready(Instant now);
    /// Closes it: it has gone. The waits begin anew if it was open for as long as the
    /// longest of them.
    void lose(Instant now);
    /// Closes it without what it has not sent yet; ready() opens it again at once.
    void reopen(Instant now);
    /// Closes it: it can be opened, and is of no use for the reason `why`, a sentence with the path. The
    /// waits go on to grow.
    void refuse(Instant now, std::string why);
    /// Why it could not be opened again, or was refused: a sentence with the path. Returns each reason once,
    /// until it has changed or the port was lost anew; nullopt if there is none, or it was given out.
    std::optional<std::string> take_trouble();
    /// Returns when ready() will try again; kNever while it is open.
    Instant next_try() const { return next_try_; }
    /// The rate from now on, also after it was opened again; Tty::set_baud() where it is open. The error is a
    /// sentence with the path.
    std::optional<std::string> set_baud(std::uint32_t baud);
    const TtySettings& settings() const { return settings_; }

private:
    void wait(Instant now);
    void note(std::string why);

    std::string path_;
    TtySettings settings_;
    std::chrono::nanoseconds first_wait_;
    std::optional<Tty> tty_;
    Instant next_try_{}; ///< at once
    Instant opened_{};
    unsigned failures_ = 0;
    std::string trouble_; ///< the newest; empty = none since the port was lost
    bool trouble_is_new_ = false;
};

} // namespace dpslave::io
