// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/live/tag_names.hpp"
#include "dpctl/top/observer.hpp"
#include "dpctl/top/render_top.hpp"
#include "dpctl/top/screen.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

namespace dpslave::dpctl {
namespace {

struct TopOptions {
    std::string station;
    std::optional<std::chrono::nanoseconds> every; ///< nothing: not said
};

void set_up(CLI::App& app, TopOptions& options)
{
    add_station(app, options.station);
    add_time(app, "--every", options.every,
             "Time from one refresh to the next; into a pipe: print again and again. Default: 1s",
             kIntervals);
}

std::chrono::milliseconds interval_of(const TopOptions& options)
{
    return std::chrono::ceil<std::chrono::milliseconds>(options.every.value_or(std::chrono::seconds{1}));
}

/// On a terminal, until q or a signal. Returns why it ended.
Stopped show_screens(Observer& observer, const TopOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    Screen screen{terminal.out};
    const TopLook look{terminal.look(), terminal.utf8};
    TopState state;
    const auto draw = [&] {
        if (!state.is_empty()) screen.draw(render_top(state, screen.size(), look));
    };
    session.wake_by(screen.fd(), [&] {
        const Screen::Input input = screen.fetch();
        const bool goes_on = std::all_of(input.keys.begin(), input.keys.end(),
                                         [&](const Key& key) { return state.on_key(key); });
        if (!goes_on || input.is_end) return false;
        if (input.wants_redraw || !input.keys.empty()) draw();
        return true;
    });
    for (Pace pace{interval_of(options)}; terminal.out;) {
        const auto replies = observer.look();
        if (!replies) return replies.error();
        auto [sighting, events] = read_replies(*replies);
        state.add(std::move(sighting), events);
        draw();
        if (session.pause_until(pace.next())) return {};
    }
    return {};
}

/// Into a pipe, or as JSON. Text begins with the second look, for only then are there rates.
Stopped print_screens(Observer& observer, const TopOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    session.catch_signals();
    const TopLook look{terminal.look(), terminal.utf8};
    TopState state;
    for (Pace pace{interval_of(options)}; terminal.out;) {
        const auto replies = observer.look();
        if (!replies) return replies.error();
        const bool has_before = state.before() != nullptr;
        if (session.json() && !options.every) {
            session.print(replies->all, {});
            return {};
        }
        if (session.json()) {
            session.print_line(replies->all);
            terminal.out << std::flush;
        } else {
            auto [sighting, events] = read_replies(*replies);
            const bool is_first = state.is_empty();
            state.add(std::move(sighting), events);
            if (!is_first)
                terminal.out << (has_before ? "\n" : "") << render_top_whole(state, look) << std::flush;
            if (!is_first && !options.every) return {};
        }
        if (session.pause_until(pace.next())) return {};
    }
    return {};
}

int run(const TopOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    if (const auto failed = session.connect()) return session.print_stopped({failed, {}});
    Observer observer{session, options.station};
    const bool on_screen = terminal.cursor && !session.json();
    const Stopped stopped =
        on_screen ? show_screens(observer, options, session) : print_screens(observer, options, session);
    session.wake_by(-1, {});                                    // the screen is gone
    return terminal.out ? session.print_stopped(stopped) : kNo; // on a terminal that is what it was before
}

} // namespace

const Command kTop{"top",
                   kWatch,
                   "Shows stations, values, rates and events on one screen that refreshes",
                   add<TopOptions>,
                   kOwnForm,
                   "dpctl top                 q ends it, arrows select a station, / filters\n"
                   "dpctl top unwinder        only this station\n"
                   "dpctl top --every 10s | tee top.txt",
                   "0 also after q and Ctrl-C"};

} // namespace dpslave::dpctl
