// SPDX-License-Identifier: Apache-2.0
#include "end_signals.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace dpslave::dpctl {

EndSignals::EndSignals()
{
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGHUP);
    ::sigprocmask(SIG_BLOCK, &signals, &before_);
    fd_ = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
}

EndSignals::~EndSignals()
{
    signalfd_siginfo fetched;
    while (fd_ >= 0 && ::read(fd_, &fetched, sizeof fetched) > 0) {
    } // else it strikes when it is unblocked
    if (fd_ >= 0) ::close(fd_);
    ::sigprocmask(SIG_SETMASK, &before_, nullptr);
}

bool becomes_readable(int fd, int milliseconds)
{
    pollfd one{.fd = fd, .events = POLLIN, .revents = 0};
    return ::poll(&one, 1, milliseconds) > 0;
}

} // namespace dpslave::dpctl
