// SPDX-License-Identifier: Apache-2.0
#include "dpslave/control/client.hpp"

#include "unix_socket.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace dpslave::control {
namespace {

using Kind = ClientError::Kind;

ClientError refused(const std::filesystem::path& path, int error)
{
    if (error == EACCES || error == EPERM)
        return {Kind::no_access, fmt::format("{}: {}", path.native(), error_text(error))};
    if (error == EAGAIN)
        return {Kind::timeout, fmt::format("{}: the daemon accepts no connection", path.native())};
    return {Kind::no_daemon, fmt::format("nothing answers on {} ({})", path.native(), error_text(error))};
}

} // namespace

struct Client::Impl {
    std::optional<ClientError> send(const std::string& message);
    Result<std::optional<ReplyMessage>, ClientError> receive(int wake,
                                                             std::optional<std::chrono::milliseconds> limit);
    /// Waits for octets: none = `wake` is readable, else how many were read and fed.
    Result<std::optional<std::size_t>, ClientError> read_some(int wake,
                                                              std::optional<std::chrono::milliseconds> limit);

    io::Fd fd;
    std::filesystem::path path;
    std::chrono::milliseconds timeout{};
    Framer in{kMaxReply};
    bool first = true; ///< of a stream
};

std::optional<ClientError> Client::Impl::send(const std::string& message)
{
    std::size_t sent = 0;
    while (sent < message.size()) {
        const auto n = ::send(fd.get(), message.data() + sent, message.size() - sent, MSG_NOSIGNAL);
        if (n >= 0)
            sent += static_cast<std::size_t>(n);
        else if (errno == EAGAIN)
            return ClientError{Kind::timeout, fmt::format("{}: the daemon does not read", path.native())};
        else if (errno == EPIPE || errno == ECONNRESET)
            return std::nullopt; // it may have said why before it closed: the reader finds out
        else if (errno != EINTR)
            return ClientError{Kind::ended, fmt::format("{}: {}", path.native(), error_text(errno))};
    }
    return std::nullopt;
}

Result<std::optional<std::size_t>, ClientError>
Client::Impl::read_some(int wake, std::optional<std::chrono::milliseconds> limit)
{
    std::array<pollfd, 2> ready{
        {{fd.get(), POLLIN, 0}, {wake, POLLIN, 0}}}; // poll leaves a negative one alone
    const int n = ::poll(ready.data(), ready.size(), limit ? static_cast<int>(limit->count()) : -1);
    if (n == 0)
        return Failure{ClientError{Kind::timeout,
                                   fmt::format("{}: no answer within {} ms", path.native(), limit->count())}};
    if (n > 0 && ready[1].revents != 0) return std::optional<std::size_t>{};
    std::array<char, 16 * 1024> chunk;
    const auto got = ::recv(fd.get(), chunk.data(), std::min(chunk.size(), in.room()), MSG_DONTWAIT);
    if (got > 0) {
        in.feed({chunk.data(), static_cast<std::size_t>(got)});
        return std::optional{static_cast<std::size_t>(got)};
    }
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return std::optional<std::size_t>{0U};
    return Failure{
        ClientError{Kind::ended, fmt::format("{}: the daemon ended the connection", path.native())}};
}

Result<std::optional<ReplyMessage>, ClientError>
Client::Impl::receive(int wake, std::optional<std::chrono::milliseconds> limit)
{
    for (;;) {
        const auto message = in.next();
        const auto nonsense = [&](Flaw flaw) {
            return Failure{ClientError{
                Kind::nonsense, fmt::format("{}: the answer is not Varlink: {}", path.native(), text(flaw))}};
        };
        if (!message) return nonsense(message.error());
        if (*message) {
            auto reply = parse_reply(**message);
            if (!reply) return nonsense(reply.error());
            return std::optional{*std::move(reply)};
        }
        const auto read = read_some(wake, limit);
        if (!read) return Failure{read.error()};
        if (!*read) return std::optional<ReplyMessage>{};
    }
}

Result<Client, ClientError> Client::connect(const std::filesystem::path& socket,
                                            std::chrono::milliseconds timeout)
{
    auto fd = connect_to(socket, timeout);
    if (!fd) return Failure{refused(socket, fd.error())};
    auto impl = std::make_unique<Impl>();
    impl->fd = *std::move(fd);
    impl->path = socket;
    impl->timeout = timeout;
    return Client{std::move(impl)};
}

Client::Client(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

Result<ReplyMessage, ClientError> Client::call(std::string_view method, const Json& parameters)
{
    if (auto failed = impl_->send(encode_call(method, parameters))) return Failure{std::move(*failed)};
    auto reply = impl_->receive(-1, impl_->timeout);
    if (!reply) return Failure{reply.error()};
    return **std::move(reply);
}

std::optional<ClientError> Client::start_one(std::string_view method, const Json& parameters)
{
    impl_->first = true;
    return impl_->send(encode_call(method, parameters));
}

std::optional<ClientError> Client::start(std::string_view method, const Json& parameters)
{
    impl_->first = true;
    return impl_->send(encode_call(method, parameters, true));
}

Result<std::optional<ReplyMessage>, ClientError> Client::next(int wake)
{
    const auto limit = impl_->first ? std::optional{impl_->timeout} : std::nullopt;
    auto reply = impl_->receive(wake, limit);
    if (reply && *reply) impl_->first = false;
    return reply;
}

} // namespace dpslave::control
