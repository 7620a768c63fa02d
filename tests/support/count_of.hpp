// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>

namespace dpslave::test {

/// The number in a variable of the environment, or `otherwise` without one: tools/check takes few random
/// runs, tools/run many.
inline std::uint64_t count_of(const char* variable, std::uint64_t otherwise)
{
    const char* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

} // namespace dpslave::test
