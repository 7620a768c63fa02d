// SPDX-License-Identifier: Apache-2.0
/// Passes an object that one thread builds and another one uses; the first one deletes it. So the user
/// neither allocates nor frees. Neither side waits.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace dpslave {

/// Between one giver and one user.
template <class T>
class Handover {
public:
    Handover() = default;
    Handover(const Handover&) = delete;
    Handover& operator=(const Handover&) = delete;
    ~Handover()
    {
        delete offered_.load(std::memory_order_acquire);
        delete used_up_.load(std::memory_order_acquire);
    }

    /// Giver: `next` is to be used from now on, and is empty afterwards. False, and nothing was done: what
    /// was offered before was not taken yet, or what was used up was not collected yet.
    bool offer(std::unique_ptr<T>& next) noexcept
    {
        if (!taken() || used_up_.load(std::memory_order_acquire) != nullptr) return false;
        offered_.store(next.release(), std::memory_order_release);
        return true;
    }
    /// Giver: returns the object that the user no longer uses, or nullptr if there is none.
    std::unique_ptr<T> collect() noexcept
    {
        return std::unique_ptr<T>{used_up_.exchange(nullptr, std::memory_order_acquire)};
    }
    /// Giver: takes back what was offered; nullptr: there is nothing, or the user takes it at this moment.
    /// Only where the user never calls offered().
    std::unique_ptr<T> withdraw() noexcept
    {
        T* offer = offered_.load(std::memory_order_acquire);
        const bool is_mine = offer != nullptr && offer != being_taken() &&
                             offered_.compare_exchange_strong(offer, nullptr, std::memory_order_acq_rel);
        return std::unique_ptr<T>{is_mine ? offer : nullptr};
    }
    /// Giver: true if the user has taken the last offer.
    bool taken() const noexcept { return offered_.load(std::memory_order_acquire) == nullptr; }

    /// User: what is offered, to be looked at before it is taken; nullptr = nothing new. It stays until
    /// take().
    const T* offered() const noexcept { return offered_.load(std::memory_order_acquire); }
    /// User: takes the offered object, if there is one. `present` becomes it, and the former `present` goes
    /// back to the giver, which may destroy it at once.
    bool take(std::unique_ptr<T>& present) noexcept
    {
        T* next = offered_.load(std::memory_order_acquire);
        if (next == nullptr) return false;
        if (!offered_.compare_exchange_strong(next, being_taken(), std::memory_order_acq_rel))
            return false; // it was withdrawn
        used_up_.store(present.release(), std::memory_order_release);
        present.reset(next);
        offered_.store(nullptr, std::memory_order_release); // last: the giver may offer again from here on
        return true;
    }

private:
    /// Stands for an object that the user takes at this moment; no object has this address.
    T* being_taken() noexcept { return static_cast<T*>(static_cast<void*>(this)); }

    std::atomic<T*> offered_{nullptr};
    std::atomic<T*> used_up_{nullptr};
};

} // namespace dpslave
