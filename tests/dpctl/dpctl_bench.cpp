// SPDX-License-Identifier: Apache-2.0
#include "dpctl_bench.hpp"

#include "control/fixtures.hpp"
#include "control/interface.hpp"
#include "support/paths.hpp"

#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <pty.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utmp.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace dpslave::test {
namespace {

constexpr int kDpctlPatience = 60'000; ///< ms
constexpr uid_t kUnprivileged = 65534;

using control::Done;
using control::Error;
using control::Reply;

} // namespace

// ---------------------------------------------------------------- the daemon

namespace {

Json with_behind_each_text(Json value, const std::string& added)
{
    if (value.is_string()) return value.get<std::string>() + added;
    if (value.is_structured())
        for (Json& item : value) item = with_behind_each_text(std::move(item), added);
    return value;
}

} // namespace

Json FixtureDaemon::reply(const std::string& method) const
{
    Json all = fixture(method);
    const std::lock_guard lock(mutex_);
    if (method == "GetStatus")
        for (Json& station : all["stations"])
            if (const auto found = states_.find(station["name"]); found != states_.end())
                station["state"] = found->second;
    return with_behind_each_text(std::move(all), behind_each_text_);
}

FixtureDaemon::FixtureDaemon(std::string behind_each_text)
    : behind_each_text_(std::move(behind_each_text)),
      stop_(::eventfd(0, EFD_CLOEXEC)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK))
{
    control::ServerSettings settings;
    settings.socket = socket_;
    settings.operator_group_name = "dpslaved";
    auto server = control::Server::open(settings, methods());
    if (!server) throw std::runtime_error(server.error());
    thread_ = std::thread([this, own = *std::move(server)]() mutable {
        std::array<pollfd, 4> ready{
            {{own.fd(), POLLIN, 0}, {stop_, POLLIN, 0}, {wake_, POLLIN, 0}, {event_, POLLIN, 0}}};
        while (::poll(ready.data(), ready.size(), -1) > 0 && ready[1].revents == 0) {
            own.on_ready();
            for (const auto& [caller, reply] : std::exchange(answers_, {})) caller.end(reply);
            if (std::exchange(second_picture_due_, false)) {
                Json picture = reply("Watch");
                picture["stations"][0]["state"] = "Wait_Prm";
                for (const control::ReplyTo& watch : watches_) watch.send(picture);
            }
            push_line();
            eventfd_t woken = 0;
            if (::eventfd_read(event_, &woken) == 0) push_events();
            if (::eventfd_read(wake_, &woken) == 0) {
                Json picture = reply("Watch");
                picture["stations"][0]["state"] = "Wait_Prm";
                picture["words"][0]["words"][0]["value"] = "51.00";
                for (const control::ReplyTo& watch : watches_) watch.send(picture);
            }
        }
    });
}

FixtureDaemon::~FixtureDaemon()
{
    ::eventfd_write(stop_, 1);
    thread_.join();
    ::close(stop_);
    ::close(wake_);
    ::close(event_);
}

void FixtureDaemon::something_happens()
{
    ::eventfd_write(event_, 1);
}

/// The end of a trace with drive lines: that line has no records.
void FixtureDaemon::push_line()
{
    if (!trace_.is_open()) return;
    Json line = reply("Trace");
    line["line"] = "p3";
    line["records"] = "";
    line["lost"] = 0;
    std::exchange(trace_, {}).send(line);
}

void FixtureDaemon::push_events()
{
    const Json event = {{"number", 4},
                        {"age_ms", 1.0},
                        {"station", "unwinder"},
                        {"kind", "drive"},
                        {"text", "unwinder: the drive does not answer"},
                        {"count", 1}};
    for (const control::ReplyTo& follower : events_followed_)
        follower.send({{"events", Json::array({event})}, {"lost", 0}, {"newest", 4}});
}

bool FixtureDaemon::was_read(std::size_t times)
{
    std::unique_lock lock(mutex_);
    return asked_.wait_for(lock, std::chrono::milliseconds{kDpctlPatience},
                           [&] { return read_.size() >= times; });
}

void FixtureDaemon::set_state(const std::string& station, const std::string& state)
{
    const std::lock_guard lock(mutex_);
    states_[station] = state;
}

bool FixtureDaemon::was_asked(const std::string& method)
{
    std::unique_lock lock(mutex_);
    return asked_.wait_for(lock, std::chrono::milliseconds{kDpctlPatience},
                           [&] { return questions_.contains(method); });
}

void FixtureDaemon::change_value()
{
    ::eventfd_write(wake_, 1);
}

control::Methods FixtureDaemon::methods()
{
    control::Methods all = quiet_methods();
    for (auto& [name, method] : all) {
        method.answer = [this, name = name](const Json& parameters, const control::Caller&) -> Reply {
            {
                const std::lock_guard lock(mutex_);
                questions_.insert(name);
            }
            asked_.notify_all();
            const std::string station = parameters.value("station", "unwinder");
            if (station == "unwinder" || station == "rewinder" || station == "5" || station == "16")
                return Done{reply(name)};
            const Json known = Json::array({"unwinder", "rewinder"});
            return Error{"NoSuchStation", Json::object({{"station", station}, {"known", known}})};
        };
    }
    all["ReadTag"].answer = [this](const Json& parameters, const control::Caller& caller) {
        if (parameters.contains("station")) {
            const std::lock_guard lock(mutex_);
            read_.push_back(parameters.at("tag").get<int>());
        }
        asked_.notify_all();
        return tag(parameters, caller);
    };
    all["FindTags"].answer = [](const Json& parameters, const control::Caller&) {
        return find_tags(parameters);
    };
    all["GetEvents"].answer = [this](const Json&, const control::Caller& caller) -> Reply {
        if (!caller.more) return Done{reply("GetEvents")};
        events_followed_.push_back(caller.reply_to);
        return control::Stream{reply("GetEvents")};
    };
    all["SetLogLevel"].answer = [this](const Json& parameters, const control::Caller&) -> Reply {
        {
            const std::lock_guard lock(mutex_);
            written_ = parameters;
        }
        return Done{reply("SetLogLevel")};
    };
    all["WriteTag"].answer = [this](const Json& parameters, const control::Caller& caller) {
        {
            const std::lock_guard lock(mutex_);
            written_ = parameters;
        }
        return tag(parameters, caller);
    };
    all["Survey"].answer = [this](const Json& parameters, const control::Caller&) {
        return survey(parameters);
    };
    all["SetTec"].answer = [this](const Json& parameters, const control::Caller&) -> Reply {
        if (parameters.at("parameter") == "FAULT")
            return Error{
                "BadTecValue",
                Json::object({{"parameter", "FAULT"}, {"value", "1"}, {"reason", "it is an output"}})};
        {
            const std::lock_guard lock(mutex_);
            written_ = parameters;
        }
        return Done{reply("SetTec")};
    };
    all["Trace"].answer = [this](const Json& parameters, const control::Caller& caller) -> Reply {
        if (!parameters.value("all", false)) return Done{reply("Trace")};
        Json bus = reply("Trace");
        bus["caught_up"] = false;
        bus["records"] = "AwAAAAQAAAAEAAAAAAAAAAAvaFkAAAAAAAAAAAAAAABoDQ0="; // 68 0D 0D at 1.5 s
        trace_ = caller.reply_to;
        return control::Stream{bus};
    };
    all["Watch"].answer = [this](const Json&, const control::Caller& caller) {
        second_picture_due_ = true;
        watches_.push_back(caller.reply_to);
        return control::Stream{reply("Watch")};
    };
    return all;
}

Reply FixtureDaemon::survey(const Json& parameters)
{
    const int tag = parameters.at("tag").get<int>();
    ++surveyed_[tag];
    if (tag == 5 && surveyed_[tag] == 1) return Error{"Busy", Json::object()};
    const std::map<int, const char*> texts{{1, "12.5"}, {4, ">1B0B"}, {5, "30."}, {9, "7."}};
    const auto found = texts.find(tag);
    const bool lost = tag == 5 && surveyed_[tag] == 2;
    Json reply = {{"station", "unwinder"},
                  {"tag", tag},
                  {"mnemonic", "a" + std::to_string(tag)},
                  {"outcome", lost                   ? "lost"
                              : found != texts.end() ? "value"
                              : tag == 3             ? "silence"
                                                     : "denied"},
                  {"text", nullptr},
                  {"raw", nullptr},
                  {"reason", nullptr}};
    if (found != texts.end() && !lost) reply["text"] = found->second;
    if (reply["outcome"] == "denied") reply["reason"] = "invalid tag";
    return Done{reply};
}

/// As the daemon does: a part of the name in any case, or the whole name alone.
Reply FixtureDaemon::find_tags(const Json& parameters)
{
    const std::map<std::string, std::vector<int>> found{
        {"", {7, 8, 9}},       {"SPEED FEEDBACK", {7}}, {"speed feedback", {7}}, {"feedback", {7}},
        {"speed demand", {8}}, {"torq", {9}},           {"speed", {7, 8}}};
    const std::map<int, const char*> names{{7, "SPEED FEEDBACK"}, {8, "SPEED DEMAND"}, {9, "TORQUE"}};
    Json tags = Json::array();
    if (const auto one = found.find(parameters.value("name", "")); one != found.end())
        for (const int number : one->second) tags.push_back({{"tag", number}, {"name", names.at(number)}});
    return Done{{{"station", "unwinder"}, {"tags", std::move(tags)}}};
}

Reply FixtureDaemon::tag(const Json& parameters, const control::Caller& caller)
{
    const auto number = parameters.at("tag").get<int>();
    if (!parameters.contains("station"))
        return Error{"StationRequired", Json::object({{"known", Json::array({"unwinder", "rewinder"})}})};
    if (number == 1)
        answers_.emplace_back(
            caller.reply_to,
            Error{"DriveRefused",
                  Json::object({{"tag", 1}, {"reason", "read only" + behind_each_text_}, {"code", 1}})});
    else if (number != 2)
        answers_.emplace_back(caller.reply_to,
                              Done{reply(parameters.contains("value") ? "WriteTag" : "ReadTag")});
    return control::Later{};
}

// ---------------------------------------------------------------- the program

Dpctl::Dpctl(std::vector<std::string> arguments, As user, bool terminal)
{
    arguments.insert(arguments.begin(), program_path("dpctl"));
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::string term = "TERM=xterm"; // whatever the test runs in
    std::vector<char*> environment;
    for (char** one = environ; *one != nullptr; ++one)
        if (!terminal || !std::string_view{*one}.starts_with("TERM=")) environment.push_back(*one);
    if (terminal) environment.push_back(term.data());
    environment.push_back(nullptr);
    std::array<int, 2> out{}, err{};
    if (::pipe2(err.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    if (terminal ? ::openpty(&out[0], &out[1], nullptr, nullptr, nullptr) != 0
                 : ::pipe2(out.data(), O_CLOEXEC) != 0)
        throw std::runtime_error("output");
    if (terminal) ::fcntl(out[0], F_SETFD, FD_CLOEXEC);

    pid_ = ::fork();
    if (pid_ == 0) {
        if (terminal) ::login_tty(out[1]); // standard input and output, and the signals of its keys
        if (!terminal) ::dup2(out[1], STDOUT_FILENO);
        ::dup2(err[1], STDERR_FILENO);
        // Opened with the rights of the test: the other user may not reach a checkout in a private folder.
        const int program = ::open(argv[0], O_PATH | O_CLOEXEC);
        if (user == As::unprivileged &&
            (::setgroups(0, nullptr) != 0 || ::setgid(kUnprivileged) != 0 || ::setuid(kUnprivileged) != 0))
            ::_exit(126);
        ::fexecve(program, argv.data(), environment.data());
        ::_exit(127);
    }
    ::close(out[1]);
    ::close(err[1]);
    out_ = out[0];
    err_ = err[0];
}

Dpctl::~Dpctl()
{
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    ::close(out_);
    ::close(err_);
}

/// False: both outputs have ended, or nothing came for long.
bool Dpctl::read_some()
{
    std::array<pollfd, 2> ready{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    if (::poll(ready.data(), ready.size(), kDpctlPatience) <= 0) return false;
    std::array<char, 4096> chunk;
    bool more = false;
    for (std::size_t i = 0; i < ready.size(); ++i) {
        if (ready[i].revents == 0) continue;
        const auto n = ::read(ready[i].fd, chunk.data(), chunk.size());
        if (n > 0) (i == 0 ? ran_.out : ran_.err).append(chunk.data(), static_cast<std::size_t>(n));
        if (n <= 0) { // ended; a pty says EIO
            if (i == 0) ran_.echoes = echoes();
            ::close(ready[i].fd);
            (i == 0 ? out_ : err_) = -1;
        }
        more = true;
    }
    return more && (out_ >= 0 || err_ >= 0);
}

bool Dpctl::prints(const std::string& text)
{
    while (ran_.out.find(text) == std::string::npos)
        if (!read_some()) return ran_.out.find(text) != std::string::npos;
    return true;
}

void Dpctl::type(std::string_view keys)
{
    if (::write(out_, keys.data(), keys.size()) < 0) throw std::runtime_error("type");
}
void Dpctl::resize(unsigned short columns, unsigned short rows)
{
    const winsize size{.ws_row = rows, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    if (::ioctl(out_, TIOCSWINSZ, &size) != 0) throw std::runtime_error("resize");
}
bool Dpctl::echoes() const
{
    termios now{};
    return ::tcgetattr(out_, &now) == 0 && (now.c_lflag & (ECHO | ICANON)) == (ECHO | ICANON);
}
void Dpctl::signal(int number)
{
    ::kill(pid_, number);
}

bool Dpctl::stands_still()
{
    int status = 0;
    ::waitpid(pid_, &status, WUNTRACED);
    if (!WIFSTOPPED(status)) pid_ = -1;
    return WIFSTOPPED(status);
}

Ran Dpctl::wait()
{
    while (read_some()) {
    }
    int status = 0;
    ::waitpid(std::exchange(pid_, -1), &status, 0);
    ran_.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return ran_;
}

Ran dpctl(std::vector<std::string> arguments, Dpctl::As user)
{
    return Dpctl{std::move(arguments), user}.wait();
}

} // namespace dpslave::test
