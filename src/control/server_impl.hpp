// SPDX-License-Identifier: Apache-2.0
/// The inside of a Server. server.cpp has the connections, dispatch.cpp the calls.
#pragma once

#include "connection.hpp"
#include "interface.hpp"
#include "unix_socket.hpp"

#include "dpslave/control/server.hpp"

#include <fcntl.h>
#include <sys/epoll.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace dpslave::control {

struct ServerImpl : std::enable_shared_from_this<ServerImpl> {
    ServerImpl(ServerSettings s, Methods m, ListeningSocket l, Interface own, Interface service)
        : settings(std::move(s)),
          methods(std::move(m)),
          listener(std::move(l)),
          own_interface(std::move(own)),
          service_interface(std::move(service))
    {}

    // server.cpp
    bool listen();
    void accept_callers();
    bool accept_one();
    void take_in(io::Fd fd);
    bool make_room(const Connection& added);
    std::size_t held_by(uid_t uid) const;
    std::optional<uid_t> fullest(bool with_operators) const;
    bool end_idle_of(uid_t uid);
    void serve(Connection& connection, std::uint32_t events);
    /// The connection of a call that has not got its last reply; null: there is none.
    Connection* find(std::uint64_t call) const;
    /// After anything was done with a connection: sets what epoll watches, or deletes the connection.
    void settle(Connection& connection);

    // dispatch.cpp
    void dispatch(Connection& connection, Call& call);
    Reply answer(const Connection& connection, Call& call);
    Reply answer_service(const Call& call) const;
    Reply answer_own(const Connection& connection, const Method& method, Call& call);
    void deliver(Connection& connection, const Call& call, const Reply& reply);
    void send(Connection& connection, const std::string& message);
    void send_final(Connection& connection, const LastReply& reply);
    void bound_unsent();

    static io::Fd open_spare() { return io::Fd{::open("/dev/null", O_RDONLY | O_CLOEXEC)}; }

    ServerSettings settings;
    Methods methods;
    ListeningSocket listener;
    Interface own_interface, service_interface;
    io::Fd epoll{::epoll_create1(EPOLL_CLOEXEC)};
    io::Fd spare = open_spare(); ///< given up for a moment when descriptors run out, to turn a caller away
    std::map<std::uint64_t, std::unique_ptr<Connection>> connections;
    std::map<std::uint64_t, Connection*> waiting; ///< by ReplyTo::number_
    std::uint64_t last_id = 0, last_call = 0;
    std::uint64_t uses = 0; ///< calls and replies until now: the clock of Connection::used
    ServerCounters counters;
};

} // namespace dpslave::control
