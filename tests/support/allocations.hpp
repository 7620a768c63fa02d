// SPDX-License-Identifier: Apache-2.0
/// Counts what one thread of this program asks the memory for: operator new and, where no sanitizer has taken
/// its place, malloc and its kin.
#pragma once

#include <cstdint>

namespace dpslave::test {

/// The calling thread is counted from its construction to its destruction; one at a time.
class CountAllocations {
public:
    CountAllocations();
    ~CountAllocations();
    CountAllocations(const CountAllocations&) = delete;
    CountAllocations& operator=(const CountAllocations&) = delete;
};
/// What was counted, until the next CountAllocations. Any thread may ask.
std::uint64_t allocations();

} // namespace dpslave::test
