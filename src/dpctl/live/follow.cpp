// SPDX-License-Identifier: Apache-2.0
#include "follow.hpp"

#include "dpctl/cli/words.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

/// Draws over the last picture: from the top, line by line, without wrapping, no more than there are rows.
void redraw(const std::string& picture, std::ostream& out)
{
    winsize size{};
    const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 1;
    int rows = known ? size.ws_row - 1 : 10'000;
    out << "\033[H\033[?7l";
    for (std::size_t at = 0; at < picture.size() && rows-- > 0;) {
        const std::size_t end = std::min(picture.find('\n', at), picture.size());
        out << picture.substr(at, end - at) << "\033[K\r\n";
        at = end + 1;
    }
    out << "\033[J\033[?7h" << std::flush;
}

/// A reply in which only something else is different is left out, but the first.
void show_one(const Followed& followed, const Json& before, const Json& now, Session& session)
{
    Terminal& terminal = session.terminal();
    const std::vector<std::string> lines = followed.changes(before, now);
    if (!session.json() && terminal.tty)
        redraw(followed.picture(now, terminal.look()), terminal.out);
    else if (!session.json())
        for (const std::string& line : lines) terminal.out << line << '\n';
    else if (!lines.empty() || before.empty())
        session.print_line(now);
}

} // namespace

int follow_pictures(const Followed& followed, const std::string& station, Session& session)
{
    Json before = Json::object();
    return session.follow("Watch", station_parameter(station), [&](const Json& reply) {
        if (before.empty() && session.terminal().tty && !session.json()) session.terminal().out << "\033[2J";
        Json now = session.json() ? reply : printable_texts(reply);
        show_one(followed, before, now, session);
        before = std::move(now);
        return false;
    });
}

} // namespace dpslave::dpctl
