// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/signals.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

namespace dpslave::io {
namespace {

sigset_t listened_to()
{
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&set, signal);
    return set;
}

} // namespace

Signals::Signals()
{
    const sigset_t set = listened_to();
    if (const int error = ::pthread_sigmask(SIG_BLOCK, &set, nullptr); error != 0)
        throw std::system_error{error, std::system_category(), "pthread_sigmask"};
    std::signal(SIGPIPE, SIG_IGN);
    fd_ = Fd{::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC)};
    if (!fd_) throw std::system_error{errno, std::system_category(), "signalfd"};
}

std::optional<int> Signals::take()
{
    signalfd_siginfo info{};
    if (::read(fd_.get(), &info, sizeof info) != static_cast<ssize_t>(sizeof info)) return std::nullopt;
    return static_cast<int>(info.ssi_signo);
}

} // namespace dpslave::io
