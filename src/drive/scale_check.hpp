// SPDX-License-Identifier: Apache-2.0
/// The registers in which an instrument says how it gives its values: they are read before the
/// exchange and after the drive was lost, and again while one contradicts the station. Pure.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <optional>
#include <vector>

namespace dpslave::drive {

class ScaleCheck {
public:
    explicit ScaleCheck(const std::vector<ScaleRegister>& registers);

    /// All are to be read: a layout begins, or the drive is back. `is_used`: something depends on them.
    void begin(bool is_used);
    /// Other settings, while the rest goes on: what is known of the same register stays.
    void exchange(const std::vector<ScaleRegister>& registers);

    std::optional<std::uint16_t> next(Instant now) const; ///< the tag to be read now
    Instant next_due() const;
    /// Takes the result of that read; not for no_answer. Returns true if the set of contradicted tags has
    /// changed.
    bool done(std::uint16_t tag, const Outcome& outcome, Instant now);
    /// The drive was lost on it. The second time in a row it counts as a register that is not there.
    void lost_on(std::uint16_t tag);

    /// Each was read, or denied, or is silent: what is not known holds nothing.
    bool is_over() const;
    /// The first that contradicts.
    std::optional<ScaleFault> fault() const;
    /// Is the scale of this tag another one than the station says?
    bool contradicts(const Tag& row) const;

private:
    struct State {
        ScaleRegister reg;
        bool is_known = false;                      ///< since begin()
        std::optional<std::uint16_t> contradicts{}; ///< by this word
        int lost_on = 0, busy = 0;                  ///< in a row
        Instant retry_at{};                         ///< a moment that has passed: now
    };
    State* find(std::uint16_t tag);
    bool is_due(const State& one, Instant now) const;

    std::vector<State> registers_;
    bool is_used_ = false;
};

/// Does it concern this tag?
bool concerns(const ScaleRegister& reg, const Tag& row);

} // namespace dpslave::drive
