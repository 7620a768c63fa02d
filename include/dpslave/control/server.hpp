// SPDX-License-Identifier: Apache-2.0
/// The control socket: a Varlink service on a Unix stream socket, without a thread and without a wait of its
/// own. The main thread puts fd() into its epoll and calls on_ready(). Every caller is bounded: how many
/// there are, how many of one user, how long a call is, how many calls a round, how much may wait to be read
/// by it. A caller that is too slow or sends no Varlink loses its connection; others are not affected.
#pragma once

#include "dpslave/control/protocol.hpp"

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace dpslave::control {

/// Which callers may call a method.
enum class Right : std::uint8_t {
    look,    ///< every caller
    operate, ///< root and the operator group
    write,   ///< the same, unless the daemon only shows (ServerSettings::read_only)
};

struct ServerImpl;

/// The parameters of the last reply, or an error.
using LastReply = std::variant<Done, Error>;

/// Where the replies to one call go, if its handler has promised some with Later or Stream. The server hands
/// it out; a copy stands for the same call. When the caller or the server has gone, it is not open any more.
class ReplyTo {
public:
    ReplyTo() = default;

    /// False: the caller has gone, or has its last reply.
    bool is_open() const;
    /// A further reply of a Stream. False: it is not open.
    bool send(const Json& parameters) const;
    /// The last reply: the one promised with Later, or the end of a Stream. False: it is not open.
    bool end(const LastReply& reply) const;
    /// The octets that the caller has not fetched yet.
    std::size_t unsent() const;

private:
    friend struct ServerImpl;
    ReplyTo(std::weak_ptr<ServerImpl> server, std::uint64_t number)
        : server_(std::move(server)), number_(number)
    {}
    std::weak_ptr<ServerImpl> server_;
    std::uint64_t number_ = 0;
};

/// The caller, as the kernel says (SO_PEERCRED, SO_PEERGROUPS at the moment of connect).
struct Caller {
    uid_t uid = 65534;
    gid_t gid = 65534;
    pid_t pid = 0;
    std::vector<gid_t> groups; ///< supplementary ones
    bool more = false;     ///< this call takes several replies: without it a Stream ends after its first one
    bool operates = false; ///< may use methods with another right than Right::look
    ReplyTo reply_to{};    ///< for an answer that comes later
};

/// "uid 1000, pid 4711": for a log.
std::string words_of(const Caller& caller);

/// May `caller` use methods with Right::operate or Right::write? Root may, and the operator group; without a
/// group only root.
bool may_operate(const Caller& caller, std::optional<gid_t> operator_group) noexcept;

/// The answer is not known yet: Caller::reply_to gives it.
struct Later {};
/// A first reply; further ones go to Caller::reply_to until the caller has gone.
struct Stream {
    Json first = Json::object();
};
using Reply = std::variant<Done, Error, Later, Stream>;

/// Answers one method. The parameters have been judged by the interface description: only described fields,
/// right types; a nullable field that was null is absent. Must not call back into the server.
using Handler = std::function<Reply(const Json& parameters, const Caller& caller)>;
struct Method {
    Right right = Right::look;
    Handler answer{};
};
/// All methods of org.dpslaved.Control, by name.
using Methods = std::map<std::string, Method, std::less<>>;

struct ServerSettings {
    std::filesystem::path socket = "/run/dpslaved/control.sock";
    std::optional<gid_t> operator_group;    ///< none: only root operates
    std::string operator_group_name;        ///< for the error NotPermitted
    bool read_only = false;                 ///< no caller, root included, uses methods with Right::write
    std::string version;                    ///< of the program, for org.varlink.service.GetInfo
    std::string url;                        ///< of the project, for the same
    std::size_t max_clients = 32;           ///< one user id that is not root: a quarter of them at most
    std::size_t kept_for_operators = 4;     ///< of max_clients: reserved for them
    std::size_t max_unsent = 2 * kMaxReply; ///< octets that may wait for one slow caller
    std::size_t max_unsent_of_all = 4 * kMaxReply; ///< above it the connection with most is ended
    /// The credentials of the other end of a connection; none: peer_of().
    std::function<Caller(int fd)> identify;
};

/// How many connections have a turn in one on_ready(), with one call each: the main thread comes back to its
/// own work after that, whatever the callers have sent.
inline constexpr std::size_t kTurnsARound = 8;

/// What the server has seen, for `dpctl counters`.
struct ServerCounters {
    std::uint64_t connections = 0;
    std::uint64_t calls = 0;
    std::uint64_t errors = 0;      ///< calls answered with an error
    std::uint64_t turned_away = 0; ///< too many callers
    std::uint64_t displaced = 0;   ///< idle connections ended to make room for another one
    std::uint64_t malformed = 0;   ///< connections ended for a Flaw
    std::uint64_t too_slow = 0;    ///< connections ended because replies were not fetched
    std::uint64_t not_permitted = 0;
    std::uint64_t handler_failures = 0; ///< a handler threw: a fault of this program
};

class Server {
public:
    /// Listens. A socket file that no process serves is replaced; one on which a process answers is left
    /// alone. The reason of a failure is a sentence with the path.
    static Result<Server, std::string> open(ServerSettings settings, Methods methods);
    Server(Server&&) noexcept;
    Server& operator=(Server&&) noexcept;
    ~Server(); ///< ends all connections and removes the socket file

    /// Readable when there is something to do (an inner epoll).
    int fd() const noexcept;
    /// One round: at most kTurnsARound connections have their turn. Never waits. What is left over makes fd()
    /// readable again.
    void on_ready();

    /// Who may operate, for connections from now on, and whether anyone may write.
    void set_operators(std::optional<gid_t> group, std::string name);
    void set_read_only(bool read_only);

    std::size_t clients() const noexcept;
    const ServerCounters& counters() const noexcept;

private:
    explicit Server(std::shared_ptr<ServerImpl> impl);
    std::shared_ptr<ServerImpl> impl_;
};

} // namespace dpslave::control
