// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/end_signals.hpp"
#include "dpctl/cli/explain.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"
#include "tag_names.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>
#include <chrono>

namespace dpslave::dpctl {
namespace {

std::string one_line(const Json& value)
{
    return printable_json(value.dump(-1, ' ', false, Json::error_handler_t::replace)) + '\n';
}

/// An answer of the drive, or why there is none: with --every the next round may have one.
bool passes(const control::ReplyMessage& reply)
{
    return reply.error == "org.dpslaved.Control.DriveRefused" || reply.error == "org.dpslaved.Control.Busy";
}

/// `is_repeated`: with the time of day in front.
void print(const control::ReplyMessage& reply, bool is_repeated, const Options& options, Terminal& terminal)
{
    if (options.json) {
        terminal.out << one_line(
            reply.error.empty() ? reply.parameters
                                : Json::object({{"error", reply.error}, {"parameters", reply.parameters}}));
    } else if (!reply.error.empty()) {
        terminal.err << "dpctl: "
                     << explain({printable_texts(reply.parameters), printable(reply.error), false})
                     << std::endl;
    } else {
        terminal.out << (is_repeated ? time_of_day(std::chrono::system_clock::now()) + " " : std::string{})
                     << render_tag(printable_texts(reply.parameters), "is");
    }
    terminal.out << std::flush;
}

/// One tag after the other, over one connection: at most one read of ours waits in the daemon at any time.
class Reader {
public:
    Reader(const std::vector<std::int64_t>& tags, const Options& options, Terminal& terminal)
        : tags_(tags), options_(options), terminal_(terminal)
    {}

    /// The exit code. `every`: the time from the beginning of a round to that of the next one; none: one
    /// round.
    int run(std::optional<std::chrono::milliseconds> every)
    {
        using Clock = std::chrono::steady_clock;
        auto client = control::Client::connect(options_.socket, options_.timeout());
        if (!client) return print_error(client.error(), terminal_);
        for (auto next = Clock::now();;) {
            if (const auto code = round(*client, every.has_value())) return *code;
            if (!every) return failed_ ? kNo : kFine;
            next = std::max(next + *every, Clock::now()); // what took too long is not made up for
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now());
            if (end_.within(static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 1'000'000'000))))
                return kFine;
            if (!terminal_.out) return kNo; // what we print is not taken any more
        }
    }

private:
    /// Nothing: go on.
    std::optional<int> round(control::Client& client, bool is_repeated)
    {
        for (const std::int64_t tag : tags_) {
            Json parameters = station_parameter(options_);
            parameters["tag"] = tag;
            if (const auto gone = client.start("ReadTag", parameters)) return print_gone(*gone, terminal_);
            const auto reply = client.next(end_.fd());
            if (!reply) return print_gone(reply.error(), terminal_);
            if (!*reply) return kFine; // Ctrl-C
            if (!(*reply)->error.empty() && !passes(**reply))
                return print_error(**reply, options_, terminal_);
            failed_ = failed_ || !(*reply)->error.empty();
            print(**reply, is_repeated, options_, terminal_);
        }
        return std::nullopt;
    }

    const EndSignals end_;
    const std::vector<std::int64_t>& tags_;
    const Options& options_;
    Terminal& terminal_;
    bool failed_ = false;
};

} // namespace

int do_read(const Options& options, Terminal& terminal)
{
    if (options.list) return list_tags(options, terminal);
    if (options.words.empty()) {
        terminal.err << "dpctl: name a tag; dpctl read --list prints the names\n"
                        "Run with --help for more information.\n";
        return kUsage;
    }
    const auto tags = find_tags(options, terminal);
    if (!tags) return tags.error();
    if (tags->size() > 1 || !options.every.empty())
        return Reader{*tags, options, terminal}.run(parse_interval(options.every));
    Json parameters = station_parameter(options);
    parameters["tag"] = tags->front();
    return show(options, terminal, "ReadTag", parameters,
                [](const Json& reply) { return render_tag(reply, "is"); });
}

} // namespace dpslave::dpctl
