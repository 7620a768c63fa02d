// SPDX-License-Identifier: Apache-2.0
#include "demand.hpp"

#include "dpsim/common/values.hpp"

#include <fmt/format.h>

#include <string_view>

namespace dpslave::sim {
namespace {

constexpr std::size_t kDemandOctets = 8;
constexpr std::uint16_t kTagField = 0x07FF;
constexpr std::uint16_t kRejectBase = 0x7000;

DemandCommand command_of(std::uint16_t register_1)
{
    return static_cast<DemandCommand>(register_1 >> 12);
}

bool is_extended(DemandCommand command)
{
    return command == DemandCommand::extended_read || command == DemandCommand::extended_write;
}

DemandRegisters registers_in(Bytes octets)
{
    return {be16(octets, 0), be16(octets, 2), be16(octets, 4), be16(octets, 6)};
}

} // namespace

bool has_demand(const MasterSettings& settings)
{
    return !settings.cfg.empty() && settings.cfg[0] == kDemandIdentifier;
}

std::size_t demand_octets(const MasterSettings& settings)
{
    return has_demand(settings) ? kDemandOctets : 0;
}

DemandRegisters registers_of(const DemandWords& order)
{
    const auto field = static_cast<unsigned>(order.command) << 12;
    if (is_extended(order.command)) return {static_cast<std::uint16_t>(field), order.tag, 0, order.value};
    return {static_cast<std::uint16_t>(field | (order.tag & kTagField)), 0, 0, order.value};
}

DemandWords read_demand(const DemandRegisters& request, const DemandRegisters& answer)
{
    if (is_extended(command_of(request[0]))) {
        const std::uint16_t wanted = request[1];
        if (answer[0] == static_cast<std::uint16_t>(kRejectBase + wanted))
            return {DemandCommand::reject, wanted, answer[3]};
        if (answer[0] == kRejectBase) return {DemandCommand::reject, answer[1], answer[3]};
        if (answer[0] == 0x1000 || answer[0] == request[0])
            return {DemandCommand::read, answer[1], answer[3]};
    }
    return {command_of(answer[0]), static_cast<std::uint16_t>(answer[0] & kTagField), answer[3]};
}

std::optional<DemandRegisters> demand_inputs(const Master& master)
{
    if (!has_demand(master.settings()) || master.inputs().size() < kDemandOctets) return std::nullopt;
    return registers_in(master.inputs());
}

std::optional<DemandWords> demand_answer(Master& master)
{
    const auto answer = demand_inputs(master);
    if (!answer) return std::nullopt;
    return read_demand(demand_outputs(master), *answer);
}

DemandRegisters demand_outputs(Master& master)
{
    return registers_in(master.outputs());
}

void set_demand_outputs(Master& master, const DemandRegisters& registers)
{
    Octets& out = master.outputs();
    for (std::size_t i = 0; i < registers.size(); ++i) {
        out[2 * i] = high(registers[i]);
        out[2 * i + 1] = low(registers[i]);
    }
}

std::string show_demand(const DemandWords& answer)
{
    constexpr std::array<std::string_view, 3> kErrors{"invalid tag number", "read-only parameter",
                                                      "value out of range"};
    switch (answer.command) {
        case DemandCommand::none: return "no command";
        case DemandCommand::reject:
            return fmt::format("tag {} rejected, {}: {}", answer.tag, answer.value,
                               answer.value < kErrors.size() ? kErrors[answer.value]
                                                             : "a code that the manual does not know");
        case DemandCommand::read: return fmt::format("tag {} = {}", answer.tag, show_word(answer.value));
        default:
            return fmt::format("command {} with tag {}, which is no answer",
                               static_cast<unsigned>(answer.command), answer.tag);
    }
}

std::string show_registers(const DemandRegisters& r)
{
    return fmt::format("{:04X} {:04X} {:04X} {:04X}", r[0], r[1], r[2], r[3]);
}

} // namespace dpslave::sim
