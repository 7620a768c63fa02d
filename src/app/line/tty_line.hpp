// SPDX-License-Identifier: Apache-2.0
/// A tty as the serial line of a drive back-end. When the port vanishes the drives on it are silent; it is
/// opened again with back-off.
#pragma once

#include "app/links/line_happenings.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/drive/serial_line.hpp"
#include "dpslave/drive/wire_time.hpp"
#include "dpslave/io/switched_port.hpp"

#include <atomic>

namespace dpslave::app {

class TtyLine final : public drive::SerialLine {
public:
    /// `port` is open. `is_open` says when it goes and returns, for the main thread, `happenings` in words;
    /// both outlive the line.
    TtyLine(io::SwitchedPort port, drive::WireTime wire_time, std::atomic<bool>& is_open,
            LineHappenings& happenings);

    bool write(Bytes octets) override;
    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override;
    Instant now() const override;
    void discard() override;
    bool takes_wire_time() const override { return takes_wire_time_; }
    bool may_have_left() const override { return may_have_left_; }

    io::SwitchedPort& port() { return port_; }
    /// The port has stalled: what it has not sent goes, and it is opened again.
    void reopen();
    int fd() { return port_.is_open() ? port_.tty().fd() : -1; } ///< -1: the port is gone

private:
    bool ready();
    void lose();

    io::SwitchedPort port_;
    drive::WireTime wire_time_;
    bool takes_wire_time_; ///< the port as it was opened last
    std::atomic<bool>& is_open_;
    LineHappenings& happenings_;
    bool may_have_left_ = false;
    bool is_untold_ = false; ///< the port is gone, and that was not told yet
};

} // namespace dpslave::app
