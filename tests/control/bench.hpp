// SPDX-License-Identifier: Apache-2.0
/// A server on a socket in a folder of its own, callers that speak octets, and the hand that drives both:
/// nothing here sleeps, everything waits for descriptors.
#pragma once

#include "dpslave/control/server.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::test {

using control::Json;

/// The group of the operators in these tests.
inline constexpr gid_t kOperators = 4242;

/// A folder that is removed after the test; readable for every user.
class TempFolder {
public:
    TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    ~TempFolder();
    std::filesystem::path path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// All methods, each with its right; they answer with {}.
control::Methods quiet_methods();

/// One caller by hand. Non-blocking.
class RawCaller {
public:
    explicit RawCaller(const std::filesystem::path& socket);
    RawCaller(RawCaller&& other) noexcept;
    ~RawCaller();
    /// As many octets as the socket takes.
    std::size_t write(std::string_view octets);
    /// What is there to read, at most `limit` octets; none = the server ended the connection.
    std::optional<std::string> read(std::size_t limit = 65536);
    void close();
    void close_writing();
    int fd() const { return fd_; }

private:
    int fd_;
};

/// "{...}" and the NUL.
std::string message(std::string_view json);
/// A call of org.dpslaved.Control.
std::string call(std::string_view method, std::string_view parameters = "{}",
                 std::string_view more_members = "");

class Bench {
public:
    explicit Bench(control::Methods methods = quiet_methods(),
                   const std::function<void(control::ServerSettings&)>& change = {});

    RawCaller caller() { return RawCaller{socket}; }
    /// Lets the server work until `done`; false when nothing happens for a while although it is not.
    bool run_until(const std::function<bool()>& done, int also_fd = -1);
    /// The next message to `caller`; none = the connection ended. Throws when nothing comes.
    std::optional<Json> reply(RawCaller& caller);
    /// Writes and waits for the reply.
    std::optional<Json> ask(RawCaller& caller, std::string_view octets);
    /// One call by a new caller.
    Json ask(std::string_view method, std::string_view parameters = "{}");
    /// Lets the server do all that is ready now.
    void settle();

    TempFolder folder;
    std::filesystem::path socket = folder.path() / "control.sock";
    std::optional<control::Server> server;

private:
    std::map<int, std::string> unread_; ///< by caller
};

} // namespace dpslave::test
