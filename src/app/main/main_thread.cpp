// SPDX-License-Identifier: Apache-2.0
#include "main_thread.hpp"

#include "device_state.hpp"

#include "dpslave/app/version.hpp"
#include "dpslave/io/clock.hpp"
#include "dpslave/report/words.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>

namespace dpslave::app {

namespace {

constexpr std::uint64_t kServerKey = 0;
constexpr std::uint64_t kSignalKey = 1;

constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::milliseconds kTickWithDiagnosis{20}; // a trip reaches the master soon
constexpr std::chrono::milliseconds kTickWhilePending{5};   // while a call waits for a drive or a reload

} // namespace

MainThread::MainThread(config::Config config, const std::filesystem::path& profiles,
                       const std::filesystem::path& state, Runtime& runtime, BusLink& bus,
                       const DriverGuard& guard, io::Signals& signals)
    : runtime_(runtime),
      bus_(bus),
      guard_(guard),
      signals_(signals),
      monitor_(std::move(config), runtime, bus),
      file_(monitor_.config(), profiles, io::monotonic_now()),
      traces_(bus, runtime, replies_),
      incidents_(monitor_, bus, runtime, replies_, state),
      methods_({monitor_, lamps_, file_, accesses_, probes_, watchers_, traces_, incidents_, reload_, events_,
                event_streams_, log_level_},
               io::monotonic_now())
{
    events_.add(Happened::daemon, {}, fmt::format("dpslaved {} started", kVersion), io::monotonic_now());
    for (const std::string& warning : lamps_.exchange(monitor_.config())) spdlog::warn("{}", warning);
}

void MainThread::release()
{
    lamps_ = Lamps{};
    replies_.server.reset();
}

std::optional<std::string> MainThread::open_socket()
{
    const config::Config& config = monitor_.config();
    // systemd makes this folder for the service; a start by hand need not.
    std::error_code refused;
    const std::filesystem::path folder = config.control.socket.parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder, refused);
    if (refused) return fmt::format("{}: the folder cannot be made: {}", folder.string(), refused.message());
    control::ServerSettings settings;
    settings.socket = config.control.socket;
    settings.version = kVersion;
    settings.url = kUrl;
    auto server = control::Server::open(std::move(settings), methods_.handlers());
    if (!server) return server.error();
    replies_.server.emplace(std::move(*server));
    return std::nullopt;
}

/// Not before the bus is served: a directory in the network may be asked for the group.
void MainThread::admit_operators()
{
    const config::Config& config = monitor_.config();
    const auto group = config::operator_group_of(config.control);
    if (!group) spdlog::warn("{}", to_string(config::without_operator_group(config)));
    replies_.server->set_operators(group, config.control.operator_group);
}

bool MainThread::run()
{
    admit_operators();
    control::Server& server = *replies_.server;
    epoll_.add(server.fd(), EPOLLIN, kServerKey);
    epoll_.add(signals_.fd(), EPOLLIN, kSignalKey);
    monitor_.refresh();
    status_sent_ = status_line(monitor_.view());
    notifier_.ready(status_sent_);

    Instant next_tick{};
    for (;;) {
        const Instant now = io::monotonic_now();
        if (bus_.failed.load(std::memory_order_relaxed)) return false;
        if (now >= next_tick) {
            tick(now);
            next_tick = now + tick_length();
        }
        lamps_.show(now);

        std::array<epoll_event, 2> ready{};
        const Instant wake = std::min({next_tick, lamps_.next_change(now), next_watchdog_});
        for (const epoll_event& event : epoll_.wait(ready, wake - io::monotonic_now())) {
            if (event.data.u64 == kSignalKey && is_end_signalled()) {
                notifier_.stopping();
                accesses_.log_unanswered();
                return true;
            }
            if (event.data.u64 == kServerKey) {
                monitor_.refresh();
                server.on_ready();
            }
        }
        next_tick = std::min(next_tick, now + tick_length()); // a call may have begun to wait
    }
}

std::chrono::milliseconds MainThread::tick_length() const
{
    if (!accesses_.empty() || !reload_.is_idle() || incidents_.is_waited_for()) return kTickWhilePending;
    if (!traces_.empty()) return kTickWithDiagnosis;
    const auto& stations = runtime_.stations();
    const bool has_diagnosis = std::any_of(stations.begin(), stations.end(), [](const Station& station) {
        return station.config->profile->diagnosis != profile::DiagForm::none;
    });
    return has_diagnosis ? kTickWithDiagnosis : kTick;
}

void MainThread::tick(Instant now)
{
    reload_.advance();
    monitor_.refresh();
    monitor_.set_calls(replies_.server->counters());
    monitor_.sample(now);
    log_news();
    const auto& stations = runtime_.stations();
    for (std::size_t i = 0; i < stations.size(); ++i) lamps_.set(i, stations[i].device->condition());
    lamps_.show(now);
    accesses_.answer();
    probes_.answer();
    watchers_.push(now);
    event_streams_.push(now);
    traces_.push();
    incidents_.on_time(now);
    let_log_level_end(now);
    file_.on_time(now);
    feed_watchdog(now);
    if (std::string line = status_line(monitor_.view()); line != status_sent_) {
        notifier_.status(line);
        status_sent_ = std::move(line);
    }
}

/// True: SIGTERM or SIGINT.
bool MainThread::is_end_signalled()
{
    while (const auto signal = signals_.take()) {
        if (*signal == SIGHUP) {
            reload_.request();
            continue;
        }
        spdlog::info("leaving the bus ({})", *signal == SIGTERM ? "SIGTERM" : "SIGINT");
        return true;
    }
    return false;
}

void MainThread::log_news()
{
    for (const Station& station : runtime_.leaving()) log_events(station);
    for (const Station& station : runtime_.stations()) log_events(station);
    log_port_events();
    for (const Station& station : runtime_.stations())
        for (const Sentence& news : station.device->take_news()) {
            log_.say(news.is_warning ? LimitedLog::Level::warning : LimitedLog::Level::info, news.text,
                     io::monotonic_now());
            events_.add(Happened::device, station.config->name, news.text, io::monotonic_now());
        }
    drive_news_.look(runtime_.stations(), events_, io::monotonic_now());
    log_.on_time(io::monotonic_now());
}

void MainThread::log_events(const Station& station)
{
    while (const auto event = station.link->events.pop()) {
        using Kind = dp::Event::Kind;
        const bool is_warning = event->kind == Kind::refused || event->kind == Kind::foreign_set_prm ||
                                event->kind == Kind::watchdog_of_master || event->kind == Kind::overflow;
        // Without what was got and expected: a master that counts it up is still refused for one cause.
        const std::string key =
            fmt::format("{}/{}/{}/{}/{}/{}", station.number, static_cast<int>(event->kind),
                        static_cast<int>(event->state), static_cast<int>(event->reason), event->master,
                        static_cast<int>(event->refusal.why));
        const std::string text = report::sentence(station.config->name, *event);
        log_.say(is_warning ? LimitedLog::Level::warning : LimitedLog::Level::info, key, text,
                 io::monotonic_now());
        const bool is_refusal = event->kind == Kind::refused || event->kind == Kind::foreign_set_prm;
        events_.add(is_refusal ? Happened::refused : Happened::state, station.config->name, text, key,
                    io::monotonic_now());
        incidents_.look(station, *event, text, io::monotonic_now());
    }
}

void MainThread::log_port_events()
{
    using Level = LimitedLog::Level;
    const std::string& port = monitor_.config().bus.port;
    const auto say = [&](Level level, std::string text) {
        events_.add(Happened::port, {}, text, io::monotonic_now());
        log_.say(level, std::move(text), io::monotonic_now());
    };
    while (const auto news = bus_.port_events.pop()) {
        switch (*news) {
            case PortEvent::lost:
                say(Level::error, port + " is missing; it is opened again as soon as it returns");
                break;
            case PortEvent::back: say(Level::info, port + " is back"); break;
            case PortEvent::driver_lost:
                say(Level::error, "the driver enable of " + port +
                                      " cannot be switched: nothing is sent until it works again; check "
                                      "that the GPIO chip is still there");
                break;
            case PortEvent::driver_guarded:
                say(Level::warning, "the driver enable of " + port +
                                        " was made inactive by the guard time: the UART did not report in "
                                        "time that it has sent all; `dpctl counters` shows how often "
                                        "(driver_guarded)");
                break;
            case PortEvent::driver_back:
                say(Level::info, "the driver enable of " + port + " works again");
                break;
        }
    }
    if (std::unique_ptr<PortMessage> words; bus_.port_messages.take(words))
        say(words->is_warning ? Level::warning : Level::error, words->text);
    if (const std::uint64_t dropped = guard_.dropped(); std::exchange(dropped_seen_, dropped) != dropped)
        say(Level::error, "the driver enable of " + port +
                              " was active for longer than any telegram takes, and was made inactive: the "
                              "bus thread was late; run `dpctl tune`");
}

void MainThread::let_log_level_end(Instant now)
{
    if (!log_level_.falls_back(now)) return;
    spdlog::default_logger()->set_level(spdlog::level::info);
    spdlog::info("level of the log: info again");
    events_.add(Happened::setting, {}, "level of the log: info again", now);
}

void MainThread::feed_watchdog(Instant now)
{
    const auto interval = notifier_.watchdog_interval();
    if (!interval) {
        next_watchdog_ = kNever;
        return;
    }
    if (now < next_watchdog_) return;
    next_watchdog_ = now + *interval / 4;
    // Without it systemd restarts the service, as it must when the bus thread stands still.
    const std::uint64_t heartbeat = bus_.heartbeat.load(std::memory_order_relaxed);
    if (heartbeat != heartbeat_seen_) notifier_.watchdog();
    heartbeat_seen_ = heartbeat;
}

} // namespace dpslave::app
