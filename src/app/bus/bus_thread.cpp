// SPDX-License-Identifier: Apache-2.0
// The loop: octets, replies, and what everybody else wants to know. Who is on the bus: bus_roster.cpp; how
// the port comes and goes: bus_port.cpp.
#include "bus_thread.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/realtime.hpp"

#include <sys/epoll.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace dpslave::app {

namespace {

/// Where a search begins to be prepared: every UART can do this rate.
constexpr Baud kEveryUart = Baud::k9_6;

/// Calls `visit(n)` for every bit n that is set, without looking at the others one by one.
template <class Visit>
void for_each(const std::bitset<128>& bits_set, Visit visit)
{
    constexpr std::bitset<128> kLow{~0ULL};
    for (unsigned half = 0; half < 2; ++half) {
        std::uint64_t bits = ((bits_set >> (half * 64)) & kLow).to_ullong();
        while (bits != 0) {
            visit(half * 64 + static_cast<unsigned>(std::countr_zero(bits)));
            bits &= bits - 1;
        }
    }
}

fdl::Layer2Settings layer2_settings(const config::BusConfig& config, io::Port& port,
                                    const io::DriverEnable& driver)
{
    fdl::Layer2Settings settings;
    settings.start_up_latency = driver.edge_time(); // the driver goes on before the first bit
    if (config.baud) {
        settings.baud = *config.baud;
        return settings;
    }
    settings.baud = Baud::k1500; // if it can be done, else the next lower one
    settings.search.emplace();
    if (!port.is_open()) return settings;
    // A port that vanishes while it is asked can do nothing; all rates are tried when it is back.
    if (const auto can = port.tty().bauds().can; can.any()) settings.search->rates = can;
    return settings;
}

} // namespace

io::TtySettings bus_tty_settings(const config::Config& config)
{
    io::TtySettings settings;
    settings.baud = static_cast<std::uint32_t>(config.bus.baud.value_or(kEveryUart));
    settings.mark_errors = true;
    settings.prompt = true;
    const io::DriverEnableSettings& driver = config.bus.driver_enable;
    settings.drop_rts_at_close = driver.direction != io::Direction::rts || !driver.active_low;
    return settings;
}

BusThread::BusThread(const config::BusConfig& config, io::Port port, io::DriverEnable& driver,
                     std::unique_ptr<Roster> roster, BusLink& link)
    : port_(std::move(port)),
      driver_(driver),
      sender_(driver),
      echo_(config.echo),
      layer2_(layer2_settings(config, port_, driver)),
      link_(link),
      roster_(std::move(roster))
{
    link_.baud.store(layer2_.baud(), std::memory_order_relaxed);
    seat_newcomers();
}

BusThread::~BusThread()
{
    driver_.detach(); // the port goes
}

void BusThread::run(std::stop_token stop, io::EventFd& wake)
{
    const io::ShallowIdle no_deep_sleep;
    epoll_.add(wake.fd(), EPOLLIN, kWakeKey);
    epoll_.add(ticker_.fd(), EPOLLIN, kTickKey);
    if (port_.is_open()) watch_port();
    follow_rate(); // a search tells where it begins
    faults_at_start_ = io::page_faults_of_thread();

    while (!stop.stop_requested()) {
        if (orders_due_ && !sender_.is_sending() && !layer2_.reply_waits()) {
            follow_roster();
            obey_orders();
        }
        look(octets_before(next_wake()));
        if (layer2_.next_deadline() - io::monotonic_now() < kSpin) wait_for_window();
        send();
        finish_sending(); // a short reply is over before anything else could be done
        hand_on();
        finish_sending();
        follow_rate();
        const Instant now = io::monotonic_now();
        if (may_show(now)) show(now);
        if (!port_.is_open()) try_reopen(now);
        mind_driver(now);
        link_.heartbeat.fetch_add(1, std::memory_order_relaxed);
    }
    epoll_.remove(wake.fd()); // it has said its word
    leave_bus();
}

/// The last reply is let out, then every slave leaves with all that leaving means.
void BusThread::leave_bus()
{
    while (sender_.is_sending()) {
        octets_before(sender_.next_deadline() - 2 * kSpin);
        finish_sending();
    }
    for (const Place& place : places_) {
        if (place.station == nullptr) continue;
        place.station->slave().stop(io::monotonic_now());
        place.station->hand_on();
        place.station->publish_snapshot();
    }
}

Instant BusThread::next_wake() const
{
    Instant next = layer2_.next_deadline();
    if (!layer2_.reply_waits()) next = std::min(next, turns_.next());
    // Somewhat before: the driver is let go on the dot, and to wake up takes its time.
    if (sender_.is_sending()) next = std::min(next, sender_.next_deadline() - 2 * kSpin);
    return next;
}

/// Waits until `when` at most, not at all if that is near. True: the port has something to say.
bool BusThread::octets_before(Instant when)
{
    auto wait = when - io::monotonic_now();
    if (wait <= kSpin) wait = {};
    if (wait > kTick) wait = std::chrono::nanoseconds::max(); // the ticker ends it
    std::array<epoll_event, 3> ready{};
    bool octets = false;
    for (const epoll_event& event : epoll_.wait(ready, wait)) {
        if (event.data.u64 == kTtyKey) octets = true;
        if (event.data.u64 == kTickKey) {
            ticker_.clear();
            orders_due_ = true;
        }
    }
    return octets;
}

/// What has come in, and what the time brings. The port is read only when it has something to say: a read
/// that finds nothing makes the kernel wait for its own workers, which takes milliseconds on a busy machine.
void BusThread::look(bool octets)
{
    if (octets && port_.is_open() && !read_line()) lose_port();
    layer2_.on_time(io::monotonic_now());
}

/// The window of a reply opens in a moment. The wait is used to hand on what this telegram brought, for
/// nothing else is to be done; then a last look whether the master has gone on in the meantime.
void BusThread::wait_for_window()
{
    const Instant opens = layer2_.next_deadline();
    hand_on();
    while (io::monotonic_now() < opens - kLastLook) {
    }
    const bool octets = octets_before(opens);
    while (io::monotonic_now() < opens) {
    }
    look(octets);
}

/// False: the port is gone.
bool BusThread::read_line()
{
    for (;;) {
        const auto chunk = port_.tty().read(buffer_);
        if (!chunk) return false;
        const Instant read_at = io::monotonic_now();
        const bool more = chunk->more || chunk->bad_character;
        if (!chunk->octets.empty()) hear(chunk->octets, read_at, more);
        if (chunk->bad_character) {
            if (const Bytes withheld = echo_.on_character_error(read_at); !withheld.empty())
                layer2_.on_bytes(withheld, read_at, true);
            layer2_.on_character_error(read_at);
        }
        if (!chunk->more) return true;
    }
}

/// Octets from the line; our own do not reach layer 2.
void BusThread::hear(Bytes octets, Instant read_at, bool more)
{
    const auto foreign = echo_.remove(octets, read_at);
    if (foreign.octets.empty()) return;
    heard_at_ = read_at;
    if (!foreign.withheld.empty()) layer2_.on_bytes(foreign.withheld, read_at, true);
    layer2_.on_bytes(foreign.octets, read_at, more);
}

void BusThread::send()
{
    const auto reply = layer2_.take_transmit();
    if (!reply) return;
    if (!port_.is_open()) {
        ++unsent_;
        return;
    }
    const Baud baud = layer2_.baud();
    const auto written = sender_.send(*reply, port_.tty(), baud);
    if (!written) {
        ++unsent_;
        if (written.error() == BusSender::Unsent::port_gone) lose_port();
        return;
    }
    const Tbit length{static_cast<std::uint32_t>(reply->size()) * kCharacter.count};
    const Instant over = *written + duration_of(length, baud);
    // The FIFO of the UART and the kernel's own workers delay an echo as they do the rest of a telegram.
    echo_.sent(*reply, over + duration_of(fdl::kTsyn, baud), over + fdl::silence_limit(baud));
    count_turnaround(*written, baud);
}

/// From the read of the request's last octet to the end of the write: the newest octets heard are that
/// request, or there would be no reply to it.
void BusThread::count_turnaround(Instant written, Baud baud)
{
    const auto took = static_cast<std::uint64_t>(std::max(written - heard_at_, {}).count());
    const auto in = [took](std::uint64_t units_in_second) {
        constexpr std::uint64_t kSecond = 1'000'000'000;
        const std::uint64_t units = (took * units_in_second + kSecond - 1) / kSecond;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(units, UINT32_MAX));
    };
    turnaround_us_.add(in(1'000'000));
    turnaround_tbit_.add(in(static_cast<std::uint64_t>(baud)));
    if (written > layer2_.window_ended()) ++too_late_;
}

void BusThread::finish_sending()
{
    if (sender_.is_sending() && port_.is_open()) sender_.finish(port_.tty());
}

bool BusThread::in_a_hurry(Instant now) const
{
    return sender_.is_sending() && sender_.next_deadline() - now < kHurry;
}

/// Outputs, orders and events of the stations that were spoken to.
void BusThread::hand_on()
{
    const auto addresses = layer2_.take_touched();
    if (addresses.none() && waiting_.none()) return;
    for_each(addresses, [this](unsigned address) {
        if (!at_[address])
            return; // it was taken off right after it was spoken to, and has said its last word
        waiting_.set(*at_[address]);
        turns_.changed(*at_[address]);
    });
    for_each(waiting_, [this](unsigned place) { waiting_.set(place, !places_[place].station->hand_on()); });
}

/// Nothing is shown while a reply waits: its window is short.
bool BusThread::may_show(Instant now) const
{
    return !layer2_.reply_waits() && !in_a_hurry(now);
}

/// Snapshots for the main thread.
void BusThread::show(Instant now)
{
    if (now >= next_bus_snapshot_) show_bus(now);
    if (const auto place = turns_.take(now, roster_->size())) places_[*place].station->publish_snapshot();
}

void BusThread::show_bus(Instant now)
{
    next_bus_snapshot_ = now + SnapshotTurns::kInterval;
    link_.snapshot.publish({.baud = layer2_.baud(),
                            .baud_state = layer2_.baud_state(),
                            .port_open = port_.is_open(),
                            .taken_at = now,
                            .last_telegram = layer2_.last_telegram(),
                            .counters = layer2_.counters(),
                            .unanswered = layer2_.unanswered(),
                            .write_errors = sender_.write_errors(),
                            .unsent = unsent_,
                            .turnaround_us = turnaround_us_,
                            .turnaround_tbit = turnaround_tbit_,
                            .too_late = too_late_,
                            .driver_works = driver_.works(),
                            .driver_errors = sender_.driver_errors(),
                            .driver_guarded = sender_.driver_guarded(),
                            .echo_heard = echo_.is_heard(),
                            .echo_broken = echo_.broken(),
                            .echo_missing = echo_.missing(),
                            .page_faults = io::page_faults_of_thread() - faults_at_start_,
                            .valid = true});
}

} // namespace dpslave::app
