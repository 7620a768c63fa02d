// SPDX-License-Identifier: Apache-2.0
/// Records of the bus to telegrams, with the same receiver that layer 2 uses: what it found, this finds.
/// Pure: it runs in whoever looks at a trace, never on the bus thread. Source: wire reference 1.5, 2.
#pragma once

#include "dpslave/fdl/layer2.hpp"
#include "dpslave/fdl/receiver.hpp"
#include "dpslave/trace/record.hpp"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace dpslave::trace {

/// What stands on one line of a trace.
struct Entry {
    enum class What : std::uint8_t {
        telegram,   ///< heard, with a right check sum where it has one
        piece,      ///< heard, and no telegram
        reply,      ///< ours
        unanswered, ///< a request to one of our addresses gets no reply: `why`, `address`
        rate,       ///< the bus goes on at another rate
        lost,       ///< `count` records were overwritten before they were read
    };
    What what = What::telegram;
    Baud baud = Baud::k9_6;
    Instant at{}; ///< heard: when the last octet had been read; sent: when the write had ended
    /// Computed from `at`, length and rate: begin of the first and end of the last character. A heard one has
    /// ended by `uncertainty` earlier at most, a sent one ends later by what the port holds back.
    Instant first{}, last{};
    std::chrono::nanoseconds uncertainty{};
    std::vector<std::uint8_t> octets; ///< a bad character stands as 00
    std::uint32_t bad_characters = 0; ///< how many of them
    std::optional<fdl::Flaw> flaw;    ///< of a piece; none: it goes on where a flaw was named before
    fdl::Unanswered::Why why{};
    std::uint8_t address = 0;
    std::uint64_t count = 0;
};

class Telegrams {
public:
    /// `hold_back`: how long a received character may lie in the port, as far as is known.
    explicit Telegrams(std::chrono::nanoseconds hold_back = {}) : hold_back_(hold_back) {}

    /// The next record of the bus.
    void add(const Record& record);
    /// `count` records before the next one are missing.
    void lost(std::uint64_t count, Instant at);
    /// The records end here: what is unfinished may be given up. Within them, those of silence say so.
    void pass_time(Instant now);
    /// The next finished entry, in the order of the line.
    std::optional<Entry> take();

private:
    struct Character {
        std::uint8_t octet = 0;
        bool is_bad = false;
        Instant read_at{};                      ///< of its read
        std::uint32_t behind = 0;               ///< characters of the same read behind it
        std::chrono::nanoseconds uncertainty{}; ///< of that read
    };

    void hear(Bytes octets, bool is_bad, const Record& record);
    void take_heard();
    void emit(Entry::What what, std::uint64_t end);
    void emit_rest();
    std::chrono::nanoseconds uncertainty_of(std::size_t characters, Instant read_at) const;
    Entry simple(Entry::What what, Instant at) const;

    std::chrono::nanoseconds hold_back_;
    Baud baud_ = Baud::k9_6;
    bool knows_rate_ = false;
    fdl::Receiver receiver_{Baud::k9_6};
    std::deque<Character> characters_; ///< heard and not in an entry yet
    std::uint64_t emitted_ = 0;        ///< characters in entries, of all heard
    Instant read_before_{};            ///< the newest read
    std::optional<fdl::Flaw> flaw_;    ///< of what is not in an entry yet
    std::deque<Entry> done_;
};

} // namespace dpslave::trace
