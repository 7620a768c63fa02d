// SPDX-License-Identifier: Apache-2.0
/// The values of drives over time: one record of a Ring for each refresh of a drive, and records that say
/// which tags the words are of. A ring of samples has nothing else. docs/internals/trace.md has the format.
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/trace/ring.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace dpslave::trace {

/// The owner of a sample.
struct SampleOf {
    std::uint32_t station = 0; ///< a number that is never given twice while the program runs
    Generation generation = 0; ///< of the layout
    friend bool operator==(const SampleOf&, const SampleOf&) = default;
};

/// Words and states of the parameters of a layout, in its order. Both have the same length, kMaxParameters at
/// most.
struct SampledValues {
    std::span<const std::uint16_t> words;
    std::span<const WordState> states;
    bool has_ended = false; ///< the layout: its outputs are written no more
};

/// Writer's side, as Ring::put().
void put_layout(Ring& ring, std::uint32_t station, const Layout& layout, Instant at) noexcept;
void put_values(Ring& ring, const SampleOf& of, const SampledValues& values, Instant at) noexcept;

/// A record of such a ring, read.
struct Sample {
    SampleOf of{};
    bool is_layout = false; ///< `parameters` count; else `words` and `states`
    bool has_ended = false; ///< as SampledValues has it
    std::uint8_t count = 0;
    std::array<LayoutEntry, kMaxParameters> parameters{};
    std::array<std::uint16_t, kMaxParameters> words{};
    std::array<WordState, kMaxParameters> states{};
};

/// Returns nullopt if it is no such record.
std::optional<Sample> sample_of(const Record& record);

} // namespace dpslave::trace
