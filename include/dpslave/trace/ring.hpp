// SPDX-License-Identifier: Apache-2.0
/// The newest records of one thread, in a fixed piece of memory. One thread writes and never waits, and the
/// oldest records make room; any number of threads read. Records that a reader did not fetch in time are
/// counted for it. It allocates nothing after the start.
#pragma once

#include "dpslave/trace/record.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace dpslave::trace {

class Ring {
public:
    /// `octets` of memory, rounded up to a power of two, kLeast at least; 0: nothing is recorded.
    explicit Ring(std::size_t octets);
    static constexpr std::size_t kLeast = 4096;

    /// Writer's side: at most Record::kMostOctets, the rest is cut off.
    void put(const Head& head, Bytes octets) noexcept;
    bool is_on() const { return capacity_ != 0; }
    std::size_t size() const { return capacity_ * sizeof(std::uint64_t); } ///< octets of memory

    /// One reader; its own thread's. The ring outlives it.
    class Reader {
    public:
        enum class From : std::uint8_t { oldest, newest }; ///< newest: what is put from now on
        explicit Reader(const Ring& ring, From from = From::oldest);

        /// The next record. Returns false if there is none yet.
        bool next(Record& into);
        /// Returns how many records were overwritten before this reader came to them.
        std::uint64_t lost() const { return lost_; }

    private:
        bool copy(Record& into) const;

        const Ring* ring_;
        std::uint64_t at_ = 0;                  ///< of the next record, in words since the start
        std::optional<std::uint64_t> expected_; ///< number of the next record; none: whichever is oldest
        std::uint64_t lost_ = 0;
    };

private:
    static constexpr std::size_t kHeadWords = 4;
    std::atomic_ref<std::uint64_t> word(std::uint64_t at) const
    {
        return std::atomic_ref{words_[at & (capacity_ - 1)]};
    }
    void write(std::uint64_t at, std::uint64_t value) noexcept;

    std::size_t capacity_ = 0;               ///< words
    std::unique_ptr<std::uint64_t[]> words_; ///< each is written before it is read
    /// The place where the oldest record begins and the place after the newest one, in words since the start.
    /// `begin_` is moved before what lies there is overwritten: a reader that finds it moved throws away what
    /// it has copied.
    alignas(64) std::atomic<std::uint64_t> begin_{0};
    std::atomic<std::uint64_t> end_{0};
    std::atomic<std::uint64_t> begun_{0}; ///< records, counted before one is written
    std::atomic<std::uint64_t> done_{0};  ///< and after it
};

} // namespace dpslave::trace
