// SPDX-License-Identifier: Apache-2.0
/// A tty as the serial line of a drive back-end. When the port vanishes the drives on it are silent; it is
/// opened again with back-off.
#pragma once

#include "app/limited_log.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/drive/serial_line.hpp"
#include "dpslave/io/port.hpp"

#include <atomic>

namespace dpslave::app {

class TtyLine final : public drive::SerialLine {
public:
    /// `port` is open. `is_open` says when it goes and returns, for the main thread; it outlives the line.
    TtyLine(io::Port port, std::atomic<bool>& is_open);

    bool write(Bytes octets) override;
    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override;
    Instant now() const override;
    void discard() override;

    int fd() { return port_.is_open() ? port_.tty().fd() : -1; } ///< -1: the port is gone

private:
    bool ready();
    void lose();

    io::Port port_;
    std::atomic<bool>& is_open_;
    LimitedLog log_;
};

} // namespace dpslave::app
