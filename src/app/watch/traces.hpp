// SPDX-License-Identifier: Apache-2.0
/// The method Trace: what is in the ring of the bus, then what comes into it. Main thread only.
#pragma once

#include "app/links.hpp"
#include "app/main/replies.hpp"

#include "dpslave/report/replies.hpp"

#include <map>

namespace dpslave::app {

class Traces {
public:
    /// Both outlive this object.
    Traces(const BusLink& bus, Replies& replies) : bus_(bus), replies_(replies) {}

    control::Reply add(const control::Json& parameters, const control::Caller& caller);
    /// Sends what has been recorded. A caller that is slow gets no more until it has fetched what waits for
    /// it.
    void push();
    /// Nobody asks: push() need not be called soon.
    bool empty() const { return traces_.empty(); }

private:
    struct Trace {
        trace::Ring::Reader reader;
        std::uint64_t lost = 0; ///< as told already
        bool told_caught_up = false;
    };
    /// The next part; `is_due` false: there is nothing to say.
    report::TraceReply part(Trace& trace, bool& is_due) const;

    const BusLink& bus_;
    Replies& replies_;
    std::map<std::uint64_t, Trace> traces_; ///< by the number of the stream
};

} // namespace dpslave::app
