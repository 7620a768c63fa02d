// SPDX-License-Identifier: Apache-2.0
/// What the bench of the bus thread measures. Each measurement starts its own responders, and throws where
/// one of them does not work.
#pragma once

#include "rows.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/io/clock.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dpslave::bench {

struct Setup {
    std::filesystem::path daemon;
    std::filesystem::path dpctl;
    std::filesystem::path profiles;
    std::uint32_t seed = 1; ///< of every order that is drawn
    bool quick = false;     ///< one small block: whether it works
    bool gpio = false;      ///< with a driver enable: a stand-in whose edges cost a system call each
    int cpu = -1;           ///< the processor of the responders; -1: the machine has only one

    Instant limit = kNever; ///< no further block begins then: the machine is too slow for all of them

    std::size_t blocks() const { return quick ? 1 : kBlocks; }
    /// Whether one more block is to be measured after `done` of them.
    bool goes_on(std::size_t done) const
    {
        return done == 0 || (done < blocks() && io::monotonic_now() < limit);
    }
    std::size_t telegrams(std::size_t in_full) const { return quick ? 100 : in_full; }
};

struct Findings {
    std::vector<Row> rows;
    nlohmann::json curves = nlohmann::json::object();
    std::vector<std::string> notes{}; ///< for information, a line each
};

/// No station may answer earlier: 11 bit times at 1.5 Mbit/s (wire reference 1.3). Both the daemon and the
/// null responder spin for so long.
inline constexpr std::chrono::nanoseconds kMinTsdr = duration_of(Tbit{11}, Baud::k1500);

/// M1 to M3 and M8: the daemon against the null responder, telegram by telegram, and without a pause.
Findings measure_turnaround(const Setup& setup);
/// The turnaround with a driver enable by GPIO; nothing else is judged.
Findings measure_driver_enable(const Setup& setup);
/// M4: what a request to another station costs.
Findings measure_other_station(const Setup& setup);
/// M5: 32 stations against one.
Findings measure_many_stations(const Setup& setup);
/// M9: with callers of the control socket, against a stranger that needs as much of the machine.
Findings measure_callers(const Setup& setup);
/// M13: the recorder and who reads it, against a daemon without one and a stranger likewise.
Findings measure_watchers(const Setup& setup);

} // namespace dpslave::bench
