// SPDX-License-Identifier: Apache-2.0
#include "bench.hpp"

#include "control/interface.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <set>
#include <stdexcept>

namespace dpslave::test {
namespace {

constexpr int kPatience = 60'000; ///< ms until a test that waits for nothing gives up

} // namespace

TempFolder::TempFolder()
{
    std::string name = (std::filesystem::temp_directory_path() / "dpslave-control-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
    path_ = name;
    ::chmod(name.c_str(), 0755);
}

TempFolder::~TempFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

control::Methods quiet_methods()
{
    const std::set<std::string_view> writing{"WriteTag", "SetTec"};
    const std::set<std::string_view> operating{"Survey", "ProbeDrive",    "SetLogLevel",
                                               "Reload", "ListIncidents", "Trace"};
    const auto interface = control::parse_interface(control::interface_text());
    control::Methods methods;
    for (const auto& [name, type] : interface->methods) {
        control::Method& method = methods[name];
        if (writing.contains(name)) method.right = control::Right::write;
        if (operating.contains(name)) method.right = control::Right::operate;
        method.answer = [](const Json&, const control::Caller&) { return control::Done{}; };
    }
    return methods;
}

RawCaller::RawCaller(const std::filesystem::path& socket)
    : fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0))
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, socket.c_str(), sizeof address.sun_path - 1);
    const void* any = &address;
    if (::connect(fd_, static_cast<const sockaddr*>(any), sizeof address) < 0)
        throw std::runtime_error("connect");
}
RawCaller::RawCaller(RawCaller&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
RawCaller::~RawCaller()
{
    close();
}

void RawCaller::close()
{
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
}
void RawCaller::close_writing()
{
    ::shutdown(fd_, SHUT_WR);
}

std::size_t RawCaller::write(std::string_view octets)
{
    const auto n = ::send(fd_, octets.data(), octets.size(), MSG_NOSIGNAL);
    return n < 0 ? 0 : static_cast<std::size_t>(n);
}

std::optional<std::string> RawCaller::read(std::size_t limit)
{
    std::string octets(limit, '\0');
    const auto n = ::recv(fd_, octets.data(), octets.size(), 0);
    if (n == 0 || (n < 0 && errno != EAGAIN)) return std::nullopt;
    octets.resize(n < 0 ? 0 : static_cast<std::size_t>(n));
    return octets;
}

std::string message(std::string_view json)
{
    return std::string{json} + '\0';
}

std::string call(std::string_view method, std::string_view parameters, std::string_view more_members)
{
    std::string json = R"({"method":"org.dpslaved.Control.)";
    json.append(method).append(R"(","parameters":)").append(parameters).append(more_members).append("}");
    return message(json);
}

Bench::Bench(control::Methods methods, const std::function<void(control::ServerSettings&)>& change)
{
    control::ServerSettings settings;
    settings.socket = socket;
    settings.version = "9.8.7";
    settings.url = "file:///doc/README.md";
    if (change) change(settings);
    auto opened = control::Server::open(std::move(settings), std::move(methods));
    if (!opened) throw std::runtime_error(opened.error());
    server = *std::move(opened);
}

bool Bench::run_until(const std::function<bool()>& done, int also_fd)
{
    while (!done()) {
        std::array<pollfd, 2> ready{{{server->fd(), POLLIN, 0}, {also_fd, POLLIN, 0}}};
        if (::poll(ready.data(), ready.size(), kPatience) <= 0) return false;
        if (ready[0].revents != 0) server->on_ready();
    }
    return true;
}

void Bench::settle()
{
    pollfd ready{server->fd(), POLLIN, 0};
    while (::poll(&ready, 1, 0) > 0) server->on_ready();
}

std::optional<Json> Bench::reply(RawCaller& caller)
{
    std::string& unread = unread_[caller.fd()];
    bool ended = false;
    const bool came = run_until(
        [&] {
            if (unread.find('\0') != std::string::npos) return true;
            const auto octets = caller.read();
            ended = !octets;
            if (octets) unread += *octets;
            return ended || unread.find('\0') != std::string::npos;
        },
        caller.fd());
    if (!came) throw std::runtime_error("no reply");
    if (ended) return std::nullopt;
    const auto end = unread.find('\0');
    Json json = Json::parse(unread.substr(0, end));
    unread.erase(0, end + 1);
    return json;
}

std::optional<Json> Bench::ask(RawCaller& caller, std::string_view octets)
{
    caller.write(octets);
    return reply(caller);
}

Json Bench::ask(std::string_view method, std::string_view parameters)
{
    RawCaller one = caller();
    unread_[one.fd()].clear();
    return ask(one, call(method, parameters)).value();
}

} // namespace dpslave::test
