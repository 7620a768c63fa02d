// SPDX-License-Identifier: Apache-2.0
/// Octets of callers of the control socket: the cutting into messages, and a server on a socket of its own.
/// Judged: messages are the same however the octets are cut; only a caller with the right reaches a method
/// that operates; parameters have the types of the description; every call has one reply; after all of it the
/// next caller is served.
#include "input.hpp"

#include "dpslave/control/server.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace {

using namespace dpslave;
using control::Json;
using fuzz::demand;

constexpr gid_t kOperators = 4242;
bool operates = false; ///< whether the caller of this input is an operator
bool waits = false;
control::ReplyTo read;
std::vector<control::ReplyTo> watches;

/// The parameters of each method after its description, by hand: name, type, may be left out.
struct Described {
    const char *name, *parameters;
    bool is_operation;
};
constexpr std::array kDescribed{
    Described{"GetVersion", "", false},
    Described{"GetStatus", "", false},
    Described{"ListStations", "", false},
    Described{"GetInfo", "station?s", false},
    Described{"GetIo", "station?s", false},
    Described{"GetDiagnosis", "station?s", false},
    Described{"GetCounters", "", false},
    Described{"GetBus", "", false},
    Described{"GetLeds", "station?s", false},
    Described{"GetTec", "station?s", false},
    Described{"Watch", "station?s", false},
    Described{"GetEvents", "station?s after?i", false},
    Described{"FindTags", "station?s name?s", false},
    Described{"ReadTag", "station?s tag!i", false},
    Described{"GetSurveyScope", "station?s rule?s", false},
    Described{"Survey", "station?s tag!i rule?s", true},
    Described{"WriteTag", "station?s tag!i value!s", true},
    Described{"ProbeDrive", "station?s yes?b", true},
    Described{"SetTec", "station?s parameter!s value!s yes?b", true},
    Described{"SetLogLevel", "level!s seconds?i", true},
    Described{"Reload", "dry_run?b", true},
    Described{"Trace", "from?s line?s all?b", true},
    Described{"GetSamples", "station?s tag!i seconds?i after?i", false},
    Described{"ListIncidents", "", true},
    Described{"GetIncident", "number!i offset?i", true},
};

void judge_parameters(const Described& method, const Json& parameters)
{
    std::string left = method.parameters;
    std::size_t found = 0;
    while (!left.empty()) {
        const std::string one = left.substr(0, left.find(' '));
        left.erase(0, one.size() + 1);
        const auto at = parameters.find(one.substr(0, one.size() - 2));
        if (at == parameters.end()) {
            demand(one[one.size() - 2] == '?', "a parameter that has to be there is there");
            continue;
        }
        ++found;
        const char type = one.back();
        demand(type == 's'   ? at->is_string()
               : type == 'i' ? at->is_number_integer()
                             : at->is_boolean(),
               "a parameter has its type");
    }
    demand(found == parameters.size(), "there are only the parameters that are described");
}

control::Reply answer(const Described& method, const Json& parameters, const control::Caller& caller)
{
    demand(!method.is_operation || operates, "only an operator operates");
    demand(caller.operates == operates, "a caller has its rights");
    judge_parameters(method, parameters);
    if (std::string_view{method.name} == "Watch") {
        watches.push_back(caller.reply_to);
        return control::Stream{};
    }
    if (std::string_view{method.name} == "ReadTag" && !waits) {
        waits = true;
        read = caller.reply_to;
        return control::Later{};
    }
    return control::Done{};
}

control::Methods methods()
{
    control::Methods all;
    for (const Described& method : kDescribed)
        all[method.name] = {method.is_operation ? control::Right::operate : control::Right::look,
                            [&method](const Json& parameters, const control::Caller& caller) {
                                return answer(method, parameters, caller);
                            }};
    return all;
}

class Bench {
public:
    Bench()
    {
        std::string name = (std::filesystem::temp_directory_path() / "dpslave-fuzz-XXXXXX").string();
        demand(::mkdtemp(name.data()) != nullptr, "there is a folder for the socket");
        folder_ = name;
        control::ServerSettings settings;
        settings.socket = folder_ / "s";
        settings.operator_group = kOperators;
        settings.operator_group_name = "operators";
        settings.identify = [](int) {
            control::Caller caller;
            caller.uid = 1000;
            if (operates) caller.groups.push_back(kOperators);
            return caller;
        };
        auto opened = control::Server::open(std::move(settings), methods());
        demand(static_cast<bool>(opened), "the server listens");
        server_ = *std::move(opened);
    }
    ~Bench()
    {
        server_.reset();
        std::filesystem::remove_all(folder_);
    }
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    int connect()
    {
        const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        (folder_ / "s").string().copy(address.sun_path, sizeof address.sun_path - 1);
        const void* any = &address;
        demand(::connect(fd, static_cast<const sockaddr*>(any), sizeof address) == 0, "a caller connects");
        settle();
        return fd;
    }
    void settle()
    {
        for (pollfd ready{server_->fd(), POLLIN, 0}; ::poll(&ready, 1, 0) > 0;) {
            server_->on_ready();
            if (waits) {
                read.end(control::Done{});
                waits = false;
            }
        }
    }
    /// What is there to read; `ended`: the server has ended the connection.
    static std::string take(int fd, bool& ended)
    {
        std::string all;
        std::array<char, 16384> some{};
        for (;;) {
            const auto n = ::recv(fd, some.data(), some.size(), 0);
            ended = ended || n == 0;
            if (n <= 0) return all;
            all.append(some.data(), static_cast<std::size_t>(n));
        }
    }
    control::Server& server() { return *server_; }

private:
    std::filesystem::path folder_;
    std::optional<control::Server> server_;
};

std::vector<std::string> messages_of(std::string_view octets)
{
    std::vector<std::string> messages;
    while (true) {
        const auto end = octets.find('\0');
        if (end == std::string_view::npos) return messages;
        messages.emplace_back(octets.substr(0, end));
        octets.remove_prefix(end + 1);
    }
}

/// Octets in pieces: raw ones, and calls that are right but for what the input puts into them.
std::vector<std::string> pieces_of(fuzz::Input& input)
{
    std::vector<std::string> pieces;
    while (!input.at_end() && pieces.size() < 40) {
        const std::uint8_t form = input.octet();
        const auto some = input.octets(form >> 2);
        std::string raw{some.begin(), some.end()};
        const Described& method = kDescribed[input.octet() % kDescribed.size()];
        const std::string head = std::string{R"({"method":"org.dpslaved.Control.)"} + method.name + '"';
        const std::string text = Json(raw).dump(-1, ' ', false, Json::error_handler_t::replace);
        switch (form % 4) {
            case 0: pieces.push_back(raw); break;
            case 1: pieces.push_back(raw + '\0'); break;
            case 2: pieces.push_back(head + R"(,"parameters":{)" + raw + "}}" + '\0'); break;
            default: {
                constexpr std::array flags{"", R"(,"oneway":true)", R"(,"more":true)"};
                pieces.push_back(head + flags[form % flags.size()] + R"(,"parameters":{"station":)" + text +
                                 (some.size() % 2 == 0 ? R"(,"tag":7)" : R"(,"value":)" + text) + "}}" +
                                 '\0');
                break;
            }
        }
    }
    return pieces;
}

void judge_framing(const std::string& octets, std::size_t piece)
{
    constexpr std::size_t kLimit = 200;
    control::Framer framer{kLimit};
    std::vector<std::string> cut;
    for (std::size_t from = 0; from < octets.size(); from += piece) {
        const std::string some = octets.substr(from, piece);
        if (some.size() > framer.room()) return;
        framer.feed(some);
        while (true) {
            const auto next = framer.next();
            if (!next) {
                demand(octets.find('\0', octets.size() > kLimit ? 0 : octets.size()) == std::string::npos ||
                           octets.size() > kLimit,
                       "only what is too long is refused");
                return;
            }
            if (!*next) break;
            cut.emplace_back(**next);
        }
    }
    demand(cut == messages_of(octets), "messages are the same however the octets are cut");
}

/// True: the text is a call that wants a reply.
bool wants_reply(const std::string& message)
{
    const Json call = Json::parse(message, nullptr, false);
    return call.is_object() && !(call.contains("oneway") && call["oneway"] == true);
}

void judge_server(Bench& bench, const std::vector<std::string>& pieces)
{
    const auto before = bench.server().counters();
    const int caller = bench.connect();
    std::string replies, sent;
    bool ended = false;
    for (const std::string& piece : pieces) {
        if (::send(caller, piece.data(), piece.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(piece.size()))
            break;
        sent += piece;
        bench.settle();
        replies += Bench::take(caller, ended);
    }
    bench.settle();
    replies += Bench::take(caller, ended);
    const auto& after = bench.server().counters();
    demand(after.handler_failures == before.handler_failures, "no handler throws");
    const auto calls = messages_of(sent);
    const auto answers = messages_of(replies);
    for (const std::string& answer : answers) {
        const Json reply = Json::parse(answer, nullptr, false);
        demand(reply.is_object() && (!reply.contains("error") || reply["error"].is_string()),
               "a reply is Varlink");
    }
    demand(answers.size() <= calls.size(), "there are not more replies than calls");
    if (after.malformed == before.malformed && after.too_slow == before.too_slow) {
        demand(!ended, "a caller that sends Varlink is kept");
        demand(answers.size() == static_cast<std::size_t>(std::ranges::count_if(calls, wants_reply)),
               "every call has one reply");
    } else {
        demand(ended, "who sends no Varlink loses its connection");
    }
    ::close(caller);
    bench.settle();

    const int next = bench.connect();
    constexpr std::string_view kCall{"{\"method\":\"org.dpslaved.Control.GetVersion\"}\0", 45};
    ::send(next, kCall.data(), kCall.size(), MSG_NOSIGNAL);
    bench.settle();
    bool lost = false;
    demand(!Bench::take(next, lost).empty() && !lost, "the next caller is served");
    ::close(next);
    bench.settle();
    for (const control::ReplyTo& watch : std::exchange(watches, {}))
        demand(!watch.send(Json::object()), "who has gone gets no further reply");
    demand(bench.server().clients() == 0, "who has gone is forgotten");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static Bench bench;
    fuzz::Input input{data, size};
    const std::uint8_t head = input.octet();
    operates = head % 2 != 0;
    waits = false;
    const auto pieces = pieces_of(input);
    std::string all;
    for (const std::string& piece : pieces) all += piece;
    judge_framing(all, 1 + (head >> 1));
    judge_server(bench, pieces);
    return 0;
}
