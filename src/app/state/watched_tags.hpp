// SPDX-License-Identifier: Apache-2.0
/// The tags of a drive that are read for diagnosis and lamps: the last word that was read of each stands
/// while the drive is lost. Pure.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <cstdint>
#include <vector>

namespace dpslave::app {

class WatchedTags {
public:
    struct Seen {
        std::uint16_t tag = 0;
        std::uint16_t word = 0;
        bool was_read = false;
        bool is_current = false;
    };

    /// In the order of StationConfig::watched, from now on. What is known of a tag that stays is kept.
    void watch(const std::vector<std::uint16_t>& tags);
    void update(const drive::DriveSnapshot& drive);

    /// Null: it is not watched.
    const Seen* find(std::uint16_t tag) const;
    /// 0: it was not read yet, or is not watched.
    std::uint16_t word_of(std::uint16_t tag) const;

private:
    std::vector<Seen> seen_;
};

} // namespace dpslave::app
