// SPDX-License-Identifier: Apache-2.0
/// What `dpctl trace` prints of each entry, in each of its forms.
#pragma once

#include "recording.hpp"
#include "trace_condition.hpp"
#include "trace_decode.hpp"
#include "trace_file.hpp"

#include <optional>
#include <string_view>

namespace dpslave::dpctl {

/// Notes behind an entry that mean more than their words.
inline constexpr std::string_view kBefore = "from the head of the incident: it was before";
inline constexpr std::string_view kCause = "the cause of the incident";

/// Prints entries as they come, and writes them into a file where one is wanted.
class Printer final : public EntryTaker {
public:
    /// `file` and `decoder`: nullptr = none. `has_rate`: else only the time of the first character is known.
    Printer(TraceFilter filter, std::optional<StopCondition> stop, TraceDecoder* decoder, TraceFile* file,
            bool has_rate, Session& session)
        : filter_(std::move(filter)),
          stop_(std::move(stop)),
          decoder_(decoder),
          file_(file),
          has_rate_(has_rate),
          session_(session),
          terminal_(session.terminal())
    {}

    /// The condition of --stop-on has held: nothing more is printed.
    bool has_stopped() const override { return has_stopped_; }

    void flush() override;
    void expect_bus() override;
    /// An entry with the note kCause passes --bad, one with kBefore ends nothing.
    void print(const LineEntry& entry, UnixOffset offset, std::string_view note = {}) override;
    void print(const trace::Entry& entry, UnixOffset offset, std::string_view note = {}) override;

private:
    static constexpr std::size_t kIndent = 4; ///< of what stands beneath a telegram

    TraceFilter filter_of(std::string_view note) const;
    void print_json(Json json, std::string_view note);

    TraceFilter filter_;
    std::optional<StopCondition> stop_;
    bool has_stopped_ = false;
    TraceDecoder* decoder_;
    TraceFile* file_;
    bool has_rate_;
    Session& session_;
    Terminal& terminal_;
    std::optional<Instant> before_;
};

} // namespace dpslave::dpctl
