// SPDX-License-Identifier: Apache-2.0
#include "main_thread.hpp"

#include "self_test.hpp"

#include "dpslave/app/version.hpp"
#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>

namespace dpslave::app {

using control::Json;

namespace {

constexpr std::uint64_t kServerKey = 0;
constexpr std::uint64_t kSignalKey = 1;

/// Runs the self-test and says in the log what has failed. True: passed.
bool tests_itself(Instant earlier)
{
    constexpr int patience = 1'000'000; // readings of a clock that may be a coarse one
    Instant later = io::monotonic_now();
    for (int i = 0; i < patience && later <= earlier; ++i) later = io::monotonic_now();
    const auto failures = self_test(kKnownTelegram, earlier, later);
    for (const std::string& failure : failures) spdlog::error("self-test: {}", failure);
    if (!failures.empty()) spdlog::error("the self-test has failed: every station stays silent on the bus");
    return failures.empty();
}

} // namespace

MainThread::MainThread(config::Config config, std::filesystem::path profiles, Plant& plant, BusLink& bus,
                       const DriverGuard& guard, io::Signals& signals)
    : config_(std::move(config)),
      profiles_(std::move(profiles)),
      plant_(plant),
      bus_(bus),
      guard_(guard),
      signals_(signals),
      started_(io::monotonic_now())
{
    self_test_passed_ = tests_itself(started_);
    for (const Station& station : plant_.stations()) posts_.push_back(make_post(station));
    show_posts();
    for (const std::string& warning : lamps_.exchange(config_)) spdlog::warn("{}", warning);
}

/// Before the bus hears of it: a station that is not to be there never gets there.
MainThread::Post MainThread::make_post(const Station& station)
{
    Post post{station, self_test_passed_};
    post.ordered = post.device.bus_orders();
    station.link->bus_orders.publish(post.ordered);
    station.link->zero_after_ms.store(post.device.zero_after_ms(), std::memory_order_relaxed);
    return post;
}

/// What can be seen, anew for the posts that there are. What was known of those who stay is kept.
void MainThread::show_posts()
{
    std::vector<StationView> before = std::move(view_.stations);
    view_.config = &config_;
    view_.stations.clear();
    usual_tick_ = kTick;
    for (const Post& post : posts_) {
        const auto known = std::find_if(before.begin(), before.end(), [&post](const StationView& one) {
            return one.number == post.station.number;
        });
        StationView& view =
            view_.stations.emplace_back(known != before.end() ? std::move(*known) : StationView{});
        view.number = post.station.number;
        view.config = post.station.config.get();
        view.line = &post.station.line->config;
        view.address = post.device.address();
        if (post.station.config->profile->diagnosis != profile::DiagForm::none)
            usual_tick_ = kTickWithDiagnosis;
    }
}

void MainThread::go_dark()
{
    lamps_ = Lamps{};
    server_.reset();
}

std::optional<std::string> MainThread::open_socket()
{
    // systemd makes this folder for the service; whoever starts the program by hand need not.
    std::error_code refused;
    const std::filesystem::path folder = config_.control.socket.parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder, refused);
    if (refused) return fmt::format("{}: the folder cannot be made: {}", folder.string(), refused.message());
    control::ServerSettings settings;
    settings.socket = config_.control.socket;
    settings.operator_group = config::operator_group_of(config_.control);
    settings.operator_group_name = config_.control.operator_group;
    settings.version = kVersion;
    settings.url = kUrl;
    auto server = control::Server::open(std::move(settings), handlers());
    if (!server) return server.error();
    server_.emplace(std::move(*server));
    return std::nullopt;
}

bool MainThread::run()
{
    epoll_.add(server_->fd(), EPOLLIN, kServerKey);
    epoll_.add(signals_.fd(), EPOLLIN, kSignalKey);
    refresh();
    status_said_ = status_line(view_);
    notifier_.ready(status_said_);

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
            if (event.data.u64 == kSignalKey && on_signals()) {
                notifier_.stopping();
                log_unanswered();
                return true;
            }
            if (event.data.u64 == kServerKey) {
                refresh();
                server_->on_ready();
            }
        }
        next_tick = std::min(next_tick, now + tick_length()); // somebody may have begun to wait
    }
}

std::chrono::milliseconds MainThread::tick_length() const
{
    const bool somebody_waits = !asked_.empty() || reload_wanted_ || reloading_ != Reloading::idle;
    return somebody_waits ? kTickWhileAsked : usual_tick_;
}

void MainThread::tick(Instant now)
{
    mind_reload();
    refresh();
    count_recent(now);
    log_news();
    show_lamps(now);
    answer_asked();
    answer_probes();
    push_watchers(now);
    look_at_file(now);
    feed_watchdog(now);
    if (std::string line = status_line(view_); line != status_said_) {
        notifier_.status(line);
        status_said_ = std::move(line);
    }
}

/// True: it is time to go.
bool MainThread::on_signals()
{
    while (const auto signal = signals_.take()) {
        if (*signal == SIGHUP) {
            reload_wanted_ = true;
            continue;
        }
        spdlog::info("leaving the bus ({})", *signal == SIGTERM ? "SIGTERM" : "SIGINT");
        return true;
    }
    return false;
}

void MainThread::refresh()
{
    view_.bus = bus_.snapshot.latest();
    view_.lost_events = lost_before_;
    for (std::size_t i = 0; i < posts_.size(); ++i) {
        StationView& station = view_.stations[i];
        StationLink& link = *posts_[i].station.link;
        if (link.bus_snapshot.fresh()) station.bus = link.bus_snapshot.latest();
        if (link.drive_snapshot.fresh()) station.drive = link.drive_snapshot.latest();
        station.ever_answered = station.ever_answered || station.drive.answers;
        station.line_open = posts_[i].station.line->link.port_open.load(std::memory_order_relaxed);
        view_.lost_events += link.events.refused();
        refresh_troubles(i);
        follow_device(i);
    }
}

void MainThread::count_recent(Instant now)
{
    if (now < next_count_) return;
    next_count_ = now + kCountInterval;
    view_.history.sample(view_, now);
}

void MainThread::refresh_troubles(std::size_t station)
{
    StationView& view = view_.stations[station];
    view.troubles.clear();
    const TroubleList& troubles = posts_[station].station.line->link.troubles.latest();
    for (std::size_t k = 0; k < troubles.count; ++k)
        if (troubles.troubles[k].station == view.number) view.troubles.push_back(troubles.troubles[k]);
}

/// What the device makes of what is the case now goes to the bus and to the drive line, if it is news.
void MainThread::follow_device(std::size_t station)
{
    Post& post = posts_[station];
    StationLink& link = *post.station.link;
    post.device.look(view_.stations[station], view_.bus);
    view_.stations[station].address = post.device.address();
    view_.stations[station].silent_because = post.device.silent_because();
    link.zero_after_ms.store(post.device.zero_after_ms(), std::memory_order_relaxed);
    const BusOrders orders = post.device.bus_orders();
    if (orders == post.ordered) return;
    post.ordered = orders;
    link.bus_orders.publish(orders);
}

void MainThread::log_news()
{
    for (const Station& station : leaving_) log_events(station);
    for (const Post& post : posts_) log_events(post.station);
    log_port_news();
    for (Post& post : posts_)
        for (const Sentence& news : post.device.take_news())
            log_.say(news.is_warning ? LimitedLog::Level::warning : LimitedLog::Level::info, news.text,
                     io::monotonic_now());
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
        log_.say(is_warning ? LimitedLog::Level::warning : LimitedLog::Level::info, key,
                 sentence(station.config->name, *event), io::monotonic_now());
    }
}

void MainThread::log_port_news()
{
    using Level = LimitedLog::Level;
    const std::string& port = config_.bus.port;
    const auto say = [&](Level level, std::string text) {
        log_.say(level, std::move(text), io::monotonic_now());
    };
    while (const auto news = bus_.port_events.pop()) {
        switch (*news) {
            case PortEvent::lost:
                say(Level::error, port + " has gone; it is opened again as soon as it returns");
                break;
            case PortEvent::back: say(Level::info, port + " is back"); break;
            case PortEvent::driver_lost:
                say(Level::error, "the driver enable of " + port +
                                      " cannot be switched: nothing is sent until it works again; look "
                                      "whether the GPIO chip is still there");
                break;
            case PortEvent::driver_guarded:
                say(Level::warning, "the driver enable of " + port +
                                        " was let go by the guard: the UART did not say in time that it had "
                                        "sent all; `dpctl counters` shows how often (driver_guarded)");
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
                              "bus thread did not come to it in time");
}

void MainThread::show_lamps(Instant now)
{
    for (std::size_t i = 0; i < posts_.size(); ++i) lamps_.set(i, posts_[i].device.condition());
    lamps_.show(now);
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
    // The bus thread stands still: saying nothing is what makes systemd start us again.
    const std::uint64_t heartbeat = bus_.heartbeat.load(std::memory_order_relaxed);
    if (heartbeat != heartbeat_seen_) notifier_.watchdog();
    heartbeat_seen_ = heartbeat;
}

} // namespace dpslave::app
