// SPDX-License-Identifier: Apache-2.0
#include "state_table.hpp"

namespace dpslave::dp {
namespace {

/// The table by state and trigger, so that a telegram costs one look-up.
constexpr auto kRowNumber = [] {
    std::array<std::array<std::uint8_t, kTriggers>, kStates> numbers{};
    for (std::size_t s = 0; s < kStates; ++s)
        for (std::size_t t = 0; t < kTriggers; ++t)
            for (std::size_t r = 0; r < kTable.size(); ++r)
                if (kTable[r].in.has(static_cast<State>(s)) && kTable[r].on.has(static_cast<Trigger>(t)))
                    numbers[s][t] = static_cast<std::uint8_t>(r);
    return numbers;
}();

} // namespace

const Row& row_of(State in, Trigger on)
{
    return kTable[kRowNumber[static_cast<std::size_t>(in)][static_cast<std::size_t>(on)]];
}

} // namespace dpslave::dp
