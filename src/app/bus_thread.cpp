// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/bus_thread.hpp"

#include "dpslave/io/clock.hpp"

#include <sys/epoll.h>

#include <algorithm>
#include <bit>

namespace dpslave::app {

namespace {

constexpr std::uint64_t kTtyKey = 0;
constexpr std::uint64_t kWakeKey = 1;
constexpr std::uint64_t kTickKey = 2;

fdl::StationSettings station_settings(const Config& config)
{
    fdl::StationSettings settings;
    settings.baud = config.bus.baud;
    return settings;
}

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

} // namespace

io::TtySettings bus_tty_settings(const Config& config)
{
    io::TtySettings settings;
    settings.baud = static_cast<std::uint32_t>(config.bus.baud);
    settings.mark_errors = true;
    return settings;
}

BusStation::BusStation(const StationConfig& config, StationLink& link)
    : link_(link), slave_(*config.personality, config.address)
{
    orders_.address = config.address;
}

void BusStation::fetch()
{
    if (link_.inputs.fresh()) slave_.set_inputs(link_.inputs.latest());
    if (link_.demand_answer.fresh()) slave_.set_demand_answer(link_.demand_answer.latest());
    take_orders();
}

bool BusStation::take_orders()
{
    if (!link_.bus_orders.fresh()) return false;
    orders_ = link_.bus_orders.latest();
    slave_.set_ext_diag(orders_.ext_diag, orders_.ext_diag_fault);
    return true;
}

fdl::Answer BusStation::srd(const fdl::Indication& request, fdl::ReplyData& reply)
{
    fetch();
    return slave_.srd(request, reply);
}

void BusStation::sdn(const fdl::Indication& request)
{
    fetch(); // Freeze holds the inputs as they are at the command
    slave_.sdn(request);
}

void BusStation::on_time(Instant now)
{
    fetch();
    slave_.on_time(now);
}

bool BusStation::hand_on()
{
    while (const auto left = slave_.take_left())
        link_.ended.store(left->generation, std::memory_order_release);
    if (const auto outputs = slave_.take_outputs()) link_.outputs.publish(*outputs);

    if (!waiting_order_) waiting_order_ = slave_.take_demand_order();
    while (waiting_order_ && link_.demand_orders.push(*waiting_order_))
        waiting_order_ = slave_.take_demand_order();

    while (const auto event = slave_.take_event()) {
        link_.events.push(*event); // full: counted by the ring; the log is not worth a lost telegram
    }
    return !waiting_order_;
}

BusThread::BusThread(const Config& config, io::Tty tty, std::vector<std::unique_ptr<StationLink>>& stations,
                     BusLink& link)
    : config_(config), tty_(std::move(tty)), station_(station_settings(config)), link_(link)
{
    for (std::size_t i = 0; i < config.stations.size(); ++i)
        stations_.push_back(std::make_unique<BusStation>(config.stations[i], *stations[i]));
    address_.resize(stations_.size());
}

void BusThread::run(std::stop_token stop, io::EventFd& wake)
{
    epoll_.add(wake.fd(), EPOLLIN, kWakeKey);
    epoll_.add(ticker_.fd(), EPOLLIN, kTickKey);
    watch_port();
    for (std::size_t i = 0; i < stations_.size(); ++i) unseen_.set(i);

    while (!stop.stop_requested()) {
        if (orders_due_) obey_orders();
        const Instant next_show = unseen_.any() ? next_snapshot_ : kNever;
        look(octets_before(std::min(station_.next_deadline(), next_show)));
        if (station_.next_deadline() - io::monotonic_now() < kSpin) wait_for_window();
        send();
        hand_on();
        show(io::monotonic_now());
        if (!tty_) try_reopen(io::monotonic_now());
        link_.heartbeat.fetch_add(1, std::memory_order_relaxed);
    }

    for (const auto& one : stations_) {
        one->slave().stop(io::monotonic_now());
        one->hand_on();
        one->publish_snapshot();
    }
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
    if (octets && tty_ && !read_line()) lose_port();
    station_.on_time(io::monotonic_now());
}

/// The window of a reply opens in a moment. The wait is used to hand on what this telegram brought, for
/// nothing else is to be done; then a last look whether the master has gone on in the meantime.
void BusThread::wait_for_window()
{
    const Instant opens = station_.next_deadline();
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
        const auto chunk = tty_->read(buffer_);
        if (!chunk) return false;
        const Instant read_at = io::monotonic_now();
        const bool more = chunk->more || chunk->bad_character;
        if (!chunk->octets.empty()) station_.on_bytes(chunk->octets, read_at, more);
        if (chunk->bad_character) station_.on_character_error(read_at);
        if (!chunk->more) return true;
    }
}

void BusThread::send()
{
    const auto reply = station_.take_transmit();
    if (!reply || !tty_) return;
    if (tty_->send(*reply)) ++write_errors_;
}

/// Outputs, orders and events of the stations that were spoken to.
void BusThread::hand_on()
{
    const auto addresses = station_.take_touched();
    if (addresses.none() && waiting_.none()) return;
    for_each(addresses, [this](unsigned address) {
        if (!at_[address])
            return; // it was taken off right after it was spoken to, and has said its last word
        waiting_.set(*at_[address]);
        unseen_.set(*at_[address]);
    });
    for_each(waiting_, [this](unsigned station) { waiting_.set(station, !stations_[station]->hand_on()); });
}

/// Puts stations on the bus, takes them off, and gives them another address, as the main thread wants it.
/// Between two telegrams and not inside one: layer 2 may be in the middle of a call to the station.
void BusThread::obey_orders()
{
    orders_due_ = false;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
        BusStation& one = *stations_[i];
        if (one.take_orders()) unseen_.set(i); // a new diagnosis is shown although nobody asks for it
        const BusOrders& wanted = one.orders();
        if (address_[i] && (!wanted.enabled || *address_[i] != wanted.address)) take_off(i);
    }
    for (std::size_t i = 0; i < stations_.size(); ++i) // an address that another one leaves is free by now
        if (!address_[i] && stations_[i]->orders().enabled) put_on(i);
}

void BusThread::take_off(std::size_t station)
{
    BusStation& one = *stations_[station];
    one.slave().stop(io::monotonic_now());
    waiting_.set(station, !one.hand_on());
    unseen_.set(station);
    station_.detach(*address_[station]);
    at_[*address_[station]].reset();
    address_[station].reset();
}

void BusThread::put_on(std::size_t station)
{
    BusStation& one = *stations_[station];
    const std::uint8_t address = one.orders().address;
    if (at_[address]) return; // still somebody else's: with the next tick
    one.slave().set_address(address);
    if (!station_.attach(address, one, config_.stations[station].personality->max_tsdr)) return;
    one.slave().start(io::monotonic_now());
    at_[address] = static_cast<std::uint8_t>(station);
    address_[station] = address;
    waiting_.set(station, !one.hand_on());
    unseen_.set(station);
}

/// Snapshots for the main thread, one station a round at most: what a telegram costs does not grow with their
/// number.
void BusThread::show(Instant now)
{
    if (now >= next_bus_snapshot_) show_bus(now);
    if (now < next_snapshot_ || unseen_.none()) return;
    next_snapshot_ = now + kSnapshotInterval / stations_.size();
    do turn_ = (turn_ + 1) % 128;
    while (!unseen_.test(turn_));
    unseen_.reset(turn_);
    stations_[turn_]->publish_snapshot();
}

void BusThread::show_bus(Instant now)
{
    next_bus_snapshot_ = now + kSnapshotInterval;
    if (station_.counters().telegrams != telegrams_seen_) last_telegram_ = now;
    telegrams_seen_ = station_.counters().telegrams;
    link_.snapshot.publish({.baud = station_.baud(),
                            .baud_state = station_.baud_state(),
                            .port_open = tty_.has_value(),
                            .last_telegram = last_telegram_,
                            .counters = station_.counters(),
                            .write_errors = write_errors_,
                            .valid = true});
}

/// By its edges: each arrival of octets is told once, and asking the port again whether something is left
/// costs more than the reply.
void BusThread::watch_port()
{
    epoll_.add(tty_->fd(), EPOLLIN | EPOLLET, kTtyKey);
}

void BusThread::lose_port()
{
    epoll_.remove(tty_->fd());
    tty_.reset();
    next_reopen_ = io::monotonic_now() + kReopenAfter;
}

void BusThread::try_reopen(Instant now)
{
    if (now < next_reopen_) return;
    next_reopen_ = now + kReopenAfter;
    auto again = io::Tty::open(config_.bus.port, bus_tty_settings(config_));
    if (!again) return;
    tty_.emplace(std::move(*again));
    watch_port();
}

} // namespace dpslave::app
