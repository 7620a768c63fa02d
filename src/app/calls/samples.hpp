// SPDX-License-Identifier: Apache-2.0
/// The method GetSamples: what a tag was, from the ring of samples of its drive line. Main thread only.
#pragma once

#include "app/state/station.hpp"

#include "dpslave/control/server.hpp"
#include "dpslave/report/replies.hpp"
#include "dpslave/trace/samples.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace dpslave::app {

/// What is asked; as GetSamples describes it.
struct SampleQuestion {
    std::uint16_t tag = 0;
    std::optional<std::chrono::seconds> within{};
    std::uint64_t after = 0;
};

/// One part of the answer, with as many samples as a reply should have. Pure: `now` and `unix_now` are the
/// same moment.
report::GetSamplesReply samples_of(const Station& station, const trace::Ring& ring,
                                   const SampleQuestion& question, Instant now,
                                   std::chrono::nanoseconds unix_now);

control::Reply get_samples(const Station& station, const control::Json& parameters);

} // namespace dpslave::app
