// SPDX-License-Identifier: Apache-2.0
/// A technology box on a simulated bus, and what its drive side last said.
#pragma once

#include "dp/bench.hpp"

#include "dpslave/tec/option_block.hpp"

#include <string>
#include <string_view>

namespace test {

class TecBench : public DpBench {
protected:
    TecBench() : DpBench(technology_box()) {}

    static std::string prm(std::string_view user) { return "88 14 01 0B 16 49 01 " + std::string{user}; }
    /// Tags 271, 269, 272 and 255 of the manual's example: written, read, both, read.
    void exchanges()
    {
        start_up(prm("00 00 00 01 0F 01 0D 01 10 00 FF"), "73 60 50 70 50");
        drive.known = drive.answers = true;
        drive.generation = generation();
        for (std::size_t i = 0; i < 4; ++i) drive.states[i] = dpslave::WordState::good;
    }
    /// The master's outputs for 271 and 272, behind the eight octets of Demand Data.
    void master_writes(std::string_view four_octets)
    {
        master.data_exchange("00 00 00 00 00 00 00 00 " + std::string{four_octets});
    }
    void master_lets_go() { master.set_prm("40 00 00 00 16 49 00"); }

    std::uint16_t int_diag(std::int32_t select) const
    {
        return dpslave::tec::int_diagnostic(select, seen(), drive);
    }

    dpslave::drive::DriveSnapshot drive;
};

} // namespace test
