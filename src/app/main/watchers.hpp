// SPDX-License-Identifier: Apache-2.0
/// The method Watch: a reply at once, and another one whenever a state, a link or a value has changed. Main
/// thread only.
#pragma once

#include "monitor.hpp"
#include "replies.hpp"

#include <map>

namespace dpslave::app {

class Watchers {
public:
    /// Both outlive this object.
    Watchers(const Monitor& monitor, Replies& replies) : monitor_(monitor), replies_(replies) {}

    /// `station`: the only one that is watched; null: all.
    control::Reply add(const Station* station);
    /// Sends what has changed, and ends the streams of stations that have left.
    void push(Instant now);

private:
    struct Watcher {
        std::optional<std::string> station; ///< its name
        std::string sent;                   ///< fingerprint of the last reply
    };

    control::Json reply(const Station* station, Instant now) const;
    std::string fingerprint(const Station* station) const;

    const Monitor& monitor_;
    Replies& replies_;
    std::map<std::uint64_t, Watcher> watchers_; ///< by the number of the stream
};

} // namespace dpslave::app
