// SPDX-License-Identifier: Apache-2.0
/// The method Trace: what is in the rings of the bus and of the drive lines, then what comes into them. Main
/// thread only.
#pragma once

#include "app/line/drive_line.hpp"
#include "app/links/links.hpp"
#include "streams.hpp"

#include "dpslave/report/replies.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

class Traces {
public:
    /// All outlive this object.
    Traces(const BusLink& bus, const DriveLines& lines) : bus_(bus), lines_(lines) {}

    control::Reply add(const control::Json& parameters, const control::Caller& caller);
    /// Sends what has been recorded. A caller that is slow gets no more until it has fetched what waits for
    /// it.
    void push();
    /// Nobody asks: push() need not be called soon.
    bool empty() const { return traces_.empty(); }

private:
    using From = trace::Ring::Reader::From;
    /// One ring that a caller reads.
    struct Source {
        trace::Ring::Reader reader;
        std::optional<std::string> line;        ///< none: the bus
        std::shared_ptr<const LineTrace> keeps; ///< the ring of a line, which may be taken away meanwhile
        std::uint64_t lost = 0;                 ///< as told already
    };
    struct Trace {
        std::vector<Source> sources;
        std::string line;   ///< the one that is wanted; empty: more than one line, or none
        std::size_t at = 0; ///< whose turn it is
        bool told_caught_up = false;
    };
    std::optional<control::Error> no_such_line(const std::string& wanted) const;
    std::vector<Source> sources_of(const control::Json& parameters) const;
    /// The next part; `is_due` false: there is nothing to say.
    report::TraceReply part(Trace& trace, bool& is_due) const;

    const BusLink& bus_;
    const DriveLines& lines_;
    Streams<Trace> traces_;
};

} // namespace dpslave::app
