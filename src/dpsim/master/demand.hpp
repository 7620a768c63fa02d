// SPDX-License-Identifier: Apache-2.0
/// Demand Data in the image of the master: the first eight octets in both directions, if Cfg_Data begins with
/// 73h (HA389815 chapter 7; extended commands: 2408f/2404f handbook chapter 7).
#pragma once

#include "master.hpp"

#include <array>

namespace dpslave::sim {

/// Registers 1 to 4 of the manuals: command and tag, extended tag, reserved, value or error code.
using DemandRegisters = std::array<std::uint16_t, 4>;

enum class DemandCommand : std::uint8_t {
    none = 0,
    read = 1,
    write = 2,
    extended_read = 3,
    extended_write = 4,
    reject = 7
};

/// An order, or an answer: read is then done, reject rejected, and other commands are no answers.
struct DemandWords {
    DemandCommand command = DemandCommand::none;
    std::uint16_t tag = 0;   ///< up to 2047; of an extended command up to 16383
    std::uint16_t value = 0; ///< value, or error code with a reject
};

/// Returns the octets of the process image before the process words: 8, or 0 without Demand Data.
std::size_t demand_octets(const MasterSettings& settings);
bool has_demand(const MasterSettings& settings);

DemandRegisters registers_of(const DemandWords& order);
/// Returns what `answer` says to `request`. An extended command is answered with an empty tag field and the
/// tag in register 2, or as worked example 2 prints it: 3000h, and 7000h + tag.
DemandWords read_demand(const DemandRegisters& request, const DemandRegisters& answer);

/// Returns the registers as they came; nullopt before the first answer, or without Demand Data.
std::optional<DemandRegisters> demand_inputs(const Master& master);
std::optional<DemandWords> demand_answer(Master& master);
/// Precondition of both: has_demand().
DemandRegisters demand_outputs(Master& master);
void set_demand_outputs(Master& master, const DemandRegisters& registers);

std::string show_demand(const DemandWords& answer);
std::string show_registers(const DemandRegisters& registers); ///< "110E 0000 0000 0001"

} // namespace dpslave::sim
