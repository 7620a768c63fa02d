// SPDX-License-Identifier: Apache-2.0
/// A segment at 1.5 Mbit/s without a pause: a master that goes from slave to slave, and the telegrams of
/// other stations between them. It stands at the other end of a pty.
#pragma once

#include "io/pty.hpp"
#include "slave_talk.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace dpslave::endurance {

/// What the master sent and what came back.
struct BusCounts {
    std::uint64_t requests = 0; ///< to the daemon's stations
    std::uint64_t others = 0;   ///< telegrams of other stations
    std::uint64_t octets = 0;   ///< sent, of both
    std::uint64_t answers = 0;  ///< in time or not
    std::uint64_t belated = 0; ///< those of them that came behind the slot time: master or daemon had to wait
    std::uint64_t wrong = 0;   ///< those of them that no slave may give

    std::uint64_t telegrams() const { return requests + others + answers; }
    std::uint64_t in_time() const { return answers - belated; }
    std::uint64_t missed() const { return requests - answers; }
};

using Reply = std::span<const std::uint8_t>;

class BusMaster {
public:
    /// `others`: exchanges of other stations before each request.
    explicit BusMaster(std::size_t others);

    const std::string& port() const { return pty_.path(); }
    const BusCounts& counts() const { return counts_; }

    /// The port stays open and raw from now on, whoever opens and closes it.
    void hold_open();
    /// What was sent and not read by anybody is gone, as on a wire. Needs hold_open().
    void forget_unread();

    /// Exchanges with one slave after the other until it is told to stop.
    void serve(const std::stop_token& stop, const std::vector<SlaveTalk*>& slaves);

    /// Sends a request, the telegrams of others before it. The reply is valid until the next call. Nothing:
    /// none came within the slot time and `patience`.
    std::optional<Reply> ask(const Octets& request, std::chrono::nanoseconds patience);
    /// One request to this slave, and what it makes of the reply. False: none came within the slot time and
    /// `patience`.
    bool exchange_once(SlaveTalk& slave, std::chrono::nanoseconds patience);
    /// The same. Behind a request without a reply it makes sure that none is on its way any more.
    void exchange(SlaveTalk& slave);
    /// Counts the answers that came behind the last request, if any.
    void take_what_is_late();

private:
    void find_out_what_is_late(std::uint8_t address);
    void send(const Octets& request);
    void write(std::span<const std::uint8_t> octets);
    std::optional<Reply> reply_within(std::chrono::nanoseconds time);

    io::Pty pty_;
    io::Fd held_open_;
    std::vector<std::uint8_t> sent_; ///< the telegrams of others, then the request
    std::size_t others_length_ = 0;
    std::size_t others_ = 0;               ///< telegrams in it
    std::array<std::uint8_t, 512> room_{}; ///< read and not yet taken
    std::size_t have_ = 0;
    std::array<std::uint8_t, 512> reply_{}; ///< taken last
    BusCounts counts_;
};

} // namespace dpslave::endurance
