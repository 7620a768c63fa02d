// SPDX-License-Identifier: Apache-2.0
/// Up to N values in order, in place, within one thread (a Ring is for two). When it is full, the owner
/// decides what to do.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace dpslave {

template <class T, std::size_t N>
class Queue {
public:
    constexpr bool empty() const { return size_ == 0; }
    constexpr bool full() const { return size_ == N; }

    /// False when full: the value was not taken.
    constexpr bool push(const T& value)
    {
        if (full()) return false;
        slots_[(first_ + size_++) % N] = value;
        return true;
    }
    constexpr std::optional<T> pop()
    {
        if (empty()) return std::nullopt;
        const T value = slots_[first_];
        first_ = (first_ + 1) % N;
        --size_;
        return value;
    }
    /// The value pushed last. Precondition: not empty.
    constexpr T& newest() { return slots_[(first_ + size_ - 1) % N]; }
    constexpr void clear() { size_ = 0; }

private:
    std::array<T, N> slots_{};
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

} // namespace dpslave
