// SPDX-License-Identifier: Apache-2.0
/// The test's side of a record of replies.
#pragma once

#include "record.hpp"

#include <chrono>
#include <filesystem>

namespace dpslave::reply_watch {

class Watch {
public:
    /// Makes the file `record`, which the daemon's environment names (kVariable). Until watch() nothing is
    /// noted.
    explicit Watch(const std::filesystem::path& record);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    /// Replies through `port` are to begin within `window` after the read of their request.
    void watch(const std::filesystem::path& port, std::chrono::nanoseconds window);

    std::uint64_t replies() const { return record_->replies; }
    std::uint64_t late() const { return record_->late; }
    std::chrono::nanoseconds slowest() const { return std::chrono::nanoseconds{record_->slowest}; }

private:
    Record* record_;
};

} // namespace dpslave::reply_watch
