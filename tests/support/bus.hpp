// SPDX-License-Identifier: Apache-2.0
/// A simulated bus that is also the judge. It has the only clock; an octet takes 11 T_bit. Masters send
/// octets, the station under test gets them as an edge would hand them over, and its replies are pulled when
/// it asks to be woken.
///
/// The test fails (ADD_FAILURE) by itself when
///   - a reply starts before min T_SDR or after the deadline max(max T_SDR, min T_SDR + 49 T_bit),
///   - two talk at once,
///   - a master's request comes before T_SYN,
///   - a reply is no valid telegram by the second hand (wire.hpp), or answers what is no valid request,
///   - the station's next_deadline() does not move on.
#pragma once

#include "bit_line.hpp"
#include "master.hpp"
#include "print.hpp"
#include "wire.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/fdl/layer2.hpp"

#include <optional>
#include <vector>

namespace test {

struct BusSettings {
    dpslave::Baud baud = dpslave::Baud::k187_5; ///< the masters' rate
    dpslave::Tbit min_tsdr{11};
    /// What the stations promise. None: the class default 60/60/60/60/60/100/150 of the rate.
    std::optional<dpslave::Tbit> max_tsdr;
};

/// The class default of max T_SDR for each rate in the order of kBauds (wire reference 1.3): for
/// Layer2::attach().
inline constexpr std::array<dpslave::Tbit, dpslave::kBauds.size()> kClassMaxTsdr{
    dpslave::Tbit{60}, dpslave::Tbit{60},  dpslave::Tbit{60}, dpslave::Tbit{60},
    dpslave::Tbit{60}, dpslave::Tbit{100}, dpslave::Tbit{150}};

class Bus final : public Wire {
public:
    using duration = std::chrono::nanoseconds;

    explicit Bus(dpslave::fdl::Layer2& station, const BusSettings& settings = {});

    // --- What masters (and other slaves) do. Each waits first until the previous cycle is over: the reply,
    // or the
    // --- slot time without one; then for T_SYN.

    /// One telegram, which the station reads in one go.
    void master_sends(const Octets& telegram);
    /// The same, but read octet by octet.
    void arrives_octet_by_octet(const Octets& telegram);
    /// The same, but read as a FIFO hands it over: `size` octets at a time, the last ones as soon as they
    /// end.
    void arrives_in_bunches(const Octets& telegram, std::size_t size);
    /// Several telegrams, T_SYN apart, that a late reader gets in one go.
    void arrives_in_one_read(const std::vector<Octets>& telegrams);
    /// One telegram whose octet number `bad` (from 0) arrives with a parity or framing error.
    void arrives_with_bad_character(const Octets& telegram, std::size_t bad);
    /// A telegram of which these characters are received, at its end.
    void arrives_as(const Octets& telegram, const std::vector<Character>& received);
    /// A telegram `pause` after the last octet on the line, whatever the station is about to do. With a pause
    /// below T_SYN the test fails; see breaks_in_after().
    void master_sends_after(duration pause, const Octets& telegram);
    /// Octets without regard to any rule: noise, another slave's reply, a master that is not patient.
    void breaks_in_after(duration pause, const Octets& octets);

    // --- What the station did.

    /// Its reply to the last telegram; waits for it, at most for the slot time. Each reply is given once.
    std::optional<Octets> reply();
    /// A telegram of a master, read in one go, and the reply to it.
    std::optional<Octets> ask(const Octets& telegram) override
    {
        master_sends(telegram);
        return reply();
    }
    void send(const Octets& telegram) override;
    /// When the last request was read.
    dpslave::Instant asked_at() const { return request_end_; }
    /// From the last octet of the last request to the first bit of the last reply.
    duration turnaround() const;
    /// The rates that the station switched to since the last call.
    std::vector<dpslave::Baud> take_baud_changes();

    // --- Time.

    dpslave::Instant now() const { return now_; }
    void advance(duration by);
    /// No station sends for `silence`, counted from the end of the octets on the line now.
    void line_is_idle_for(duration silence);
    /// From now on the edge wakes up this much later than the station asks for.
    void edge_is_late_by(duration latency) { edge_latency_ = latency; }

    // --- What the judge goes by.

    void set_min_tsdr(dpslave::Tbit bits) { settings_.min_tsdr = bits; }
    void set_max_tsdr(dpslave::Tbit bits) { settings_.max_tsdr = bits; }
    void set_baud(dpslave::Baud baud) { settings_.baud = baud; } ///< the masters go on at another rate
    duration bits(std::uint32_t count) const;
    duration deadline() const; ///< of a reply, counted from the end of the request

private:
    struct Reply {
        Octets octets;
        dpslave::Instant begin;
    };

    void settle();
    void wait_for_syn();
    dpslave::Instant speak(const Octets& octets);
    void deliver(const Octets& octets);
    void deliver_bad();
    void ended(const Octets& octets);
    void pump();
    void judge(const Octets& octets);
    void advance_to(dpslave::Instant target);

    dpslave::fdl::Layer2& station_;
    BusSettings settings_;
    dpslave::Instant now_{std::chrono::seconds{1000}};
    dpslave::Instant busy_until_ = now_;  ///< end of the last octet of any station
    dpslave::Instant request_end_ = now_; ///< end of the last octet of a master
    Octets asked_;                        ///< what masters said since the last reply
    bool in_cycle_ = false;               ///< a request may still be answered
    duration edge_latency_{0};
    std::optional<Reply> unread_;
    duration turnaround_{0};
    std::vector<dpslave::Baud> baud_changes_;
};

} // namespace test
