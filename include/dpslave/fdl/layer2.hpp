// SPDX-License-Identifier: Apache-2.0
/// Layer 2 of one bus with its passive stations (slaves): receiver, stations, search of the rate, and the
/// window of the reply. Octets and times go in, octets, deadlines and counters come out; it makes no system
/// call, starts no thread and allocates nothing. Source: wire reference 1.5, 2, 3, 6.7.
#pragma once

#include "dpslave/base/queue.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/fdl/baud_search.hpp"
#include "dpslave/fdl/receiver.hpp"
#include "dpslave/fdl/sap_user.hpp"
#include "dpslave/fdl/stations.hpp"
#include "dpslave/fdl/telegram.hpp"
#include "dpslave/fdl/telegram_listener.hpp"

#include <array>
#include <bitset>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace dpslave::fdl {

struct Layer2Settings {
    Baud baud = Baud::k187_5; ///< the fixed rate; with `search` the rate to begin with
    /// Search the rate (wire reference 7); none = fixed.
    std::optional<BaudSearchSettings> search;
    /// The time from the edge's "send" to the first bit on the wire: the deadline is earlier by it.
    std::chrono::nanoseconds start_up_latency{0};
};

/// These counters say what happened on the wire, for `dpctl counters`. All count upwards from the start.
struct Counters {
    std::uint64_t octets = 0;
    std::uint64_t telegrams = 0; ///< valid ones, of any station
    std::uint64_t checked = 0;   ///< those of them that have a checksum: noise cannot make them
    std::uint64_t requests = 0;  ///< valid, to one of our addresses or to all
    std::uint64_t replies = 0;   ///< handed to the edge
    std::uint64_t retries = 0;   ///< answered with the stored reply
    std::uint64_t overtaken = 0; ///< requests not answered because something followed them
    std::uint64_t late = 0;      ///< replies suppressed because the deadline had passed
    std::uint64_t own_address =
        0;                       ///< telegrams that carry one of our addresses as sender: an address conflict
    std::uint64_t came_back = 0; ///< of these, the reply that was sent last: an echo that is not taken away
    std::array<std::uint64_t, kFlaws> flaws{}; ///< at the rate of the bus
    /// While the rate is searched: what is no telegram at a rate that is tried says nothing about the line.
    std::uint64_t search_flaws = 0;
};

/// A request to one of our addresses that gets no reply, and why.
struct Unanswered {
    enum class Why : std::uint8_t {
        overtaken,   ///< something followed it on the line
        late,        ///< its window was over before the reply could begin
        own_address, ///< it carries one of our addresses as sender: an address conflict
        no_service,  ///< its function code is one that no slave answers
        searching,   ///< the rate is not confirmed yet
        unsent,      ///< the port or the driver enable did not send the reply (said by who sends)
    };
    Why why{};
    std::uint8_t address = 0; ///< of ours
    Instant at{};
};
inline constexpr std::size_t kUnansweredReasons = 6;
std::string_view text(Unanswered::Why why) noexcept;

/// One thread owns it. After every call, call take_transmit(), then next_deadline().
class Layer2 {
public:
    explicit Layer2(const Layer2Settings& settings);

    /// Attaches a station: `user` answers at `address`, with replies no later than max(max_tsdr, min T_SDR +
    /// 49 T_bit). The user outlives it. False, and nothing is attached, if the address is no station address
    /// (0..126).
    bool attach(std::uint8_t address, SapUser& user, const MaxTsdr& max_tsdr);
    /// Detaches a station: `address` is silent, and its pending reply is not given any more (octets that
    /// take_transmit() handed out stay valid). The others go on. An address that is not attached stays so.
    /// Call on_time() after it.
    void detach(std::uint8_t address);

    /// The line is another port: `rates` are those that it can do, of which one is searched at least;
    /// `start_up_latency` as in Layer2Settings. A search at a rate that it cannot do goes on with the next.
    /// Call on_time() after it.
    void set_port(const std::bitset<kBauds.size()>& rates, std::chrono::nanoseconds start_up_latency);

    /// Tells `listener` of each valid telegram heard, of any station; nullptr ends that. The listener
    /// outlives layer 2.
    void listen(TelegramListener* listener) { listener_ = listener; }

    /// Says that octets read from now on may be up to `unread` old because the caller was delayed. The reply
    /// window ends earlier by that time, and never begins earlier. At the beginning it is 0.
    void assume_backlog(std::chrono::nanoseconds unread) { unread_ = unread; }
    /// Takes octets that were read from the line in one go; `read_at` is taken right after the read.
    /// `more_follows`: what was read goes on in the next call, so a request at the end of these octets is not
    /// the newest thing heard.
    void on_bytes(Bytes bytes, Instant read_at, bool more_follows = false);
    /// The UART reported a bad character (parity, framing, break): the telegram it belongs to is invalid.
    /// Call it in the place of that octet, between the on_bytes() of the good ones before and after it.
    void on_character_error(Instant read_at);
    /// Time passes. Call it after every on_bytes() and at next_deadline().
    void on_time(Instant now);

    /// The reply that may start now, if there is one: to be written at once and complete. Valid until the
    /// next on_bytes(). Call it after on_time(): before the window opens there is none, and after it closed
    /// there is none any more.
    std::optional<Bytes> take_transmit();

    /// Returns, once and for a trace, when on_time() last gave up an unfinished telegram because nothing
    /// followed.
    std::optional<Instant> take_silence() { return std::exchange(silence_, std::nullopt); }

    /// Requests to our addresses that get no reply, in their order; for a trace. Those that are not taken in
    /// time are dropped.
    std::optional<Unanswered> take_unanswered() { return unanswered_.pop(); }

    /// The last moment at which the reply that take_transmit() gave last may still begin: a write that ends
    /// later was too late although it began in time.
    Instant window_ended() const { return window_ended_; }

    /// Returns the reply that was sent, as others hear it; `sa` is its station, also of an SC. It is nullptr
    /// if a request came since, or it was heard as an echo. Valid until the next on_bytes().
    const Telegram* sent() const { return sent_; }

    /// Returns when on_time() is due next. kNever = only octets can wake it. A moment that has passed means:
    /// at once.
    Instant next_deadline() const;

    /// A reply waits for its window: what can be put off is put off until it is out.
    bool reply_waits() const { return pending_.has_value() || receiver_.is_in_doubt(); }

    /// Returns when a telegram with a checksum (SD1, SD2, SD3) of any station was read last; default = none
    /// yet. Tokens and SC do not count: noise and wrong rates produce them.
    Instant last_telegram() const { return last_telegram_; }

    /// Returns which users were called since the last take: the edge has to publish their state. Bit n =
    /// address n.
    std::bitset<128> take_touched() { return stations_.take_touched(); }

    /// The rate to switch the line to, when the search decided so: the edge flushes the line and sets it. A
    /// search says so at once, for the rate that it begins with; until then it does not listen.
    std::optional<Baud> take_baud_change();

    Baud baud() const { return baud_; }
    BaudState baud_state() const { return baud_state_; }
    const Counters& counters() const { return counters_; }

private:
    /// A reply that waits for its window.
    struct Pending {
        std::uint8_t address = 0; ///< whose it is
        Bytes octets;
        const Telegram* telegram = nullptr; ///< what they say
        Instant not_before;
        Instant not_after;
        bool open = false;
    };

    void take_heard();
    void on_telegram(const Telegram& telegram, Instant read_at, bool newest);
    void on_request(const Telegram& request, Instant at);
    void cancel_reply(Instant at);
    void on_own_address(const Telegram& telegram, Instant at);
    bool rate_is_kept(std::size_t good, std::size_t bad, Instant at);
    void report_supervision(Instant at);
    void follow_search();

    Layer2Settings settings_;
    Baud baud_;
    std::optional<BaudSearch> search_;
    BaudState baud_state_ = BaudState::fixed;
    std::optional<Baud> baud_change_;

    Receiver receiver_;
    Stations stations_;
    TelegramListener* listener_ = nullptr;

    std::optional<Pending> pending_;
    std::chrono::nanoseconds unread_{0}; // assume_backlog()
    Instant window_ended_{};             // of the reply handed out last
    const Telegram* sent_ = nullptr; // that reply, until the next request; null: none, or its echo was heard
    Instant last_telegram_{};
    Queue<Unanswered, 8> unanswered_;
    std::optional<Instant> silence_;
    Counters counters_;
};

} // namespace dpslave::fdl
