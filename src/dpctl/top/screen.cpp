// SPDX-License-Identifier: Apache-2.0
#include "screen.hpp"

#include "dpctl/cli/end_signals.hpp"

#include <sys/epoll.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace dpslave::dpctl {
namespace {

/// Alternate screen, no cursor, no wrapping at the edge: a line that a terminal takes for wider stays one
/// line.
constexpr const char* kEnterScreen = "\033[?1049h\033[?25l\033[?7l\033[2J";
constexpr const char* kLeaveScreen = "\033[?7h\033[?25h\033[?1049l";

/// SIGCONT is not among them: it works also while it is blocked.
sigset_t awaited_signals()
{
    sigset_t signals;
    sigemptyset(&signals);
    for (const int one : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGWINCH}) sigaddset(&signals, one);
    return signals;
}

void add_readable(int epoll, int fd)
{
    epoll_event wanted{.events = EPOLLIN, .data = {.fd = fd}};
    ::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &wanted);
}

} // namespace

Screen::Screen(std::ostream& out) : out_(out)
{
    const sigset_t signals = awaited_signals();
    ::sigprocmask(SIG_BLOCK, &signals, &signals_before_);
    signals_ = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
    epoll_ = ::epoll_create1(EPOLL_CLOEXEC);
    add_readable(epoll_, signals_);
    termios now{};
    if (::tcgetattr(STDIN_FILENO, &now) == 0) {
        before_ = now;
        add_readable(epoll_, STDIN_FILENO);
    }
    enter();
}

Screen::~Screen()
{
    leave();
    signalfd_siginfo fetched;
    while (signals_ >= 0 && ::read(signals_, &fetched, sizeof fetched) > 0) {
    } // else it strikes when it is unblocked
    if (signals_ >= 0) ::close(signals_);
    if (epoll_ >= 0) ::close(epoll_);
    ::sigprocmask(SIG_SETMASK, &signals_before_, nullptr);
}

/// Ctrl-C and Ctrl-Z stay signals.
void Screen::enter()
{
    if (before_) {
        termios keys = *before_;
        keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        keys.c_cc[VMIN] = 0;
        keys.c_cc[VTIME] = 0;
        ::tcsetattr(STDIN_FILENO, TCSADRAIN, &keys);
    }
    out_ << kEnterScreen << std::flush;
}

void Screen::leave()
{
    out_ << kLeaveScreen << std::flush;
    if (before_) ::tcsetattr(STDIN_FILENO, TCSADRAIN, &*before_);
}

Screen::Input Screen::fetch()
{
    Input all;
    fetch_signals(all);
    if (before_) fetch_keys(all);
    return all;
}

void Screen::fetch_signals(Input& into)
{
    signalfd_siginfo one{};
    while (::read(signals_, &one, sizeof one) == sizeof one) {
        const auto number = static_cast<int>(one.ssi_signo);
        into.wants_redraw = into.wants_redraw || number == SIGWINCH || number == SIGTSTP;
        into.is_end = into.is_end || (number != SIGWINCH && number != SIGTSTP);
        if (number != SIGTSTP) continue;
        leave();
        ::raise(SIGSTOP); // goes on with SIGCONT
        enter();
    }
}

void Screen::fetch_keys(Input& into)
{
    while (becomes_readable(STDIN_FILENO, 0)) {
        std::array<char, 256> octets;
        const auto got = ::read(STDIN_FILENO, octets.data(), octets.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) { // the terminal has gone, or sends the end of a file
            into.is_end = true;
            return;
        }
        const auto keys = reader_.read({octets.data(), static_cast<std::size_t>(got)});
        into.keys.insert(into.keys.end(), keys.begin(), keys.end());
        if (into.keys.size() > 1000) return; // what is typed faster has to wait
    }
}

ScreenSize Screen::size() const
{
    winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0 || size.ws_col == 0) return {};
    return {std::min<std::size_t>(size.ws_col, 1000), std::min<std::size_t>(size.ws_row, 1000)};
}

void Screen::draw(const std::vector<std::string>& lines)
{
    // Erased before it is written: at the right edge the cursor stands on the last character, not behind it.
    std::string all = "\033[H";
    for (std::size_t i = 0; i < lines.size(); ++i) all += (i > 0 ? "\r\n\033[2K" : "\033[2K") + lines[i];
    if (lines.size() < size().rows) all += "\r\n\033[J";
    out_ << all << std::flush;
}

} // namespace dpslave::dpctl
