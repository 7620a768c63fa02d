// SPDX-License-Identifier: Apache-2.0
/// Layer 2 of the master: one request at a time with its repetitions, frame count bit and pauses, and what of
/// an answer no slave may say (wire reference 1.3, 2.2 to 2.6). It is pure.
#pragma once

#include "master_settings.hpp"
#include "other_stations.hpp"

namespace dpslave::sim {

class Requester {
public:
    /// The result of one request. There is no answer if nothing came, or nothing valid after all repetitions.
    struct Outcome {
        Order order{};
        bool one_shot = false;
        bool was_sent_only = false; ///< SDN: nothing comes back
        bool is_whole = false;      ///< what was heard has the length of a telegram
        std::optional<Frame> answer{};
        Octets heard{};
        std::string flaw{}; ///< of what was heard last; empty = silence, or a good answer
        unsigned tries = 0;
        std::chrono::nanoseconds took{0}; ///< handed over until answer complete
    };

    /// Both outlive it.
    Requester(const MasterSettings& settings, MasterCounters& counters)
        : settings_(settings), counters_(counters)
    {}

    /// Precondition: ready().
    void begin(Order order, bool one_shot);
    std::optional<Outcome> on_bytes(Bytes octets, Instant now);
    std::optional<Outcome> on_time(Instant now);
    std::optional<Octets> take_transmit(Instant now);

    bool busy() const { return pending_.has_value(); }
    bool ready(Instant now) const { return !pending_ && now >= idle_until_; }
    Instant idle_until() const { return idle_until_; }
    /// Returns the deadline of a request that is under way.
    Instant next_deadline() const { return to_send_ ? Instant::min() : pending_->give_up; }

    /// A cyclic request is not sent again, and not at all if it was not sent yet.
    void give_up_cyclic();
    /// The next counted request begins a sequence (FCB 1, FCV 0).
    void begin_sequence() { first_ = true; }

    /// Returns what the slave did that a slave must not do, in words.
    std::vector<std::string> take_violations() { return std::exchange(violations_, {}); }

private:
    struct Pending {
        Order order{};
        Octets wire{};
        bool one_shot = false;
        bool counted = false; ///< carries a valid or a first frame count bit
        bool answered = true; ///< false: SDN, nothing comes back
        bool repeated = true; ///< false: once is enough
        unsigned tries = 0;
        Instant sent{};
        Instant give_up{};
    };

    Frame frame_of(const Order& order) const;
    std::optional<Outcome> whole_answer(Bytes octets, Instant now);
    std::optional<Outcome> bad_answer(std::string why, Instant now);
    Outcome finished(Instant now);
    std::string flaw_of(const Frame& frame) const;

    const MasterSettings& settings_;
    MasterCounters& counters_;
    bool first_ = true; ///< the next counted request starts a sequence (FCB 1, FCV 0)
    bool fcb_ = false;  ///< of the next counted request
    OtherStations others_;
    std::optional<Pending> pending_;
    bool to_send_ = false;
    Octets rx_, heard_;
    std::string rx_flaw_;  ///< not empty: what was heard is no answer; wait until the line is idle
    Instant idle_until_{}; ///< T_ID1 / T_ID2
    Instant unasked_at_ = Instant::min();
    std::vector<std::string> violations_;
};

} // namespace dpslave::sim
