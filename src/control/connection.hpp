// SPDX-License-Identifier: Apache-2.0
/// One connection: octets in, octets out, and what its caller waits for. Bounded in both directions.
#pragma once

#include "dpslave/control/server.hpp"
#include "dpslave/io/fd.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::control {

class Connection {
public:
    /// What the caller waits for. Until then its further calls stay unread.
    enum class Waits : std::uint8_t { nothing, later, stream };

    /// `id`: the server's number of this connection.
    Connection(std::uint64_t number_of_connection, io::Fd fd, Caller peer, bool operator_rights)
        : id(number_of_connection), caller(std::move(peer)), operates(operator_rights), fd_(std::move(fd))
    {}

    int fd() const noexcept { return fd_.get(); }
    bool dead() const noexcept { return dead_; }
    void kill() noexcept { dead_ = true; }
    /// Dead, without what waits; epoll reports it once more, so that it is forgotten.
    void cut();
    bool ended() const noexcept { return ended_; }
    /// Ready for the next call: replies are fetched, nothing is awaited.
    bool idle() const noexcept { return !dead_ && waits == Waits::nothing && out_.empty(); }

    bool all_sent() const noexcept { return out_.empty(); }

    /// Reads what has come, as far as there is room for it.
    void receive();
    /// Sends as much of what waits as the socket takes.
    void flush();
    /// Adds to what waits and sends. False: more than `limit` octets would wait.
    bool send(std::string_view message, std::size_t limit);
    /// The caller will never read: forgets what waits.
    void drop_output() { std::string{}.swap(out_); }
    std::size_t unsent() const noexcept { return out_.size(); }

    /// What epoll shall report of it now.
    std::uint32_t wanted_events() const noexcept;

    const std::uint64_t id;
    const Caller caller;
    const bool operates;
    Framer in{kMaxCall};
    bool holds_calls = false; ///< there may be a whole call in `in`
    Waits waits = Waits::nothing;
    std::uint64_t call = 0;         ///< the number of the call that the caller waits for
    std::uint64_t used = 0;         ///< the server's count of uses at the last call or reply
    std::uint32_t known_events = 0; ///< as given to epoll last

private:
    io::Fd fd_;
    std::string out_;
    bool ended_ = false; ///< the caller sends no more
    bool dead_ = false;
};

} // namespace dpslave::control
