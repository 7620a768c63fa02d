// SPDX-License-Identifier: Apache-2.0
#include "dpslave/control/server.hpp"

#include "server_impl.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace dpslave::control {
namespace {

constexpr std::uint64_t kListener = 0; ///< epoll's name for the listening socket; connections count from 1
constexpr int kAcceptedAtOnce = 64;    ///< a few ms at most: a flood does not hold the main thread

} // namespace

bool may_operate(const Caller& caller, std::optional<gid_t> operator_group) noexcept
{
    if (caller.uid == 0) return true;
    if (!operator_group) return false;
    return caller.gid == *operator_group ||
           std::find(caller.groups.begin(), caller.groups.end(), *operator_group) != caller.groups.end();
}

std::string words_of(const Caller& caller)
{
    return fmt::format("uid {}, pid {}", caller.uid, caller.pid);
}

bool ServerImpl::listen()
{
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = kListener;
    return epoll && ::epoll_ctl(epoll.get(), EPOLL_CTL_ADD, listener.fd(), &event) == 0;
}

void ServerImpl::accept_callers()
{
    for (int n = 0; n < kAcceptedAtOnce; ++n)
        if (!accept_one()) return;
}

/// False: no connection waits, or none can be accepted.
bool ServerImpl::accept_one()
{
    io::Fd fd{::accept4(listener.fd(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)};
    if (fd) {
        take_in(std::move(fd));
        return true;
    }
    if (errno == EINTR || errno == ECONNABORTED) return true;
    if (errno == EMFILE || errno == ENFILE) { // else epoll would report this connection for ever
        spare.reset();
        const io::Fd turned_away{::accept4(listener.fd(), nullptr, nullptr, SOCK_CLOEXEC)};
        if (turned_away) ++counters.turned_away;
    }
    if (!spare) spare = open_spare();
    return false;
}

void ServerImpl::take_in(io::Fd fd)
{
    Caller caller = settings.identify ? settings.identify(fd.get()) : peer_of(fd.get());
    const bool operates = may_operate(caller, settings.operator_group);
    auto connection = std::make_unique<Connection>(++last_id, std::move(fd), std::move(caller), operates);
    connection->used = ++uses;
    epoll_event event{};
    event.events = connection->known_events = connection->wanted_events();
    event.data.u64 = connection->id;
    if (!make_room(*connection) || ::epoll_ctl(epoll.get(), EPOLL_CTL_ADD, connection->fd(), &event) < 0) {
        ++counters.turned_away;
        connection->send(encode_error({"Busy"}), kMaxReply);
        return;
    }
    ++counters.connections;
    connections.emplace(connection->id, std::move(connection));
}

/// A place for a new connection. A user with a full share loses an idle connection; when all places are
/// taken, the user with the most loses one. False: there is none.
bool ServerImpl::make_room(const Connection& added)
{
    const uid_t uid = added.caller.uid;
    const bool is_root = uid == 0;
    const std::size_t held = held_by(uid);
    if (!is_root && held >= std::max<std::size_t>(1, settings.max_clients / 4)) return end_idle_of(uid);
    const std::size_t kept = added.operates ? 0 : std::min(settings.kept_for_operators, settings.max_clients);
    if (connections.size() < settings.max_clients - kept) return true;
    const auto other = fullest(added.operates);
    return other && (is_root || held_by(*other) > held + 1) && end_idle_of(*other);
}

std::size_t ServerImpl::held_by(uid_t uid) const
{
    return static_cast<std::size_t>(
        std::count_if(connections.begin(), connections.end(),
                      [uid](const auto& one) { return one.second->caller.uid == uid; }));
}

/// The user with the most connections, root and, unless `with_operators`, the operators apart.
std::optional<uid_t> ServerImpl::fullest(bool with_operators) const
{
    std::map<uid_t, std::size_t> places;
    for (const auto& [id, one] : connections)
        if (one->caller.uid != 0 && (with_operators || !one->operates)) ++places[one->caller.uid];
    const auto most = std::max_element(places.begin(), places.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most != places.end() ? std::optional{most->first} : std::nullopt;
}

/// Ends the connection of `uid` that has been idle for longest, with Busy for its reason. False: each of them
/// waits for an answer of this server.
bool ServerImpl::end_idle_of(uid_t uid)
{
    Connection* longest = nullptr;
    for (const auto& [id, one] : connections) {
        if (one->caller.uid != uid || one->waits == Connection::Waits::later) continue;
        if (longest == nullptr || one->used < longest->used) longest = one.get();
    }
    if (longest == nullptr) return false;
    ++counters.displaced;
    longest->send(encode_error({"Busy"}), settings.max_unsent);
    longest->kill();
    settle(*longest);
    return true;
}

/// One turn: sends what waits, then takes and answers one call.
void ServerImpl::serve(Connection& connection, std::uint32_t events)
{
    const bool gone =
        (events & (EPOLLHUP | EPOLLERR)) != 0; // both directions: our replies are not read any more
    if (gone && connection.waits != Connection::Waits::nothing) return connection.kill();
    if (gone) connection.drop_output();
    connection.flush();
    if (!connection.idle()) return;
    auto message = connection.in.next();
    if (message && !*message) {
        connection.receive();
        message = connection.in.next();
    }
    connection.holds_calls = message && *message;
    if (message && !*message) {
        if (connection.ended() || gone) connection.kill(); // all calls done, all replies fetched
        return;
    }
    auto call = message ? parse_call(**message) : Result<Call, Flaw>{Failure{message.error()}};
    if (!call) {
        ++counters.malformed;
        return connection.kill();
    }
    connection.used = ++uses;
    dispatch(connection, *call);
}

void ServerImpl::settle(Connection& connection)
{
    if (connection.dead()) {
        if (connection.waits != Connection::Waits::nothing) waiting.erase(connection.call);
        connections.erase(connection.id); // closes the descriptor, which takes it out of the epoll
        return;
    }
    const std::uint32_t wanted = connection.wanted_events();
    if (wanted == connection.known_events) return;
    epoll_event event{};
    event.events = connection.known_events = wanted;
    event.data.u64 = connection.id;
    ::epoll_ctl(epoll.get(), EPOLL_CTL_MOD, connection.fd(), &event);
}

Connection* ServerImpl::find(std::uint64_t call) const
{
    const auto found = waiting.find(call);
    return found == waiting.end() ? nullptr : found->second;
}

Result<Server, std::string> Server::open(ServerSettings settings, Methods methods)
{
    auto own = parse_interface(interface_text());
    if (!own) return Failure{fmt::format("{}: {}", kInterface, own.error())};
    auto service = parse_interface(service_interface_text());
    if (!service) return Failure{fmt::format("{}: {}", kServiceInterface, service.error())};
    for (const auto& [name, type] : own->methods)
        if (methods.find(name) == methods.end())
            return Failure{fmt::format("the method {} has no handler", name)};
    if (methods.size() != own->methods.size()) return Failure{std::string{"a handler has no method"}};

    auto listener = ListeningSocket::open(settings.socket);
    if (!listener) return Failure{listener.error()};
    auto impl = std::make_shared<ServerImpl>(std::move(settings), std::move(methods), *std::move(listener),
                                             *std::move(own), *std::move(service));
    if (!impl->listen()) return Failure{fmt::format("control socket: {}", error_text(errno))};
    return Server{std::move(impl)};
}

Server::Server(std::shared_ptr<ServerImpl> impl) : impl_(std::move(impl)) {}
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;
Server::~Server() = default;

int Server::fd() const noexcept
{
    return impl_->epoll.get();
}

void Server::on_ready()
{
    std::array<epoll_event, kTurnsARound> events{}; // the kernel goes round: the next ones come next time
    const int n = ::epoll_wait(impl_->epoll.get(), events.data(), static_cast<int>(events.size()), 0);
    for (int i = 0; i < n; ++i) {
        const epoll_event& event = events[static_cast<std::size_t>(i)];
        const std::uint64_t who = event.data.u64; // a copy: the structure is packed
        if (who == kListener) {
            impl_->accept_callers();
        } else if (const auto found = impl_->connections.find(who); found != impl_->connections.end()) {
            impl_->serve(*found->second, event.events);
            impl_->settle(*found->second);
        }
    }
}

bool ReplyTo::is_open() const
{
    const auto server = server_.lock();
    return server && server->find(number_) != nullptr;
}

bool ReplyTo::send(const Json& parameters) const
{
    const auto server = server_.lock();
    Connection* const connection = server ? server->find(number_) : nullptr;
    if (connection == nullptr || connection->waits != Connection::Waits::stream) return false;
    server->send(*connection, encode_reply({parameters}, true));
    const bool is_taken = !connection->dead();
    if (is_taken && connection->all_sent()) connection->used = ++server->uses;
    server->settle(*connection);
    return is_taken;
}

bool ReplyTo::end(const LastReply& reply) const
{
    const auto server = server_.lock();
    Connection* const connection = server ? server->find(number_) : nullptr;
    if (connection == nullptr) return false;
    server->waiting.erase(number_);
    connection->waits = Connection::Waits::nothing;
    server->send_final(*connection, reply);
    const bool is_taken = !connection->dead();
    server->settle(*connection);
    return is_taken;
}

std::size_t ReplyTo::unsent() const
{
    const auto server = server_.lock();
    const Connection* const connection = server ? server->find(number_) : nullptr;
    return connection == nullptr ? 0 : connection->unsent();
}

void Server::set_operators(std::optional<gid_t> group, std::string name)
{
    impl_->settings.operator_group = group;
    impl_->settings.operator_group_name = std::move(name);
}

void Server::set_read_only(bool read_only)
{
    impl_->settings.read_only = read_only;
}

std::size_t Server::clients() const noexcept
{
    return impl_->connections.size();
}
const ServerCounters& Server::counters() const noexcept
{
    return impl_->counters;
}

} // namespace dpslave::control
