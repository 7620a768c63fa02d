// SPDX-License-Identifier: Apache-2.0
/// Octets of the line to telegrams. Octets and times go in, telegrams and flaws come out one by one; makes no
/// system call, starts no thread, allocates nothing. Source: wire reference 1.5, 2, 6.7.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/fdl/telegram.hpp"

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>

namespace dpslave::fdl {

/// Returns how long the line may be silent within a telegram before it counts as unfinished: T_SYN and an
/// allowance for the scheduler, because reads say little about the times on the wire (wire reference 1.5).
std::chrono::nanoseconds silence_limit(Baud baud);

/// A read is begin_read(), then on_bytes() or on_character_error(); then next() until there is nothing.
class Receiver {
public:
    explicit Receiver(Baud baud) : baud_(baud) {}

    struct Heard {
        Result<Telegram, Flaw> telegram{Telegram{}};
        Instant at{}; ///< when its last octet was read; of one that was in doubt when that ended
        /// The place among all characters heard, bad ones included; of a flaw only `begin` counts.
        std::uint64_t begin = 0, end = 0;
        bool newest = false; ///< nothing was heard after this telegram
    };

    /// Announces that `octets` were read at `read_at`, and judges the pause before them.
    void begin_read(std::size_t octets, Instant read_at);
    /// The octets, valid until next() has given everything. `more_follows`: what was read goes on in the next
    /// call, so a telegram at the end of these octets is not the newest thing heard.
    void on_bytes(Bytes bytes, bool more_follows);
    /// In the place of an octet that the UART reported as bad.
    void on_character_error();
    /// Time passes: a doubt ends, an unfinished telegram is searched for complete ones, or given up. Returns
    /// true if next() may have something; after next() this is to be called again.
    bool on_time(Instant now);
    /// kNever = none.
    Instant next_deadline() const { return std::min(gap_ends_, hunt_at_); }

    /// The next telegram or flaw, in the order of the line. Octets that are no telegram are one flaw, named
    /// by the first of them, until a telegram with a checksum or a pause. nullptr: there is none. Valid until
    /// the next call of the receiver.
    const Heard* next();

    /// A telegram is complete, and waits for T_SYN of silence or for more octets.
    bool is_in_doubt() const { return in_doubt_; }

    /// Returns how many characters, of all heard, are judged: those after them may become a telegram.
    std::uint64_t judged() const { return forgotten_; }

    /// Forgets what was heard, because the line goes on at `baud`.
    void restart(Baud baud);

private:
    /// Places in rx_, and the one after it.
    using Places = std::bitset<2 * kMaxTelegram + 1>;

    /// The octets that follow a silence within a good telegram are one of these.
    enum class Tail : std::uint8_t {
        none,      ///< no telegram begins there
        open,      ///< a telegram may have begun there that is not complete yet
        telegrams, ///< complete telegrams up to its end or beyond, the last of them with a checksum
    };
    struct Doubt {
        Tail tail;
        std::size_t at; ///< where it begins
    };

    std::chrono::nanoseconds on_wire(std::size_t octets) const;
    void note_pause(std::size_t octets, Instant read_at);
    void await_rest();
    void give_up();
    void report_unfinished();
    bool hunt_after_cut();
    Result<Telegram, Flaw> telegram_at(std::size_t at, std::size_t length, bool is_cut) const;
    std::size_t boundary_within(std::size_t begin, std::size_t end) const;
    static Tail tail_of(Bytes octets, std::size_t least);
    Doubt doubt_about(std::size_t end) const;
    bool next_in_buffer();
    bool begins_flaw();
    void refill();
    void forget(std::size_t count);
    void forget_all();

    Baud baud_;
    std::array<std::uint8_t, 2 * kMaxTelegram> rx_{}; // an unfinished telegram, and room for what comes next
    std::size_t used_ = 0;
    std::uint64_t forgotten_ = 0; // characters that came before rx_
    std::size_t spoilt_ = 0;      // octets of rx_ up to its last bad character
    /// The places in rx_ where a read began at least T_SYN after the one before: a new telegram may have
    /// begun there.
    Places boundaries_;
    bool has_boundary_ = false; // there is one: the sets are long, and each telegram asks
    /// Those of them with a silence on the line before them, as far as the times of the reads say.
    Places silences_;
    std::uint64_t read_ = 0; // where the newest read begins, all its pieces together, among all characters
    std::size_t octets_of_read_ = 0;
    Instant quiet_since_{};     // when octets were read before it
    Instant heard_at_{};        // when octets were read last
    Instant gap_ends_ = kNever; // the unfinished telegram is given up
    Instant hunt_at_ = kNever;  // complete telegrams are looked for in it, or a doubt ends

    // next() goes on with this.
    Heard heard_;
    bool reading_ = false;
    std::optional<Flaw> pending_flaw_;
    bool damaged_ = false;    // what was heard last is no telegram, and its flaw is reported
    std::size_t counted_ = 0; // octets of rx_ before a pause whose flaw is reported
    bool more_follows_ = false;
    bool in_doubt_ = false;  // rx_ begins with a good telegram, and what is in it may be another one
    Bytes input_;            // not in rx_ yet
    std::size_t at_ = 0;     // rx_ is read up to here
    std::size_t failed_ = 0; // end of the failed telegram: errors before it are not counted again
    /// The end of the failed telegram that is kept until its octets are gone: within it a new telegram may
    /// start only at a boundary.
    std::size_t searched_ = 0;
};

} // namespace dpslave::fdl
