// SPDX-License-Identifier: Apache-2.0
/// Which drive lines stall, each told once. A line that stalls cannot say so itself.
#pragma once

#include "app/line/drive_line.hpp"
#include "app/state/station.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dpslave::app {

class StalledLines {
public:
    struct News {
        std::shared_ptr<DriveLine> line;
        std::string text;
        bool is_over = false; ///< it goes round again
    };
    /// What has changed since the last call. `stations`: as Monitor::refresh() has them.
    std::vector<News> look(const std::vector<Station>& stations);

private:
    std::vector<std::shared_ptr<DriveLine>> told_;
};

/// "line p3 has stalled in write for 4.4 s, and it is not known whether these outputs have their safe state:
/// tag 56, 57 of unwinder": a line that hangs at the end, with the outputs that the master has chosen last.
std::string words_of_hanging(const DriveLine& line, std::span<const Station> stations, Instant now);

/// A happening of the line that says so: its drives count as lost.
LineHappening stall_happening(const std::string& text);

} // namespace dpslave::app
