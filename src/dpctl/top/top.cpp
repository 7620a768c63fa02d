// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/end_signals.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/live/tag_names.hpp"
#include "observer.hpp"
#include "render_top.hpp"
#include "screen.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>
#include <chrono>

namespace dpslave::dpctl {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Until `then`, at least 0.
int milliseconds_until(SteadyClock::time_point then)
{
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(then - SteadyClock::now());
    return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 1'000'000'000));
}

/// The moments of the refreshes. What took too long is not made up for.
class Turns {
public:
    explicit Turns(std::chrono::milliseconds every) : every_(every) {}
    /// The moment of the next one.
    SteadyClock::time_point next() { return due_ = std::max(due_ + every_, SteadyClock::now()); }

private:
    std::chrono::milliseconds every_;
    SteadyClock::time_point due_ = SteadyClock::now();
};

std::chrono::milliseconds interval_of(const Options& options)
{
    return parse_interval(options.every).value_or(std::chrono::seconds{1});
}

/// The exit code; prints why, on a terminal that is what it was before.
int print_stopped(const Stopped& stopped, const Options& options, Terminal& terminal)
{
    if (stopped.refused) return print_error(*stopped.refused, options, terminal);
    return stopped.failed ? print_gone(*stopped.failed, terminal) : static_cast<int>(kFine);
}

/// On a terminal, until q or a signal. Returns why it ended.
Stopped show_screens(Observer& observer, const Options& options, Terminal& terminal)
{
    Screen screen{terminal.out};
    const TopLook look{terminal.look(), terminal.utf8};
    TopState state;
    const auto draw = [&] {
        if (!state.is_empty()) screen.draw(render_top(state, screen.size(), look));
    };
    const auto on_input = [&] {
        const Screen::Input input = screen.fetch();
        const bool goes_on = std::all_of(input.keys.begin(), input.keys.end(),
                                         [&](const Key& key) { return state.on_key(key); });
        if (!goes_on || input.is_end) return false;
        if (input.wants_redraw || !input.keys.empty()) draw();
        return true;
    };
    for (Turns turns{interval_of(options)}; terminal.out;) {
        const auto replies = observer.look(screen.fd(), on_input);
        if (!replies) return replies.error();
        auto [sighting, events] = read_replies(*replies);
        state.add(std::move(sighting), events);
        draw();
        for (const auto next = turns.next(); SteadyClock::now() < next;) {
            screen.wait(milliseconds_until(next));
            if (!on_input()) return {};
        }
    }
    return {};
}

/// One JSON object; with --every one a line.
void print_json(const Json& all, const Options& options, Terminal& terminal)
{
    terminal.out << (options.every.empty()
                         ? json_text(all)
                         : printable_json(all.dump(-1, ' ', false, Json::error_handler_t::replace)))
                 << std::endl;
}

/// Into a pipe, or as JSON. Text begins with the second look, for only then are there rates.
Stopped print_screens(Observer& observer, const Options& options, Terminal& terminal)
{
    const EndSignals end;
    const auto on_end = [] { return false; };
    const TopLook look{terminal.look(), terminal.utf8};
    TopState state;
    for (Turns turns{interval_of(options)}; terminal.out;) {
        const auto replies = observer.look(end.fd(), on_end);
        if (!replies) return replies.error();
        const bool has_before = state.before() != nullptr;
        if (options.json) {
            print_json(replies->all, options, terminal);
            if (options.every.empty()) return {};
        } else {
            auto [sighting, events] = read_replies(*replies);
            const bool is_first = state.is_empty();
            state.add(std::move(sighting), events);
            if (!is_first)
                terminal.out << (has_before ? "\n" : "") << render_top_whole(state, look) << std::flush;
            if (!is_first && options.every.empty()) return {};
        }
        if (end.within(milliseconds_until(turns.next()))) return {};
    }
    return {};
}

} // namespace

int do_top(const Options& options, Terminal& terminal)
{
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return print_error(client.error(), terminal);
    Observer observer{*std::move(client), options};
    const bool on_screen = terminal.cursor && !options.json;
    const Stopped stopped =
        on_screen ? show_screens(observer, options, terminal) : print_screens(observer, options, terminal);
    return terminal.out ? print_stopped(stopped, options, terminal) : kNo;
}

} // namespace dpslave::dpctl
