// SPDX-License-Identifier: Apache-2.0
/// Drives that speak Modbus RTU, all on one serial port.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/drive/wire_time.hpp"
#include "dpslave/io/switched_port.hpp"
#include "dpslave/modbus/modbus_client.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dpslave::modbus {

struct RtuSettings {
    std::string port;          ///< path of the tty
    std::uint32_t baud = 9600; ///< bit/s
    int data_bits = 8;
    char parity = 'N'; ///< 'N', 'E', 'O'
    int stop_bits = 1;
    /// The time from the end of a request until its answer has to be there; the time of its characters on the
    /// line is not counted. It has to be longer than the slowest answer of the drive.
    std::chrono::milliseconds timeout{600};
    drive::WireTime wire_time = drive::WireTime::automatic;
    drive::LineTiming rules{}; ///< hold_back: that of the port comes on top
    /// The time until the first attempt to open a port that vanished; later attempts wait longer (io::Port).
    std::chrono::milliseconds reopen_after{500};
    io::TransceiverSettings transceiver{}; ///< of a two-wire line
};

/// Something that happened to the port, a sentence with its path for the log.
struct PortMessage {
    bool is_trouble = false; ///< else it is good again
    std::string text;
};

class RtuLine;

/// The port and the client on it.
class ModbusRtu final : public drive::Backend {
public:
    /// Opens the port. The error is a sentence for the log with path, reason and what to do. `is_open`
    /// says when the port vanishes and returns in service; it outlives the back-end.
    static Result<std::unique_ptr<ModbusRtu>, std::string> open(const RtuSettings& settings,
                                                                std::atomic<bool>& is_open);
    ~ModbusRtu() override;
    /// The drives from now on.
    void set_units(std::vector<ModbusDrive> units) { client_->set_units(std::move(units)); }

    static drive::BlockRule block_rule(const RtuSettings& settings);
    drive::BlockRule block_rule() const override { return client_->block_rule(); }
    AccessError read(drive::UnitAddress unit, const drive::Tag& tag, std::span<std::uint16_t> words) override
    {
        return client_->read(unit, tag, words);
    }
    AccessError write(drive::UnitAddress unit, const drive::Tag& tag,
                      std::span<const std::uint16_t> words) override
    {
        return client_->write(unit, tag, words);
    }
    bool has_sent() const override { return client_->has_sent(); }
    AccessError probe(drive::UnitAddress unit) override { return client_->probe(unit); }
    drive::Sight look(drive::UnitAddress unit, const drive::Look& what) override
    {
        return client_->look(unit, what);
    }
    std::string last_trouble() const override; ///< also: "/dev/ttyS2 has gone"
    drive::AnswerCounts counts(drive::UnitAddress unit) const override { return client_->counts(unit); }
    std::string_view last_answer() const override { return client_->last_answer(); }
    void listen() override { client_->listen(); }

    /// Returns what happened to the port since the last call, oldest first. A port that comes and goes has
    /// them without end: the log has to limit them.
    std::vector<PortMessage> take_port_messages();
    int fd() const; ///< -1: the port is gone
    io::SwitchedPort& port();
    /// The port has stalled: what it has not sent is discarded, and it is opened again. What units owe stays.
    void reopen();

private:
    ModbusRtu(const RtuSettings& settings, std::unique_ptr<RtuLine> line);

    std::unique_ptr<RtuLine> line_;
    std::unique_ptr<ModbusClient> client_;
};

} // namespace dpslave::modbus
