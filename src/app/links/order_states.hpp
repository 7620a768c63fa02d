// SPDX-License-Identifier: Apache-2.0
/// How far each order of a line has come, between the main thread and the line, which may stall. Who ends an
/// order and who begins it decide it by one atomic: what was answered as not carried out is never begun.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace dpslave::app {

class OrderStates {
public:
    /// What end() has found.
    enum class End : std::uint8_t {
        not_begun, ///< it is not carried out any more
        begun,     ///< it may have been done; it is not sent again
        answered,  ///< the line has done with it: its answer comes, or has come
    };

    // Main thread.
    /// Before the line gets the order. False: an order of before still has the place, for the line has not
    /// looked since. `number` is not 0.
    bool add(std::uint32_t number)
    {
        std::uint64_t expected = 0;
        return place(number).compare_exchange_strong(expected, value(number, kWaits));
    }
    /// The line never gets it.
    void take_back(std::uint32_t number) { place(number).store(0); }
    /// Nobody waits for it any more.
    End end(std::uint32_t number)
    {
        if (end_unless_begun(number)) return End::not_begun;
        std::uint64_t expected = value(number, kBegun);
        const bool was_begun = place(number).compare_exchange_strong(expected, value(number, kEnded));
        if (was_begun) return End::begun;
        // Between the two looks the line may have found that it had sent nothing.
        return expected == value(number, kWaits) ? end(number) : End::answered;
    }
    /// True: the same as end() with the result not_begun. False: nothing was done.
    bool end_unless_begun(std::uint32_t number)
    {
        std::uint64_t expected = value(number, kWaits);
        return place(number).compare_exchange_strong(expected, value(number, kEnded));
    }

    // The line.
    /// It is about to be sent, for the first time or again. False: it has ended, and nothing is sent.
    bool begin(std::uint32_t number)
    {
        std::uint64_t expected = value(number, kWaits);
        return place(number).compare_exchange_strong(expected, value(number, kBegun)) ||
               expected == value(number, kBegun);
    }
    /// Nothing of it was sent since the first begin().
    void not_sent(std::uint32_t number)
    {
        std::uint64_t expected = value(number, kBegun);
        place(number).compare_exchange_strong(expected, value(number, kWaits));
    }
    bool has_ended(std::uint32_t number) const { return place(number).load() == value(number, kEnded); }
    /// The line has answered it, or has dropped it since it has ended.
    void remove(std::uint32_t number)
    {
        if (place(number).load() >> 8U == number) place(number).store(0); // else it is of a newer one
    }

private:
    /// More than the ring and the poller of a line hold.
    static constexpr std::size_t kPlaces = 64;
    enum Stage : std::uint8_t { kWaits, kBegun, kEnded };

    static std::uint64_t value(std::uint32_t number, Stage stage)
    {
        return std::uint64_t{number} << 8U | stage;
    }
    std::atomic<std::uint64_t>& place(std::uint32_t number) { return places_[number % kPlaces]; }
    const std::atomic<std::uint64_t>& place(std::uint32_t number) const { return places_[number % kPlaces]; }

    std::array<std::atomic<std::uint64_t>, kPlaces> places_{}; ///< 0: nobody has it
};

} // namespace dpslave::app
