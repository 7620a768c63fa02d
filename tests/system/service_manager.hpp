// SPDX-License-Identifier: Apache-2.0
/// The service manager of a test: what the daemon reports to it, and how long it is silent.
#pragma once

#include "process.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>

namespace dpslave::test {

/// The place of systemd: a datagram socket, of which each line is noted.
class ServiceManager {
public:
    explicit ServiceManager(const std::filesystem::path& path)
        : fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0))
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path.string().copy(address.sun_path, sizeof address.sun_path - 1);
        const void* const any = &address;
        if (fd_ < 0 || ::bind(fd_, static_cast<const sockaddr*>(any), sizeof address) != 0)
            throw std::system_error{errno, std::system_category(), path.string()};
        listener_ = std::jthread{[this](const std::stop_token& stop) { listen(stop); }};
    }
    ~ServiceManager()
    {
        listener_.request_stop();
        listener_.join();
        ::close(fd_);
    }
    ServiceManager(const ServiceManager&) = delete;
    ServiceManager& operator=(const ServiceManager&) = delete;

    ::testing::AssertionResult hears(std::string_view text) { return heard_.says(text); }

    /// Between two WATCHDOG=1 that were heard until now.
    std::chrono::nanoseconds longest_silence() const { return longest_silence_.load(); }
    /// The same, and begins anew.
    std::chrono::nanoseconds take_longest_silence() { return longest_silence_.exchange({}); }
    /// When the last WATCHDOG=1 was heard; none: the beginning of the clock.
    std::chrono::steady_clock::time_point last_sign_of_life() const { return last_.load(); }

private:
    void listen(const std::stop_token& stop)
    {
        while (!stop.stop_requested()) {
            pollfd one{fd_, POLLIN, 0};
            if (::poll(&one, 1, 50) != 1) continue;
            std::array<char, 4096> datagram{};
            const ssize_t got = ::recv(fd_, datagram.data(), datagram.size(), 0);
            std::istringstream lines{
                std::string{datagram.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0))}};
            for (std::string line; std::getline(lines, line);) {
                if (line == "WATCHDOG=1") note_sign_of_life();
                transcript_.add(line);
            }
        }
        transcript_.close();
    }

    void note_sign_of_life()
    {
        const auto now = std::chrono::steady_clock::now();
        const auto before = last_.exchange(now);
        if (before != std::chrono::steady_clock::time_point{})
            longest_silence_ = std::max(longest_silence_.load(), std::chrono::nanoseconds{now - before});
    }

    int fd_;
    std::atomic<std::chrono::steady_clock::time_point> last_{};
    std::atomic<std::chrono::nanoseconds> longest_silence_{};
    Transcript transcript_;
    Reader heard_{transcript_};
    std::jthread listener_;
};

} // namespace dpslave::test
