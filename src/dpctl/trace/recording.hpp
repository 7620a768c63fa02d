// SPDX-License-Identifier: Apache-2.0
/// The trace that the daemon records, reply by reply.
#pragma once

#include "dpctl/cli/session.hpp"
#include "line_entry.hpp"
#include "trace_options.hpp"
#include "trace_text.hpp"

#include <cstdint>
#include <string_view>

namespace dpslave::dpctl {

/// Takes the entries of a trace as they come.
class EntryTaker {
public:
    /// `note`: a remark behind it.
    virtual void print(const trace::Entry& entry, UnixOffset offset, std::string_view note = {}) = 0;
    virtual void print(const LineEntry& entry, UnixOffset offset, std::string_view note = {}) = 0;
    /// The bus is among what is asked for.
    virtual void expect_bus() = 0;
    /// A reply has been read to its end.
    virtual void flush() = 0;
    /// Nothing more is wanted.
    virtual bool has_stopped() const = 0;

protected:
    ~EntryTaker() = default;
};

/// A capture has the drive lines as well, unless it is of some telegrams only. The past of a line is read
/// behind that of the bus, where --stop-on has ended it already.
bool has_all(const TraceOptions& options);

/// Until all is printed, without an end with --follow. `ended_at`: the last moment, since 1970. Gives the
/// exit code.
int read_trace(const TraceOptions& options, EntryTaker& printer, std::int64_t& ended_at, Session& session);

} // namespace dpslave::dpctl
