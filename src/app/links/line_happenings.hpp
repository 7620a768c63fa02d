// SPDX-License-Identifier: Apache-2.0
/// What happens at a drive line, told once by whoever knows it, drive -> main. The main thread has the log,
/// the events and the incidents.
#pragma once

#include "app/log/severity.hpp"

#include "dpslave/base/ring.hpp"
#include "dpslave/base/units.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dpslave::app {

struct LineHappening {
    enum class Kind : std::uint8_t {
        answers,      ///< a drive answers, for the first time or again
        silent,       ///< a drive does not answer any more
        port_missing, ///< the port of the line is gone, or cannot be opened
        ride_through, ///< what a drive makes of a master that is lost or back
        other,
    };
    Kind kind = Kind::other;
    Severity severity = Severity::info;
    std::uint32_t station = 0;    ///< DriveUnit::number; 0: of the line
    std::array<char, 40> key{};   ///< ends with NUL: what makes them equal; empty: the text
    std::array<char, 384> text{}; ///< ends with NUL: a sentence
};

class LineHappenings {
public:
    using Kind = LineHappening::Kind;

    /// What is too long is cut. Where the main thread does not keep up, it is told how many are lost.
    void tell(Severity severity, std::uint32_t station, std::string_view text, Kind kind = Kind::other,
              std::string_view key = {});

    std::optional<LineHappening> take() noexcept { return ring_.pop(); } ///< main thread

private:
    Ring<LineHappening, 128> ring_; ///< each drive of a line may have one at the same moment
    std::uint64_t lost_ = 0;        ///< since the last one that found room
};

} // namespace dpslave::app
