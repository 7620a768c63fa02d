// SPDX-License-Identifier: Apache-2.0
/// The Modbus RTU master on one line with one or several drives. One attempt per call: the poller repeats.
/// It is pure: frames and times come from a ModbusPort.
/// Tag = register, no offset (rows C-128), unless its row names another register; words travel as the drive
/// has them, only those of the IEEE area are converted. Source: EI-ASCII and Modbus reference, sections 4 to
/// 6; MODBUS Application Protocol V1.1b3.
#pragma once

#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/line_timing.hpp"
#include "dpslave/modbus/modbus_port.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace dpslave::modbus {

/// One drive of the line and what it has beyond functions 3, 6 and 16 (profile: modbus_functions).
struct ModbusDrive {
    std::uint8_t unit = 1;     ///< 1..247
    bool reads_by_4 = false;   ///< function 4 reads what function 3 reads
    bool has_loopback = false; ///< function 8, sub code 0
};

struct ClientSettings {
    std::uint32_t baud = 9600;    ///< bit/s, not 0
    int bits_of_a_character = 10; ///< from the start bit to the last stop bit
    /// The time from the end of a request until its answer has to be there; the time of its characters on the
    /// line is not counted.
    std::chrono::milliseconds timeout{600};
    drive::LineTiming rules;
    std::vector<ModbusDrive> units; ///< one that is not among them has functions 3, 6 and 16 only
};

class ModbusClient final : public drive::Backend {
public:
    /// `line` outlives the client.
    ModbusClient(ModbusPort& line, ClientSettings settings);
    ~ModbusClient() override;
    /// The drives from now on.
    void set_units(std::vector<ModbusDrive> units);

    /// Returns as many registers as every frame of 256 octets holds, and gaps as long as reading over them is
    /// cheaper than a request of its own at this rate.
    static drive::BlockRule block_rule(std::uint32_t baud, int bits_of_a_character);
    drive::BlockRule block_rule() const override;

    /// Function 3, or 4. A number of the IEEE area is scaled by the row's decimals and rounded to nearest,
    /// ties away from zero.
    AccessError read(drive::UnitAddress unit, const drive::Tag& tag, std::span<std::uint16_t> words) override;

    /// One word: function 6, whose answer is sure. Several words and the IEEE area, which refuses function 6:
    /// function 16; there the drive may accept a register that it does not have, and drop the value
    /// without an error.
    AccessError write(drive::UnitAddress unit, const drive::Tag& tag,
                      std::span<const std::uint16_t> words) override;

    bool has_sent() const override { return has_sent_; }

    /// Any valid frame of this unit counts, an exception as well.
    AccessError probe(drive::UnitAddress unit) override;

    /// One register by function 3.
    drive::Sight look(drive::UnitAddress unit, const drive::Look& what) override;

    std::string last_trouble() const override { return trouble_; } ///< "exception 2 (illegal data address)"

    std::string_view last_answer() const override { return denial_; }

    drive::AnswerCounts counts(drive::UnitAddress unit) const override;
    void listen() override;

private:
    class Exchange;
    /// Registers from the first on, which a unit is asked for at once.
    struct Block {
        std::uint8_t unit = 0;
        std::uint16_t first = 0;
        std::uint16_t count = 1;
        friend auto operator<=>(const Block&, const Block&) = default;
    };
    /// The result of a question; `answer` is empty unless there is one without exception.
    struct Reply {
        AccessError error = AccessError::none; ///< no_answer, deferred; none: there is an answer
        std::optional<std::uint8_t> exception;
        Bytes answer;
    };

    bool has_address(std::uint8_t unit);
    Reply ask(std::uint8_t unit, Bytes request);
    Reply ask_for(const Block& block);
    Reply ask_to_write(std::uint8_t unit, Bytes request);
    std::optional<std::uint8_t> function_for(const Block& block);
    AccessError clear(std::uint8_t unit);
    AccessError loop_back(std::uint8_t unit);
    AccessError read_ieee(std::uint8_t unit, const drive::Tag& tag, std::uint16_t& word);
    AccessError write_single(std::uint8_t unit, const drive::Tag& tag, std::uint16_t word);
    ModbusDrive functions_of(std::uint8_t unit) const;

    ClientSettings settings_;
    std::unique_ptr<Exchange> exchange_;
    std::set<Block> gave_data_;                    ///< and were not refused since
    std::map<std::uint8_t, int> silent_loopbacks_; ///< in a row
    std::uint16_t token_ = 0;
    std::string trouble_;
    bool has_sent_ = false;
    std::string denial_; ///< the exception of the last read of a single tag
};

} // namespace dpslave::modbus
