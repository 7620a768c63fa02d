// SPDX-License-Identifier: Apache-2.0
/// Drives that speak Modbus RTU, all on one serial line. Tag = register, no offset (rows C-128), unless
/// its row names another register; words travel as the drive has them, only those of the IEEE area are
/// converted. Source: EI-ASCII and Modbus reference, sections 4 to 6; MODBUS Application Protocol V1.1b3.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/drive/backend.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace dpslave::modbus {

struct RtuSettings {
    std::string port;          ///< path of the tty
    std::uint32_t baud = 9600; ///< bit/s
    int data_bits = 8;
    char parity = 'N'; ///< 'N', 'E', 'O'
    int stop_bits = 1;
    /// From the end of a request until its answer has to be there, the time of its characters on the line not
    /// counted. Has to be longer than the slowest answer of the drive; one up to twice as late is still known
    /// as late.
    std::chrono::milliseconds timeout{600};
    /// Until the first attempt to open a port that vanished; later ones wait longer (io::Port).
    std::chrono::milliseconds reopen_after{500};
};

class RtuLine;

/// A call is one exchange and takes at most one response time-out and the time of its characters. After a
/// call without an answer the next one to the same unit first waits until the late answer has passed, one
/// further time-out at most: Modbus has nothing in an answer that tells which request it belongs to.
class ModbusRtu final : public drive::Backend {
public:
    /// Opens the port. The error is a sentence for the log with path, reason and what to do. `is_open`
    /// is told when the port vanishes and returns in service; it outlives the back-end.
    static Result<std::unique_ptr<ModbusRtu>, std::string> open(const RtuSettings& settings,
                                                                std::atomic<bool>& is_open);
    ~ModbusRtu() override;

    /// As many registers as every frame of 256 octets holds, and gaps as long as reading over them is cheaper
    /// than a request of its own at this rate.
    static drive::BlockRule block_rule(const RtuSettings& settings);
    drive::BlockRule block_rule() const override { return block_rule(settings_); }

    /// Function 3. A number of the IEEE area is scaled by the row's decimals and rounded to nearest, ties
    /// away from zero.
    AccessError read(drive::UnitAddress unit, const drive::Tag& tag, std::span<std::uint16_t> words) override;

    /// One word: function 6, whose answer is sure. Several words and the IEEE area, which refuses function 6:
    /// function 16; there the drive may accept a register that it does not have, and drop the value in
    /// silence.
    AccessError write(drive::UnitAddress unit, const drive::Tag& tag,
                      std::span<const std::uint16_t> words) override;

    /// Reads register 1; an exception is an answer as well.
    bool probe(drive::UnitAddress unit) override;

    std::string last_trouble() const override { return trouble_; } ///< "exception 2 (illegal data address)"

private:
    ModbusRtu(const RtuSettings& settings, std::unique_ptr<RtuLine> line);
    struct Reply;
    Reply ask(drive::UnitAddress unit, std::span<const std::uint8_t> request);
    AccessError read_ieee(drive::UnitAddress unit, const drive::Tag& tag, std::uint16_t& word);
    AccessError write_single(drive::UnitAddress unit, const drive::Tag& tag, std::uint16_t word);

    RtuSettings settings_;
    std::unique_ptr<RtuLine> line_;
    std::string trouble_;
};

} // namespace dpslave::modbus
