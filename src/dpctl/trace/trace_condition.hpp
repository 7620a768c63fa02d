// SPDX-License-Identifier: Apache-2.0
/// At which telegram `dpctl trace --stop-on` ends. Pure.
#pragma once

#include "trace_text.hpp"

#include "dpslave/base/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::dpctl {

/// Words that all have to hold; those of the filters mean the same here.
struct TraceCondition {
    TraceFilter filter{};               ///< its address comes from `station`
    std::string station{};              ///< by name or address; empty = any
    std::optional<std::uint8_t> from{}; ///< the sender
    std::optional<std::uint8_t> to{};   ///< the receiver
    bool unanswered = false;            ///< a request, of any master to any station, gets no answer
};

/// "unanswered,service=Set_Prm". The error is a sentence with the legal words.
Result<TraceCondition, std::string> read_condition(std::string_view text);

/// Looks at one entry after the other, as they come.
class StopCondition {
public:
    explicit StopCondition(TraceCondition condition) : condition_(std::move(condition)) {}

    /// The condition holds for this entry. With `unanswered` it holds for the request before it.
    bool holds(const trace::Entry& entry, const TraceWords& words);

private:
    bool is_met(const trace::Entry& entry, const TraceWords& words) const;
    bool is_left_open(const trace::Entry& entry, const TraceWords& words) const;

    struct Request {
        trace::Entry entry;
        TraceWords words;
    };
    TraceCondition condition_;
    std::optional<Request> open_; ///< the newest request, while it waits for its answer
};

} // namespace dpslave::dpctl
