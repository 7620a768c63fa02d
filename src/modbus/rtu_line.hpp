// SPDX-License-Identifier: Apache-2.0
/// A serial line with Modbus RTU on it. libmodbus builds and sends the requests; what comes is put together
/// by FrameReceiver; the port is opened by io, so that every port of the program is opened, locked, judged
/// and lost alike.
#pragma once

#include "frame_receiver.hpp"

#include "dpslave/io/port.hpp"
#include "dpslave/modbus/frame_line.hpp"
#include "dpslave/modbus/modbus_rtu.hpp"

#include <modbus.h>

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::modbus {

/// From the start bit to the last stop bit.
int bits_of_a_character(const RtuSettings& settings);

class RtuLine final : public FrameLine {
public:
    static Result<std::unique_ptr<RtuLine>, std::string> open(const RtuSettings& settings,
                                                              std::atomic<bool>& is_open);

    bool send(std::uint8_t unit, Bytes pdu) override;
    Heard receive(Instant until) override;
    Bytes frame() const override { return receiver_.frame(); }
    Piece piece() const override
    {
        return {.octets = receiver_.piece(), .flaw = receiver_.flaw(), .read_at = read_at_};
    }
    Instant now() const override;

    bool is_open() const { return port_.is_open(); }
    int fd() { return port_.is_open() ? port_.tty().fd() : -1; } ///< -1: the port is gone
    /// What happened to the port since the last call, oldest first.
    std::vector<PortMessage> take_messages() { return std::exchange(messages_, {}); }
    const std::string& path() const { return settings_.port; }
    /// How long the open port may keep octets back.
    std::chrono::nanoseconds hold_back() const { return hold_back_; }

private:
    struct FreeContext {
        void operator()(modbus_t* context) const { modbus_free(context); }
    };
    using Context = std::unique_ptr<modbus_t, FreeContext>;

    RtuLine(RtuSettings settings, Context context, io::Port port, std::atomic<bool>& is_open);

    bool ready();
    void use_port();
    void lose();
    Heard take_heard();
    bool fetch(Instant until);
    std::chrono::nanoseconds gap() const;

    RtuSettings settings_;
    Context context_;
    io::Port port_;
    std::atomic<bool>& is_open_;
    std::vector<PortMessage> messages_;
    FrameReceiver receiver_;
    std::array<std::uint8_t, 256> buffer_{};
    std::chrono::nanoseconds hold_back_{};
    Bytes heard_;             ///< read and not yet put together
    bool bad_behind_ = false; ///< right behind it a bad character
    Instant read_at_{};
};

} // namespace dpslave::modbus
