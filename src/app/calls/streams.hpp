// SPDX-License-Identifier: Apache-2.0
/// The callers of one method that get further replies: what is known of each, of type T. Main thread only.
#pragma once

#include "dpslave/control/server.hpp"

#include <utility>
#include <vector>

namespace dpslave::app {

template <class T>
class Streams {
public:
    bool empty() const { return callers_.empty(); }
    /// The first reply of a further caller.
    control::Stream open(const control::ReplyTo& to, T caller, control::Json first)
    {
        callers_.emplace_back(to, std::move(caller));
        return {.first = std::move(first)};
    }
    /// Forgets the callers that have gone and calls `serve(to, caller)` for each other one.
    template <class Serve>
    void each(Serve serve)
    {
        std::erase_if(callers_, [](const auto& one) { return !one.first.is_open(); });
        for (auto& [to, caller] : callers_) serve(to, caller);
    }

private:
    std::vector<std::pair<control::ReplyTo, T>> callers_;
};

} // namespace dpslave::app
