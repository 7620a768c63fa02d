// SPDX-License-Identifier: Apache-2.0
/// A judged line for tests that make one fault and say when.
#pragma once

#include "random_runs.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace dpslave::drive_line {

inline constexpr std::uint16_t kInput = 100, kOutput = 110;

/// Without faults.
inline Conditions calm(std::size_t drives)
{
    Conditions conditions;
    conditions.drives = drives;
    return conditions;
}

/// A line on which each master reads one tag and writes one.
template <class Line>
class LineBench {
public:
    template <class Make>
    LineBench(const Conditions& conditions, const Make& make, bool is_modbus) : conditions_(conditions)
    {
        add_drives(line, conditions_, is_modbus);
        for (SimulatedDrive& drive : line.drives) drive.has_loopback = drive.knows_identity = true;
        tables_ = tables_of(line);
        backend_ = make(line, conditions_);
        RunRules rules;
        rules.masters_act = false;
        rules.compare_outputs = is_modbus;
        run.emplace(line, *backend_, tables_, rules);
        for (std::size_t i = 0; i < conditions_.drives; ++i) {
            run->enter(i, {{kInput, true, false}, {kOutput, false, true}});
            run->change(i);
        }
    }
    std::uint16_t held(std::size_t drive = 0) { return line.drives[drive].find(kOutput)->now().word; }
    std::uint16_t wanted(std::size_t drive = 0) { return run->image(drive).words[1]; }
    /// The drive holds what its master wants and its input is good.
    bool works(std::size_t drive = 0)
    {
        const drive::DriveSnapshot& seen = run->seen(drive);
        return seen.answers && held(drive) == wanted(drive) && seen.states[0] == WordState::good;
    }
    /// How long it takes until then, at most `limit`.
    Time until_it_works(Time limit)
    {
        const Instant began = line.time;
        while (!works() && line.time < began + limit && !run->violation()) run->live(run->transactions() + 1);
        return line.time - began;
    }

private:
    Chance chance_{7};
    Conditions conditions_;
    std::vector<drive::TagTable> tables_;
    std::unique_ptr<drive::Backend> backend_;

public:
    Line line{conditions_.line, chance_};
    std::optional<LineRun> run;
};

} // namespace dpslave::drive_line
