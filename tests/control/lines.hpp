// SPDX-License-Identifier: Apache-2.0
/// Pictures of what dpctl prints, as they stand in the tests.
#pragma once

namespace dpslave::test {

/// R"(...)" whose picture begins in the line below it: without that first line end.
constexpr const char* lines(const char* raw)
{
    return raw + 1;
}

} // namespace dpslave::test
