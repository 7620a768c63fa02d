// SPDX-License-Identifier: Apache-2.0
/// A blocking client of the control socket, for dpctl and tests.
#pragma once

#include "dpslave/control/protocol.hpp"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::control {

/// Why there is no reply.
struct ClientError {
    enum class Kind : std::uint8_t {
        no_daemon, ///< no process serves this socket
        no_access, ///< the socket is there, but this user has no right to its folder or file
        timeout,   ///< no reply within the timeout
        ended,     ///< the daemon ended the connection
        nonsense,  ///< what came is no Varlink reply
    };
    Kind kind = Kind::no_daemon;
    std::string text; ///< a sentence with the path
};

class Client {
public:
    /// `timeout`: how long the daemon may be silent in any one wait.
    static Result<Client, ClientError> connect(const std::filesystem::path& socket,
                                               std::chrono::milliseconds timeout);
    Client(Client&&) noexcept;
    Client& operator=(Client&&) noexcept;
    ~Client();

    /// One call, one reply. `method` without an interface belongs to org.dpslaved.Control.
    Result<ReplyMessage, ClientError> call(std::string_view method, const Json& parameters = Json::object());

    /// Starts a call; next() gives its one reply. So the wait for it can end earlier.
    std::optional<ClientError> start_one(std::string_view method, const Json& parameters = Json::object());
    /// Starts a call with "more"; next() gives its replies.
    std::optional<ClientError> start(std::string_view method, const Json& parameters = Json::object());
    /// The next reply, or none as soon as `wake` is readable (-1 = no such descriptor). The first reply
    /// must come within the timeout; the others take as long as they take.
    Result<std::optional<ReplyMessage>, ClientError> next(int wake = -1);

private:
    struct Impl;
    explicit Client(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace dpslave::control
