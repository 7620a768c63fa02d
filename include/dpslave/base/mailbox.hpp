// SPDX-License-Identifier: Apache-2.0
/// Hands the newest T from one thread to one other thread (a triple buffer). Neither side ever waits.
/// A value that was never fetched is overwritten: this is for state, not for orders (those go through a
/// Ring).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace dpslave {

template <class T>
class Mailbox {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    /// Writer's side.
    void publish(const T& value) noexcept
    {
        slots_[back_].value = value;
        back_ = exchange_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
    }

    /// Reader's side: true while something newer than the last latest() waits.
    bool fresh() const noexcept { return (exchange_.load(std::memory_order_relaxed) & kFresh) != 0; }

    /// Reader's side: the newest value published, a default T before the first. Valid until the next call.
    const T& latest() noexcept
    {
        if (fresh()) front_ = exchange_.exchange(front_, std::memory_order_acq_rel) & kIndex;
        return slots_[front_].value;
    }

private:
    static constexpr std::uint32_t kIndex = 3;
    static constexpr std::uint32_t kFresh = 4;
    struct alignas(64) Slot {
        T value{};
    };
    std::array<Slot, 3> slots_{};
    alignas(64) std::uint32_t back_ = 0;                 // only the writer's
    alignas(64) std::uint32_t front_ = 1;                // only the reader's
    alignas(64) std::atomic<std::uint32_t> exchange_{2}; // the free slot, and whether it is new
};

} // namespace dpslave
