// SPDX-License-Identifier: Apache-2.0
/// Clients that take the first answer that looks right, as most masters do: they forget a question as soon as
/// its time is over. On a calm line they work; the judge has to find violations on every other.
#pragma once

#include "random_runs.hpp"

#include "dpslave/drive/backend.hpp"

namespace dpslave::drive_line {

class UnjudgedEiClient final : public drive::Backend {
public:
    explicit UnjudgedEiClient(EiLine& line) : line_(line) {}
    drive::BlockRule block_rule() const override { return {}; }
    AccessError read(drive::UnitAddress unit, const drive::Tag& tag, std::span<std::uint16_t> words) override;
    AccessError write(drive::UnitAddress unit, const drive::Tag& tag,
                      std::span<const std::uint16_t> words) override;
    AccessError probe(drive::UnitAddress unit) override
    {
        return asked(unit, "V0").empty() ? AccessError::no_answer : AccessError::none;
    }
    std::string last_trouble() const override { return {}; }

private:
    /// What came until the timeout: one octet, or from STX to the block check; empty: nothing.
    std::string answer();
    std::string asked(drive::UnitAddress unit, const std::string& mnemonic);
    AccessError reason(drive::UnitAddress unit);

    EiLine& line_;
};

class UnjudgedModbusClient final : public drive::Backend {
public:
    explicit UnjudgedModbusClient(ModbusFrames& line) : line_(line) {}
    drive::BlockRule block_rule() const override { return {.max_tags = 8, .max_gap = 2, .max_written = 8}; }
    AccessError read(drive::UnitAddress unit, const drive::Tag& tag, std::span<std::uint16_t> words) override;
    AccessError write(drive::UnitAddress unit, const drive::Tag& tag,
                      std::span<const std::uint16_t> words) override;
    AccessError probe(drive::UnitAddress unit) override;
    std::string last_trouble() const override { return {}; }

private:
    /// An answer of this unit with this function, and so many octets; an exception has 2. Empty: none.
    Octets asked(drive::UnitAddress unit, const Octets& pdu, std::size_t length);

    ModbusFrames& line_;
};

std::unique_ptr<drive::Backend> unjudged_ei(EiLine& line, const Conditions&);
std::unique_ptr<drive::Backend> unjudged_modbus(ModbusFrames& line, const Conditions&);

} // namespace dpslave::drive_line
