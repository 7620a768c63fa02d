// SPDX-License-Identifier: Apache-2.0
/// The control socket: a Varlink service on a Unix stream socket, without a thread and without a wait of its
/// own. The main thread puts fd() into its epoll and calls on_ready(). Every caller is bounded: how many
/// there are, how many of one user, how long a call is, how many calls a round, how much may wait to be read
/// by it. A caller that is too slow or sends no Varlink loses its connection; others are not affected.
#pragma once

#include "control/interface.hpp"

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

/// The caller, as the kernel says (SO_PEERCRED, SO_PEERGROUPS at the moment of connect).
struct Caller {
    uid_t uid = 65534;
    gid_t gid = 65534;
    pid_t pid = 0;
    std::vector<gid_t> groups; ///< supplementary ones
    bool more = false;     ///< this call takes several replies: without it a Stream ends after its first one
    bool operates = false; ///< may use methods with Right::operate
};

/// "uid 1000, pid 4711": for a log.
std::string words_of(const Caller& caller);

/// May `caller` use methods with Right::operate? Root may, and the operator group; without a group only root.
bool may_operate(const Caller& caller, std::optional<gid_t> operator_group) noexcept;

/// The answer is not known yet: Server::complete(token, ...) gives it. `token` is the application's own
/// number, used for one waiting call at a time.
struct Later {
    std::uint64_t token = 0;
};
/// A first reply; further ones by Server::push(stream, ...) until the caller goes. `stream` is the
/// application's own number, used for one stream at a time.
struct Stream {
    std::uint64_t stream = 0;
    Json first = Json::object();
};
using Reply = std::variant<Done, Error, Later, Stream>;

/// Answers one method. The parameters have been judged by the interface description: only described fields,
/// right types; a nullable field that was null is absent. Must not call back into the server.
using Handler = std::function<Reply(const Json& parameters, const Caller& caller)>;
/// One handler for each of kMethods.
using Handlers = std::map<std::string, Handler, std::less<>>;

struct ServerSettings {
    std::filesystem::path socket = "/run/dpslaved/control.sock";
    std::optional<gid_t> operator_group;    ///< none: only root operates
    std::string operator_group_name;        ///< for the error NotPermitted
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
    static Result<Server, std::string> open(ServerSettings settings, Handlers handlers);
    Server(Server&&) noexcept;
    Server& operator=(Server&&) noexcept;
    ~Server(); ///< ends all connections and removes the socket file

    /// Readable when there is something to do (an inner epoll).
    int fd() const noexcept;
    /// One round: at most kTurnsARound connections have their turn. Never waits. What is left over makes fd()
    /// readable again.
    void on_ready();

    /// Gives the answer that a handler promised with Later: Done or Error. False: that caller has gone, or
    /// there was none.
    bool complete(std::uint64_t token, const Reply& reply);
    /// Sends a further reply of a stream. False: that stream has ended; the application forgets it.
    bool push(std::uint64_t stream, const Json& parameters);
    /// Octets of a stream that its caller has not fetched yet; 0 also when it has ended.
    std::size_t unsent(std::uint64_t stream) const;
    /// The last reply of a stream: nothing further will come. False: that stream had ended already.
    bool end_stream(std::uint64_t stream, const Error& why);
    /// Open streams, by their numbers in ascending order.
    std::vector<std::uint64_t> streams() const;

    /// The group that may operate, for connections from now on.
    void set_operators(std::optional<gid_t> group, std::string name);

    std::size_t clients() const noexcept;
    const ServerCounters& counters() const noexcept;

private:
    struct Impl;
    explicit Server(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace dpslave::control
