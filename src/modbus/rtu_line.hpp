// SPDX-License-Identifier: Apache-2.0
/// A serial line with Modbus RTU on it. libmodbus builds the requests; what comes is put together by
/// FrameReceiver; the port is opened and written by io, so that every port of the program is opened, locked,
/// judged, switched and lost alike.
#pragma once

#include "frame_receiver.hpp"

#include "dpslave/io/fd.hpp"
#include "dpslave/io/switched_port.hpp"
#include "dpslave/modbus/modbus_port.hpp"
#include "dpslave/modbus/modbus_rtu.hpp"

#include <modbus.h>

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::modbus {

/// Counts the bits from the start bit to the last stop bit.
int bits_of_a_character(const RtuSettings& settings);

class RtuLine final : public ModbusPort {
public:
    static Result<std::unique_ptr<RtuLine>, std::string> open(const RtuSettings& settings,
                                                              std::atomic<bool>& is_open);

    bool send(std::uint8_t unit, Bytes pdu) override;
    bool may_have_left() const override { return may_have_left_; }
    Heard receive(Instant until) override;
    Bytes frame() const override { return receiver_.frame(); }
    Piece piece() const override
    {
        return {.octets = receiver_.piece(),
                .flaw = receiver_.flaw(),
                .read_at = read_at_,
                .begun = receiver_.begun(character_),
                .noise = receiver_.noise()};
    }
    bool takes_wire_time() const override { return takes_wire_time_; }
    Instant now() const override;

    bool is_open() const { return port_.is_open(); }
    io::SwitchedPort& port() { return port_; }
    /// The port has stalled: what it has not sent goes, and it is opened again.
    void reopen();
    int fd() { return port_.is_open() ? port_.tty().fd() : -1; } ///< -1: the port is gone
    /// Returns what happened to the port since the last call, oldest first.
    std::vector<PortMessage> take_messages() { return std::exchange(messages_, {}); }
    const std::string& path() const { return settings_.port; }
    /// Returns how long the open port may keep octets back.
    std::chrono::nanoseconds hold_back() const { return hold_back_; }

private:
    struct FreeContext {
        void operator()(modbus_t* context) const { modbus_free(context); }
    };
    using Context = std::unique_ptr<modbus_t, FreeContext>;

    /// libmodbus writes into `in`, and what lies in `out` goes to the port.
    struct Pipe {
        io::Fd in, out;
    };
    RtuLine(RtuSettings settings, Context context, Pipe built, io::SwitchedPort port,
            std::atomic<bool>& is_open);

    Bytes build(std::uint8_t unit, Bytes pdu);
    bool ready();
    void use_port();
    void lose();
    Heard take_heard();
    bool fetch(Instant until);
    std::chrono::nanoseconds gap() const;
    Instant end_of_next() const;

    RtuSettings settings_;
    Context context_;
    Pipe built_;
    std::array<std::uint8_t, kLongestFrame> request_{};
    io::SwitchedPort port_;
    std::atomic<bool>& is_open_;
    std::vector<PortMessage> messages_;
    FrameReceiver receiver_;
    std::array<std::uint8_t, 256> buffer_{};
    std::chrono::nanoseconds character_; ///< its time on the line
    std::chrono::nanoseconds hold_back_{};
    bool may_have_left_ = false;
    bool takes_wire_time_ = false; ///< the open port
    Bytes heard_;                  ///< read and not yet put together
    bool bad_behind_ = false;      ///< directly after it a bad character
    Instant read_at_{};
};

} // namespace dpslave::modbus
