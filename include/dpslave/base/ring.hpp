// SPDX-License-Identifier: Apache-2.0
/// Carries each T once and in order from one thread to one other thread. Neither side ever waits:
/// a full ring refuses, and the refusals are counted.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace dpslave {

template <class T, std::size_t N>
class Ring {
    static_assert(std::is_trivially_copyable_v<T>);
    static_assert(N > 1 && (N & (N - 1)) == 0, "a power of two");

public:
    /// Writer's side. False when full: the value was not taken, and refused() counts one more.
    bool push(const T& value) noexcept
    {
        const std::size_t tail = tail_.load(std::memory_order_relaxed);
        if (tail - head_.load(std::memory_order_acquire) == N) {
            refused_.fetch_add(1, std::memory_order_relaxed);
            return false;
        }
        slots_[tail % N] = value;
        tail_.store(tail + 1, std::memory_order_release);
        return true;
    }

    /// Reader's side.
    std::optional<T> pop() noexcept
    {
        const std::size_t head = head_.load(std::memory_order_relaxed);
        if (head == tail_.load(std::memory_order_acquire)) return std::nullopt;
        const T value = slots_[head % N];
        head_.store(head + 1, std::memory_order_release);
        return value;
    }

    /// Returns how many values were refused because the ring was full. Any thread may ask.
    std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

private:
    std::array<T, N> slots_{};
    alignas(64) std::atomic<std::size_t> head_{0}; // the reader's
    alignas(64) std::atomic<std::size_t> tail_{0}; // the writer's
    std::atomic<std::uint64_t> refused_{0};
};

} // namespace dpslave
