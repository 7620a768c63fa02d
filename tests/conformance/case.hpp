// SPDX-License-Identifier: Apache-2.0
/// One case of conformance, and the list of all of them.
#pragma once

#include "bench.hpp"

#include <vector>

namespace conformance {

class SimulatedSlave;

struct Case {
    const char* name; ///< "C01_FdlStatusInEveryState": the line of section 10, and what is tried
    const char* asks; ///< what the standard asks, one sentence without a full stop
    void (*run)(Bench&) = nullptr;
    /// Instead of `run`: a case that needs the simulated clock.
    void (*run_simulated)(Bench&, SimulatedSlave&) = nullptr;
    const char* why_simulated = nullptr; ///< why the pty cannot judge it
    /// Why the case does not apply to a family; nothing: it does.
    const char* (*not_applicable)(const Family&) = nullptr;

    const char* why_not(const Family& family) const
    {
        return not_applicable != nullptr ? not_applicable(family) : nullptr;
    }
};

/// In the order of section 10.
const std::vector<Case>& cases();

// Its parts.
void add_fdl_cases(std::vector<Case>& all);
void add_corruption_cases(std::vector<Case>& all);
void add_start_up_cases(std::vector<Case>& all);
void add_exchange_cases(std::vector<Case>& all);
void add_watchdog_cases(std::vector<Case>& all);
void add_master_cases(std::vector<Case>& all);
void add_global_control_cases(std::vector<Case>& all);
void add_diagnosis_cases(std::vector<Case>& all);
void add_parameter_cases(std::vector<Case>& all);
void add_bus_cases(std::vector<Case>& all);
void add_device_cases(std::vector<Case>& all);
void add_data_cases(std::vector<Case>& all);

} // namespace conformance
