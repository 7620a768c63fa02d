// SPDX-License-Identifier: Apache-2.0
/// A drive in memory that remembers what each of its tags held, and when. It knows no protocol: questions
/// are octets that its line hands back when their turn has come.
#pragma once

#include "chance.hpp"

#include "dpslave/base/units.hpp"

#include <deque>
#include <string>
#include <vector>

namespace dpslave::drive_line {

/// Words that no tag of a line held before: a word on the bus then shows where it came from, and when.
class NewWords {
public:
    explicit NewWords(Chance& chance) : offset_(static_cast<std::uint16_t>(chance.next())) {}
    bool used_up() const { return count_ >= 60'000; }
    std::uint16_t take()
    {
        for (;;) { // an odd factor: each word comes once
            const auto word = static_cast<std::uint16_t>(++count_ * 40'503U + offset_);
            if (word > 0xFF) return word;
        }
    }

private:
    std::uint16_t offset_;
    std::uint32_t count_ = 0;
};

/// From a moment on a tag held this, or was denied by the drive.
struct Held {
    Instant from{};
    std::uint16_t word = 0;
    bool denied = false;
};

/// Who has to do with a tag, so that only one of them writes it.
enum class TagUse : std::uint8_t {
    input,    ///< changes by itself
    output,   ///< of the master's exchange
    demand,   ///< of Demand Data
    operated, ///< of the operator
};

struct SimulatedTag {
    std::uint16_t number = 0;
    TagUse use = TagUse::input;
    std::string mnemonic;  ///< EI-ASCII
    bool is_word = false;  ///< EI-ASCII: travels as hexadecimal
    unsigned decimals = 0; ///< EI-ASCII, of a number
    bool is_ieee = false;  ///< Modbus: two registers of the IEEE area
    bool read_only = false;
    bool counts = false;         ///< each write of it does something: none may come twice
    bool refuses = false;        ///< writes, as a value out of range, for the time being
    std::vector<Held> history;   ///< never empty
    Instant changes_at = kNever; ///< by itself
    /// Since when it may hold another word than was written last: it lost its power, or refused.
    Instant disturbed_at{};

    const Held& now() const { return history.back(); }
    void becomes(std::uint16_t word, Instant at) { history.push_back({at, word, history.back().denied}); }
};

class SimulatedDrive {
public:
    /// A question on its way through the drive.
    struct Question {
        std::vector<std::uint8_t> octets;
        Instant handed{};      ///< when a program handed it to its port
        Instant carried_out{}; ///< when the drive samples or writes
        Instant answered{};    ///< when the first octet of its answer leaves
        bool is_spoilt = false;
        bool answer_is_lost = false;
    };

    std::uint8_t unit = 0;
    bool alive = true;
    bool knows_identity = true;   ///< EI-ASCII: has II
    bool remembers_spoilt = true; ///< EI-ASCII: EE says so after a write with a wrong checksum
    bool has_loopback = true;     ///< Modbus: function 8
    std::uint16_t ee = 0x00C0;    ///< EI-ASCII: last error
    std::vector<SimulatedTag> tags;
    std::deque<Question> questions; ///< in the order in which they were asked
    Instant last_carried_out{};
    Instant last_answered{};
    Time answers_every{}; ///< answers that would come sooner after its last one get lost
    Instant spoke_at{};   ///< its last whole answer could be read
    /// The same of one that names it, with no noise right before it and no question at the same time; and of
    /// the one before that.
    Instant named_at{}, named_before{};
    Time change_every = 200ms;

    SimulatedTag* find(std::uint16_t number)
    {
        for (SimulatedTag& tag : tags)
            if (tag.number == number) return &tag;
        return nullptr;
    }
    SimulatedTag* find_mnemonic(const std::string& mnemonic)
    {
        for (SimulatedTag& tag : tags)
            if (tag.mnemonic == mnemonic) return &tag;
        return nullptr;
    }

    /// What the tags do by themselves until `now`.
    void live_until(Instant now, NewWords& words, Chance& chance)
    {
        for (SimulatedTag& tag : tags)
            while (tag.changes_at <= now && !words.used_up()) {
                tag.becomes(words.take(), tag.changes_at);
                tag.changes_at += chance.between(change_every / 8, change_every * 2);
            }
    }
    void stands_still()
    {
        for (SimulatedTag& tag : tags) tag.changes_at = kNever;
    }
};

} // namespace dpslave::drive_line
