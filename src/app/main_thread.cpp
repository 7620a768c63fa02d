// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/main_thread.hpp"

#include "dpslave/app/self_test.hpp"
#include "dpslave/app/version.hpp"
#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <grp.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>

namespace dpslave::app {

using control::Json;

namespace {

constexpr std::uint64_t kServerKey = 0;
constexpr std::uint64_t kSignalKey = 1;

std::optional<gid_t> group_id(const std::string& name)
{
    const group* found = ::getgrnam(name.c_str());
    return found != nullptr ? std::optional(found->gr_gid) : std::nullopt;
}

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

MainThread::MainThread(const Config& config, std::filesystem::path profiles, Links& links, Lamps& lamps,
                       io::Signals& signals)
    : config_(config),
      profiles_(std::move(profiles)),
      links_(links),
      lamps_(lamps),
      signals_(signals),
      started_(io::monotonic_now())
{
    const bool self_test_passed = tests_itself(started_);
    view_.config = &config_;
    view_.stations.resize(config_.stations.size());
    for (std::size_t i = 0; i < config_.stations.size(); ++i) {
        view_.stations[i].config = &config_.stations[i];
        view_.stations[i].line = &config_.lines[config_.stations[i].line];
        devices_.emplace_back(config_.stations[i], self_test_passed);
        if (config_.stations[i].profile->diagnosis != profile::DiagForm::none)
            usual_tick_ = kTickWithDiagnosis;
        // Before the other threads begin: a station that is not to be on the bus never gets there.
        ordered_.push_back(devices_[i].bus_orders());
        links_.stations[i]->bus_orders.publish(ordered_[i]);
        links_.stations[i]->zero_after_ms.store(devices_[i].zero_after_ms(), std::memory_order_relaxed);
        view_.stations[i].address = devices_[i].address();
    }
}

std::optional<std::string> MainThread::open_socket()
{
    // systemd makes this folder for the service; whoever starts the program by hand need not.
    std::error_code refused; // the socket itself tells why it cannot be made
    std::filesystem::create_directories(config_.control.socket.parent_path(), refused);
    control::ServerSettings settings;
    settings.socket = config_.control.socket;
    settings.operator_group = group_id(config_.control.operator_group);
    settings.operator_group_name = config_.control.operator_group;
    settings.version = kVersion;
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
        if (links_.bus.failed.load(std::memory_order_relaxed)) return false;
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
                return true;
            }
            if (event.data.u64 == kServerKey) {
                refresh();
                server_->on_ready();
                next_tick = std::min(next_tick, now + tick_length());
            }
        }
    }
}

std::chrono::milliseconds MainThread::tick_length() const
{
    return asked_.empty() ? usual_tick_ : kTickWhileAsked;
}

void MainThread::tick(Instant now)
{
    refresh();
    log_events();
    log_devices();
    show_lamps(now);
    answer_asked();
    push_watchers(now);
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
            spdlog::warn(
                "SIGHUP: the configuration is read at start only; restart the service to apply a change");
            continue;
        }
        spdlog::info("leaving the bus ({})", *signal == SIGTERM ? "SIGTERM" : "SIGINT");
        return true;
    }
    return false;
}

void MainThread::refresh()
{
    view_.bus = links_.bus.snapshot.latest();
    view_.lost_events = 0;
    for (std::size_t i = 0; i < view_.stations.size(); ++i) {
        StationView& station = view_.stations[i];
        StationLink& link = *links_.stations[i];
        LineLink& line = *links_.lines[config_.stations[i].line];
        if (link.bus_snapshot.fresh()) station.bus = link.bus_snapshot.latest();
        if (link.drive_snapshot.fresh()) station.drive = link.drive_snapshot.latest();
        station.line_open = line.port_open.load(std::memory_order_relaxed);
        view_.lost_events += link.events.refused();
        station.troubles.clear();
        const TroubleList& troubles = line.troubles.latest();
        for (std::size_t k = 0; k < troubles.count; ++k)
            if (troubles.troubles[k].station == i)
                station.troubles.emplace_back(troubles.troubles[k].text.data());
        follow_device(i);
    }
}

/// What the device makes of what is the case now goes to the bus and to the drive line, if it is news.
void MainThread::follow_device(std::size_t station)
{
    DeviceState& device = devices_[station];
    StationLink& link = *links_.stations[station];
    device.look(view_.stations[station], view_.bus);
    view_.stations[station].address = device.address();
    link.zero_after_ms.store(device.zero_after_ms(), std::memory_order_relaxed);
    const BusOrders orders = device.bus_orders();
    if (orders == ordered_[station]) return;
    ordered_[station] = orders;
    link.bus_orders.publish(orders);
}

void MainThread::log_devices()
{
    for (DeviceState& device : devices_)
        for (const Sentence& news : device.take_news())
            spdlog::log(news.is_warning ? spdlog::level::warn : spdlog::level::info, "{}", news.text);
}

void MainThread::log_events()
{
    for (std::size_t i = 0; i < links_.stations.size(); ++i) {
        while (const auto event = links_.stations[i]->events.pop()) {
            const std::string line = sentence(config_.stations[i].name, *event);
            using Kind = dp::Event::Kind;
            const bool is_warning = event->kind == Kind::refused || event->kind == Kind::foreign_set_prm ||
                                    event->kind == Kind::watchdog_of_master || event->kind == Kind::overflow;
            spdlog::log(is_warning ? spdlog::level::warn : spdlog::level::info, "{}", line);
        }
    }
    if (view_.bus.valid && view_.bus.port_open != bus_open_) {
        bus_open_ = view_.bus.port_open;
        if (bus_open_)
            spdlog::info("{} is back", config_.bus.port);
        else
            spdlog::error("{} has gone; it is opened again as soon as it returns", config_.bus.port);
    }
}

void MainThread::show_lamps(Instant now)
{
    for (std::size_t i = 0; i < devices_.size(); ++i) lamps_.set(i, devices_[i].condition());
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
    const std::uint64_t heartbeat = links_.bus.heartbeat.load(std::memory_order_relaxed);
    if (heartbeat != heartbeat_seen_) notifier_.watchdog();
    heartbeat_seen_ = heartbeat;
}

} // namespace dpslave::app
