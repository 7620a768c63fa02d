// SPDX-License-Identifier: Apache-2.0
/// The method Watch: a reply at once, and another one whenever a state, a link or a value has changed. Main
/// thread only.
#pragma once

#include "app/state/monitor.hpp"
#include "streams.hpp"

#include <optional>
#include <string>

namespace dpslave::app {

class Watchers {
public:
    /// `monitor` outlives this object.
    explicit Watchers(const Monitor& monitor) : monitor_(monitor) {}

    /// `station`: the only one that is watched; null: all.
    control::Reply add(const Station* station, const control::Caller& caller);
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
    Streams<Watcher> watchers_;
};

} // namespace dpslave::app
