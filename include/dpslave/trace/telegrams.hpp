// SPDX-License-Identifier: Apache-2.0
/// Records of the bus to telegrams, with the same receiver that layer 2 uses: what it found, this finds.
/// It is pure: it runs in the program that shows a trace, never on the bus thread. Source: wire
/// reference 1.5, 2.
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

/// One line of a trace.
struct Entry {
    enum class What : std::uint8_t {
        telegram,   ///< heard, with a right checksum if it has one
        piece,      ///< heard, and no telegram
        cut,        ///< heard, a part of a telegram whose other part is not in the records
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
    std::vector<std::uint8_t> octets; ///< a bad character is 00
    std::uint32_t bad_characters = 0; ///< how many of them
    std::optional<fdl::Flaw> flaw;    ///< of a piece; none: it goes on where a flaw was named before
    fdl::Unanswered::Why why{};
    std::uint8_t address = 0;
    std::uint64_t count = 0;
};

class Telegrams {
public:
    /// Says how the records begin.
    enum class Begin : std::uint8_t {
        anywhere,    ///< perhaps the end of a telegram, which is cut then and no flaw
        at_telegram, ///< something that is heard from its begin
    };
    /// `hold_back`: how long a received character may lie in the port, as far as is known.
    explicit Telegrams(std::chrono::nanoseconds hold_back = {}, Begin begin = Begin::anywhere)
        : hold_back_(hold_back), is_at_begin_(begin == Begin::anywhere)
    {}

    /// The next record of the bus.
    void add(const Record& record);
    /// `count` records before the next one are missing. It may begin anywhere.
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
        std::uint32_t behind = 0;               ///< characters of the same read after it
        std::chrono::nanoseconds uncertainty{}; ///< of that read
    };

    void add_at_begin(const Record& record);
    void begin(std::size_t cut);
    void emit_cut(const Record& record, std::size_t count, Entry& entry);
    void go_on(const Record& record);
    void hear(Bytes octets, bool is_bad, const Record& record);
    void take_heard();
    void emit(Entry::What what, std::uint64_t end);
    void emit_rest(Entry::What what);
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
    // True after a gap, until it is known where a telegram begins.
    bool is_at_begin_;
    std::vector<Record> held_; ///< heard
    std::vector<std::uint8_t> held_octets_;
};

} // namespace dpslave::trace
