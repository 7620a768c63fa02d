// SPDX-License-Identifier: Apache-2.0
#include "main_thread.hpp"

#include "app/links/port_words.hpp"
#include "app/state/device_news.hpp"
#include "first_start.hpp"

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

constexpr std::chrono::milliseconds kSettling{500}; // of files at the start

constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::milliseconds kTickWithDiagnosis{20}; // a trip reaches the master soon
constexpr std::chrono::milliseconds kTickWhilePending{5};   // while a call waits for a drive or a reload

} // namespace

MainThread::MainThread(config::Config config, const std::filesystem::path& profiles,
                       const std::filesystem::path& state, Plant& plant, BusLink& bus,
                       const DriverGuard& guard, io::Signals& signals)
    : plant_(plant),
      bus_(bus),
      guard_(guard),
      signals_(signals),
      monitor_(std::move(config), plant.stations(), bus),
      file_(monitor_.config(), profiles, io::monotonic_now()),
      traces_(bus, plant.lines()),
      incidents_(monitor_, bus, plant.lines(), state),
      methods_({monitor_, lamps_, file_, accesses_, probes_, watchers_, traces_, incidents_, reload_,
                happenings_, event_streams_, log_level_},
               io::monotonic_now())
{
    lamps_.exchange(monitor_.config());
    file_.keep(drivers_of(monitor_.config()));
    if (!file_.settle(kSettling)) // before anything is sent: a crash may come at any time
        spdlog::warn("{} has not answered: a crash may leave a driver enable active", file_.waits_for());
    file_.find_group(monitor_.config().control, [this](std::optional<gid_t> group) {
        if (!group) spdlog::warn("{}", to_string(config::without_operator_group(monitor_.config())));
        admit(group);
    });
    if (!state.empty() && has_new_default(monitor_.config()))
        file_.add("the disk with " + state.string(), [this, state]() -> SideJob::Then {
            const auto words = first_start_words(state);
            if (!words) return {};
            return [this, words] { tell(Happened::daemon, Severity::warning, *words); };
        });
}

bool MainThread::end(std::vector<std::string> hanging, Instant limit)
{
    const auto left = [limit] { // 10 ms at least
        return std::chrono::ceil<std::chrono::milliseconds>(
            std::max<std::chrono::nanoseconds>(limit - io::monotonic_now(), std::chrono::milliseconds{10}));
    };
    if (!incidents_.end(left()))
        hanging.emplace_back("the folder of the incidents hangs, and the last one is not written");
    if (!file_.settle(left())) hanging.push_back(file_.waits_for() + " hangs");
    for (const std::string& chip : lamps_.end(Lamps::kEnd))
        hanging.push_back("the lamps of " + chip + " do not answer, and are left as they are");
    for (const std::string& one : hanging) {
        spdlog::critical("{}; the program ends without it", one);
        notifier_.status(one + "; the program ends without it");
    }
    if (!hanging.empty()) server_.reset();
    return hanging.empty();
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
    settings.read_only = config.control.read_only;
    auto server = control::Server::open(std::move(settings), methods_.methods());
    if (!server) return server.error();
    server_.emplace(std::move(*server));
    return std::nullopt;
}

void MainThread::admit(std::optional<gid_t> operators)
{
    is_group_known_ = true;
    server_->set_operators(operators, monitor_.config().control.operator_group);
}

/// A reload has put another configuration in force.
void MainThread::on_applied(const std::vector<Station>& left, std::optional<gid_t> operators)
{
    admit(operators);
    server_->set_read_only(monitor_.config().control.read_only);
    accesses_.refuse(left);
    probes_.refuse(left);
}

/// The first call waits for the group of the operators: a member who calls at once is not refused. A name
/// service that hangs keeps the others for a moment only.
void MainThread::serve_calls_if_due(Instant now)
{
    constexpr std::chrono::seconds kLongest{1};
    const bool is_late = now > began_ + kLongest;
    if (serves_calls_ || !(is_group_known_ || is_late)) return;
    serves_calls_ = true;
    if (!is_group_known_)
        spdlog::warn("{}", file_.waits_for() +
                               " has not answered for a second: until it does only root may operate");
    epoll_.add(server_->fd(), EPOLLIN, kServerKey);
    status_sent_ = status_line(monitor_.view());
    notifier_.ready(status_sent_);
}

bool MainThread::run(const std::string& begin)
{
    tell(Happened::daemon, Severity::info, begin);
    began_ = io::monotonic_now();
    epoll_.add(signals_.fd(), EPOLLIN, kSignalKey);

    Instant next_tick{};
    for (;;) {
        const Instant now = io::monotonic_now();
        bus_.signs.main.give(now);
        if (bus_.failed.load(std::memory_order_relaxed) || bus_has_stalled(now)) {
            accesses_.end();
            return false;
        }
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
                accesses_.end();
                return true;
            }
            if (event.data.u64 == kServerKey) {
                monitor_.refresh();
                server_->on_ready();
            }
        }
        next_tick = std::min(next_tick, now + tick_length()); // a call may have begun to wait
    }
}

std::chrono::milliseconds MainThread::tick_length() const
{
    if (!accesses_.empty() || !reload_.is_idle() || incidents_.is_waited_for() || !serves_calls_)
        return kTickWhilePending;
    if (!traces_.empty()) return kTickWithDiagnosis;
    const auto& stations = plant_.stations();
    const bool has_diagnosis = std::any_of(stations.begin(), stations.end(), [](const Station& station) {
        return station.config->profile->diagnosis != profile::DiagForm::none;
    });
    return has_diagnosis ? kTickWithDiagnosis : kTick;
}

void MainThread::tick(Instant now)
{
    file_.on_time(now);
    reload_.advance(now);
    monitor_.refresh();
    serve_calls_if_due(now);
    monitor_.set_calls(server_->counters());
    monitor_.sample(now);
    tell_news();
    const auto& stations = plant_.stations();
    for (std::size_t i = 0; i < stations.size(); ++i) lamps_.set(i, stations[i].device->condition());
    lamps_.show(now);
    for (const auto& [station, news] : lamps_.take_news(now)) tell_device(stations[station], news);
    accesses_.answer(now);
    probes_.answer(now);
    watchers_.push(now);
    event_streams_.push(now);
    traces_.push();
    incidents_.on_time(now);
    let_log_level_end(now);
    feed_watchdog(now);
    notifier_.send_rest();
    if (std::string line = status_line(monitor_.view()); serves_calls_ && line != status_sent_) {
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

/// Of neither a station nor a line.
void MainThread::tell(Happened kind, Severity severity, std::string text)
{
    happenings_.tell({.kind = kind, .severity = severity, .text = std::move(text)}, io::monotonic_now());
}

/// A drive that is lost takes its station off the bus; a master that is lost begins a RIDE THROUGH. So the
/// one is told before the events of the bus, and the other behind them.
void MainThread::tell_news()
{
    tell_lines();
    tell_stalls();
    for (const Station& station : plant_.leaving()) tell_bus_events(station);
    for (const Station& station : plant_.stations()) tell_bus_events(station);
    for (const auto& [line, happening] : std::exchange(of_masters_, {})) tell_line(*line, happening);
    tell_port_events();
    for (const Station& station : plant_.stations())
        for (const Sentence& news : station.news->take()) tell_device(station, news);
    happenings_.on_time(io::monotonic_now());
}

void MainThread::tell_device(const Station& station, const Sentence& news)
{
    happenings_.tell({.kind = Happened::device,
                      .severity = news.is_warning ? Severity::warning : Severity::info,
                      .text = news.text,
                      .stations = {station.config->name}},
                     io::monotonic_now());
}

void MainThread::tell_lines()
{
    for (const auto* const lines : {&plant_.lines(), &plant_.leaving_lines()})
        for (const auto& line : *lines)
            while (const auto happening = line->link.happenings.take())
                if (happening->kind == LineHappening::Kind::ride_through)
                    of_masters_.emplace_back(line, *happening);
                else
                    tell_line(*line, *happening);
}

void MainThread::tell_stalls()
{
    for (const StalledLines::News& one : stalled_lines_.look(plant_.stations()))
        if (one.is_over)
            tell(Happened::drive, Severity::info, one.text);
        else
            tell_line(*one.line, stall_happening(one.text));
}

/// True: for so long that the program has to end, and nobody else ends it.
bool MainThread::bus_has_stalled(Instant now)
{
    const auto silent_for = bus_silence_.look(bus_.signs.bus.last(), now);
    const bool stalls = silent_for >= kBusThreadMayStall;
    if (stalls && !bus_stall_told_)
        tell(
            Happened::port, Severity::error,
            fmt::format(
                "the bus thread has stalled for {:.1f} s: no station answers, and the outputs go to their safe state",
                std::chrono::duration<double>(silent_for).count()));
    bus_stall_told_ = stalls;
    if (silent_for < kProgramMayStall || notifier_.watchdog_interval()) return false;
    spdlog::critical("the bus thread has stalled: the program ends");
    return true;
}

void MainThread::tell_rest()
{
    tell_news();
    happenings_.end(io::monotonic_now());
}

/// The port of a line is that of each of its drives.
void MainThread::tell_line(const DriveLine& line, const LineHappening& happening)
{
    using Kind = LineHappening::Kind;
    Happening told{.kind = Happened::drive,
                   .severity = happening.severity,
                   .text = happening.text.data(),
                   .key = happening.key.data(),
                   .is_of_line = happening.station == 0};
    const bool has_port = line.link.port_open.load(std::memory_order_relaxed);
    if (happening.kind == Kind::silent && has_port) told.drive_loss = "silent";
    if (happening.kind == Kind::port_missing) told.drive_loss = "port";
    for (const auto* const stations : {&std::as_const(plant_).stations(), &plant_.leaving()})
        for (const Station& station : *stations) {
            const bool is_it = happening.station == 0 ? station.drive_line.get() == &line
                                                      : station.number == happening.station;
            const std::string& name = station.config->name;
            const bool is_new =
                std::find(told.stations.begin(), told.stations.end(), name) == told.stations.end();
            if (!is_it || !is_new) continue; // while one is exchanged both have the name
            told.stations.push_back(name);
            told.recorded.push_back(&station);
        }
    happenings_.tell(told, io::monotonic_now());
}

void MainThread::tell_bus_events(const Station& station)
{
    while (const auto event = station.link->events.pop()) {
        using Kind = dp::Event::Kind;
        const bool is_warning = event->kind == Kind::refused || event->kind == Kind::foreign_set_prm ||
                                event->kind == Kind::watchdog_of_master || event->kind == Kind::overflow;
        const bool is_refusal = event->kind == Kind::refused || event->kind == Kind::foreign_set_prm;
        happenings_.tell(
            {.kind = is_refusal ? Happened::refused : Happened::state,
             .severity = is_warning ? Severity::warning : Severity::info,
             .text = report::sentence(station.config->name, *event),
             // Without what was got and expected: a master that counts it up is still refused for one cause.
             .key = fmt::format("{}/{}/{}/{}/{}/{}", station.number, static_cast<int>(event->kind),
                                static_cast<int>(event->state), static_cast<int>(event->reason),
                                event->master, static_cast<int>(event->refusal.why)),
             .stations = {station.config->name},
             .recorded = {&station},
             .bus_event = &*event},
            io::monotonic_now());
    }
}

void MainThread::tell_port_events()
{
    const std::string& port = monitor_.config().bus.port;
    const auto say = [this](Severity severity, std::string text) {
        tell(Happened::port, severity, std::move(text));
    };
    while (const auto event = bus_.port_events.pop()) {
        auto [severity, text] = in_words(*event, port);
        say(severity, std::move(text));
    }
    while (const auto changed = bus_.settings_changed.pop()) {
        monitor_.set_port_settings(changed->words.data());
        auto [severity, text] = in_words(*changed, port, "Every station has left the bus");
        say(severity, std::move(text));
    }
    if (std::unique_ptr<PortMessage> words; bus_.port_messages.take(words)) {
        if (!words->is_warning) monitor_.set_bus_trouble(words->text);
        say(words->is_warning ? Severity::warning : Severity::error, words->text);
    }
    monitor_.set_driver_raised(guard_.raised());
    if (const std::uint64_t raised = guard_.raised(); std::exchange(raised_seen_, raised) != raised)
        say(Severity::error,
            "the driver enable of " + port +
                " was raised by another program that opened the port; it is released. Find that program: dpctl doctor");
    if (const std::uint64_t dropped = guard_.dropped(); std::exchange(dropped_seen_, dropped) != dropped)
        say(Severity::error,
            "the driver enable of " + port +
                " was active for longer than any telegram takes, and was made inactive: the bus thread was late; run `dpctl tune`");
}

void MainThread::let_log_level_end(Instant now)
{
    if (!log_level_.falls_back(now)) return;
    spdlog::default_logger()->set_level(spdlog::level::info);
    tell(Happened::setting, Severity::info, "level of the log: info again");
}

void MainThread::feed_watchdog(Instant now)
{
    const auto interval = notifier_.watchdog_interval();
    if (!interval) {
        next_watchdog_ = kNever;
        return;
    }
    if (now < next_watchdog_) return;
    next_watchdog_ = now + *interval / 10; // the drives need what is left of it for their safe state
    // Without it systemd restarts the service, as it must when the bus thread stands still.
    const Instant sign = bus_.signs.bus.last();
    if (std::exchange(bus_seen_, sign) != sign) notifier_.watchdog();
}

} // namespace dpslave::app
