// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "dpctl/cli/words.hpp"

#include "dpslave/base/printable.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

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

/// What of the replies of Watch a command follows.
struct Followed {
    std::string (*picture)(const Json& now, Look look);
    std::vector<std::string> (*changes)(const Json& before, const Json& now);
};

/// A reply in which only something else is different is left out, but the first.
void show_one(const Followed& followed, const Json& before, const Json& now, const Options& options,
              Terminal& terminal)
{
    const std::vector<std::string> lines = followed.changes(before, now);
    if (!options.json && terminal.tty)
        redraw(followed.picture(now, terminal.look()), terminal.out);
    else if (!options.json)
        for (const std::string& line : lines) terminal.out << line << '\n';
    else if (!lines.empty() || before.empty())
        terminal.out << printable_json(now.dump(-1, ' ', false, Json::error_handler_t::replace)) << '\n';
    terminal.out << std::flush;
}

int follow(const Followed& followed, const Options& options, Terminal& terminal)
{
    Json before = Json::object();
    return follow_replies(options, terminal, "Watch", station_parameter(options),
                          [&](const control::ReplyMessage& reply) {
                              if (before.empty() && terminal.tty && !options.json) terminal.out << "\033[2J";
                              Json now = options.json ? reply.parameters : printable_texts(reply.parameters);
                              show_one(followed, before, now, options, terminal);
                              before = std::move(now);
                              return false;
                          });
}

} // namespace

int follow_status(const Options& options, Terminal& terminal)
{
    return follow({render_followed_status, status_changes}, options, terminal);
}

int follow_io(const Options& options, Terminal& terminal)
{
    return follow({render_followed_io, io_changes}, options, terminal);
}

} // namespace dpslave::dpctl
