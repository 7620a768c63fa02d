// SPDX-License-Identifier: Apache-2.0
/// The states and the errors of a snapshot say the same of every parameter.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <algorithm>
#include <array>

namespace dpslave::drive::test {

struct Refusal {
    AccessError error;
    WordState state;
};

inline constexpr std::array kRefusals{
    Refusal{AccessError::invalid_tag, WordState::invalid_tag},
    Refusal{AccessError::read_only, WordState::read_only},
    Refusal{AccessError::out_of_range, WordState::out_of_range},
    Refusal{AccessError::value_not_encoded, WordState::out_of_range},
    Refusal{AccessError::not_stopped, WordState::refused},
    Refusal{AccessError::not_config_mode, WordState::refused},
    Refusal{AccessError::unsupported_type, WordState::refused},
    Refusal{AccessError::not_understood, WordState::refused},
    Refusal{AccessError::no_scale, WordState::unscaled},
};

inline bool is_consistent(WordState state, AccessError error)
{
    switch (state) {
        case WordState::untried:
        case WordState::good: return error == AccessError::none;
        case WordState::stale:
            return error == AccessError::no_answer || error == AccessError::deferred ||
                   error == AccessError::not_understood;
        case WordState::invalid_tag:
        case WordState::read_only:
        case WordState::out_of_range:
        case WordState::refused: break;
        case WordState::unscaled: return error == AccessError::no_scale || error == AccessError::contradicted;
    }
    return std::any_of(kRefusals.begin(), kRefusals.end(), [state, error](const Refusal& one) {
        return one.error == error && one.state == state;
    });
}

inline bool is_consistent(const DriveSnapshot& seen)
{
    for (std::size_t i = 0; i < kMaxParameters; ++i)
        if (!is_consistent(seen.states[i], seen.errors[i])) return false;
    return true;
}

} // namespace dpslave::drive::test
