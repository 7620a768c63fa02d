// SPDX-License-Identifier: Apache-2.0
/// Which drive lines stall, each told once. A line that stalls cannot say so itself.
#pragma once

#include "app/line/drive_line.hpp"
#include "app/state/station.hpp"

#include <memory>
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

/// A happening of the line that says so: its drives count as lost.
LineHappening stall_happening(const std::string& text);

} // namespace dpslave::app
