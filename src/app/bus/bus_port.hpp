// SPDX-License-Identifier: Apache-2.0
/// The port of the bus with its driver enable: octets to layer 2 without their echo, replies out, another
/// rate, the loss of the port and its return. The bus thread's own.
#pragma once

#include "app/links/links.hpp"
#include "backlog_age.hpp"
#include "bus_port_opener.hpp"
#include "bus_sender.hpp"
#include "bus_trace.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/fdl/echo.hpp"
#include "dpslave/fdl/layer2.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/epoll.hpp"
#include "dpslave/io/port.hpp"

#include <array>
#include <optional>
#include <string>

namespace dpslave::app {

class BusPort {
public:
    /// `opener` lends the port, with `driver` attached to it: check() looks for it. `epoll` reports `key`
    /// once for each arrival of octets. With listen = true the object has no sender: nothing is written, and
    /// `driver` is never made active. All outlive the object.
    BusPort(const config::BusConfig& config, BusPortOpener& opener, io::DriverEnable& driver,
            io::Epoll& epoll, std::uint64_t key, BusLink& link);
    BusPort(const BusPort&) = delete;
    BusPort& operator=(const BusPort&) = delete;

    bool is_open() const { return port_ != nullptr; }
    /// Another rate; what had come at the old one is lost. Without a port: that of the next one.
    void set_baud(Baud baud);

    /// Reads all that has come; the echo of replies does not reach layer 2. A port that fails is closed.
    void read(fdl::Layer2& layer2);
    /// At `now` nothing is left to read: the epoll reported nothing, or it has been read.
    void emptied(Instant now) { backlog_.emptied(now); }
    /// When the newest octets were read that are no echo.
    Instant heard_at() const { return heard_at_; }

    struct Reply {
        Bytes octets;
        std::uint8_t address = 0; ///< of the station that answers
        Baud baud = Baud::k9_6;
        Instant begins{};       ///< now
        Instant window_ended{}; ///< as Layer2 has it, which leaves room for the edge of the driver enable
    };
    /// The reply leaves now. Gives the moment after the write; nothing: it was not sent, and is counted.
    std::optional<Instant> send(const Reply& reply);
    /// Behind what was read before: when `layer2` gave up what was unfinished.
    void note_silence(fdl::Layer2& layer2);
    /// What was read and sent since the last call, and what `layer2` has left unanswered, goes into the
    /// trace.
    void commit_trace(fdl::Layer2& layer2);
    bool is_sending() const { return sender_ && sender_->is_sending(); }
    /// As BusSender::next_deadline().
    Instant sending_ends() const { return sender_ ? sender_->next_deadline() : kNever; }
    void finish_sending();

    /// Looks for a port that was opened, which `layer2` is told, and after a driver enable that has failed.
    void check(Instant now, fdl::Layer2& layer2);
    /// What another program has changed of the settings of the port; nullopt: nothing.
    std::optional<io::ChangedSettings> changed_settings() const
    {
        return is_open() ? port_->tty().changed_settings() : std::nullopt;
    }
    /// Sets them again, and reports it. A port that refuses them is closed.
    void set_again(const io::ChangedSettings& changed);

    /// Its part of the snapshot.
    void write_state(BusSnapshot& snapshot) const;

private:
    void hear(Bytes octets, Instant read_at, bool more, fdl::Layer2& layer2);
    void hear_withheld(Bytes octets, Instant read_at, fdl::Layer2& layer2);
    void note_unsent(const Reply& reply, fdl::Unanswered::Why why);
    void lose();
    void detach();
    void take(fdl::Layer2& layer2);
    void check_driver_enable();
    void discard_what_is_stuck();
    void report(PortEvent event)
    {
        link_.port_events.push(event);
    } // full: the log is not worth a lost telegram

    BusPortOpener& opener_;
    io::Port* port_ = nullptr; ///< lent, and open; null: there is none
    io::DriverEnable& driver_;
    std::optional<BusSender> sender_; ///< nothing: listen = true
    fdl::Echo echo_;
    io::Epoll& epoll_;
    std::uint64_t key_;
    BusLink& link_;
    BusTrace trace_;
    BacklogAge backlog_;
    std::array<std::uint8_t, 512> buffer_{};
    Instant heard_at_{};
    Instant leaves_by_ = kNever; ///< when the last reply must have left the kernel; kNever: it has
    Reply left_{};               ///< that reply without its octets; `begins`: any
    std::uint64_t unsent_ = 0;
    std::uint64_t stuck_ = 0; ///< of these, taken by the port and not sent
    std::uint64_t late_ = 0;
    std::uint64_t settings_changed_ = 0;
    bool was_open_ = false;
    bool driver_worked_ = true;
    bool guard_reported_ = false;
    std::uint64_t guarded_ = 0; ///< as seen last
};

} // namespace dpslave::app
