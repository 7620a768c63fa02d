// SPDX-License-Identifier: Apache-2.0
#include "bus_thread.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/realtime.hpp"

#include <sys/epoll.h>

#include <algorithm>
#include <array>
#include <utility>

namespace dpslave::app {

namespace {

fdl::Layer2Settings layer2_settings(const config::BusConfig& config)
{
    fdl::Layer2Settings settings;
    settings.baud = config.baud.value_or(Baud::k1500); // if it can be done, else the next lower one
    if (!config.baud) settings.search.emplace();
    return settings;
}

} // namespace

BusThread::BusThread(const config::BusConfig& config, BusPortOpener& opener, io::DriverEnable& driver,
                     std::unique_ptr<BusStations> stations, BusLink& link)
    : port_(config, opener, driver, epoll_, kPortKey, link),
      layer2_(layer2_settings(config)),
      stations_(std::move(stations), link.stations, layer2_, link.signs.main),
      link_(link)
{
    layer2_.listen(&monitor_);
    link_.baud.store(layer2_.baud(), std::memory_order_relaxed);
}

void BusThread::run(const std::stop_token& stop, io::EventFd& wake)
{
    const io::ShallowIdle no_deep_sleep;
    epoll_.add(wake.fd(), EPOLLIN, kWakeKey);
    epoll_.add(ticker_.fd(), EPOLLIN, kTickKey);
    port_.check(io::monotonic_now(), layer2_);
    follow_rate(); // a search says where it begins
    follow_memory();
    link_.signs.bus.give(io::monotonic_now()); // from now on it is judged, also in its first reply

    while (!stop.stop_requested()) {
        if (update_due_ && !port_.is_sending() && !layer2_.reply_waits()) update();
        process(octets_before(next_wake()));
        if (layer2_.next_deadline() - io::monotonic_now() < kSpin) wait_for_window();
        send();
        port_.finish_sending(); // a short reply is over before anything else could be done
        forward();
        port_.commit_trace(layer2_);
        port_.finish_sending();
        if (!layer2_.reply_waits()) monitor_.catch_up();
        follow_rate();
        const Instant now = io::monotonic_now();
        if (may_publish(now)) publish(now);
        port_.check(now, layer2_);
        link_.signs.bus.give(now);
    }
    epoll_.remove(wake.fd()); // it stays readable: nothing clears it any more
    leave_bus();
}

void BusThread::update()
{
    update_due_ = false;
    const Instant now = io::monotonic_now();
    look_at_settings(now);
    stations_.update(now);
    if (stations_.main_silence() >= kProgramMayStall && link_.end_program) link_.end_program();
}

/// What the stations were told is passed on if it is what the master has said. A port whose settings another
/// program has changed may have taken the same bit from an octet and from its checksum.
void BusThread::forward()
{
    if (stations_.has_heard())
        if (const auto changed = port_.changed_settings(); changed && changed->harms_octets)
            set_again(*changed, io::monotonic_now());
    stations_.forward();
}

/// What harms no octet waits for the pause between two telegrams: the driver may stop the receiver for it.
void BusThread::look_at_settings(Instant now)
{
    const auto changed = port_.changed_settings();
    if (!changed) return;
    const bool is_pause = now - port_.heard_at() >= duration_of(fdl::kTsyn, layer2_.baud());
    if (changed->harms_octets || is_pause) set_again(*changed, now);
}

/// The bus is left first. With the next tick the stations come back, and start up again.
void BusThread::set_again(const io::ChangedSettings& changed, Instant now)
{
    if (changed.harms_octets) stations_.leave(now);
    port_.set_again(changed);
}

/// The last reply goes out whole, then every slave leaves with all that leaving means.
void BusThread::leave_bus()
{
    while (port_.is_sending()) {
        octets_before(port_.sending_ends() - 2 * kSpin);
        port_.finish_sending();
    }
    stations_.stop(io::monotonic_now());
}

Instant BusThread::next_wake() const
{
    Instant next = layer2_.next_deadline();
    // What is due now. What falls due later waits for the next telegram or tick: a timer for each telegram
    // would cost more than the publication.
    const bool has_time = !layer2_.reply_waits() && !port_.is_sending();
    if (has_time && stations_.next_publication() <= published_until_) next = published_until_;
    // Somewhat before: the driver is switched off at the exact time, and to wake up takes its time.
    if (port_.is_sending()) next = std::min(next, port_.sending_ends() - 2 * kSpin);
    return next;
}

/// Waits until `when` at most, not at all if that is near. True: the port has something to read.
bool BusThread::octets_before(Instant when)
{
    auto wait = when - io::monotonic_now();
    if (wait <= kSpin) wait = {};
    if (wait > kTick) wait = std::chrono::nanoseconds::max(); // the ticker ends it
    std::array<epoll_event, 3> ready{};
    bool octets = false;
    for (const epoll_event& event : epoll_.wait(ready, wait)) {
        if (event.data.u64 == kPortKey) octets = true;
        if (event.data.u64 == kTickKey) {
            // This thread has stalled: the lines may have taken the master for lost. That comes before a
            // telegram is answered.
            if (ticker_.clear() >= kManyTicks) update();
            update_due_ = true;
        }
    }
    return octets;
}

/// What has come in, and what the time brings. The port is read only when the epoll has reported it: a read
/// that finds nothing makes the kernel wait for its own workers, which takes milliseconds on a busy machine.
void BusThread::process(bool octets)
{
    if (octets) port_.read(layer2_);
    processed_at_ = io::monotonic_now();
    port_.emptied(processed_at_);
    layer2_.on_time(processed_at_);
    port_.note_silence(layer2_);
}

/// The window of a reply opens in a moment. The wait is used to pass on what this telegram brought, for
/// nothing else is to be done; then a last look whether the master has gone on in the meantime.
void BusThread::wait_for_window()
{
    const Instant opens = layer2_.next_deadline();
    forward();
    port_.commit_trace(layer2_);
    while (io::monotonic_now() < opens - kLastLook) {
    }
    const bool octets = octets_before(opens);
    while (io::monotonic_now() < opens) {
    }
    process(octets);
}

/// A reply that was sent is on the bus like all other telegrams, but is not read back.
void BusThread::send()
{
    const auto reply = layer2_.take_transmit();
    if (!reply) return;
    const Baud baud = layer2_.baud();
    const BusPort::Reply outgoing{.octets = *reply,
                                  .address = layer2_.sent()->sa,
                                  .baud = baud,
                                  .begins = processed_at_,
                                  .window_ended = layer2_.window_ended()};
    const auto written = port_.send(outgoing);
    if (!written) return;
    count_turnaround(*written, baud);
    if (const fdl::Telegram* const telegram = layer2_.sent()) monitor_.on_telegram(*telegram, processed_at_);
}

/// From the read of the request's last octet to the end of the write: the newest octets heard are that
/// request, or there would be no reply to it.
void BusThread::count_turnaround(Instant written, Baud baud)
{
    const auto took = static_cast<std::uint64_t>(std::max(written - port_.heard_at(), {}).count());
    const auto in = [took](std::uint64_t units_in_second) {
        constexpr std::uint64_t kSecond = 1'000'000'000;
        const std::uint64_t units = (took * units_in_second + kSecond - 1) / kSecond;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(units, UINT32_MAX));
    };
    turnaround_us_.add(in(1'000'000));
    turnaround_tbit_.add(in(static_cast<std::uint64_t>(baud)));
    if (written > layer2_.window_ended()) ++too_late_;
}

void BusThread::follow_rate()
{
    if (const auto baud = layer2_.take_baud_change()) port_.set_baud(*baud);
}

/// Nothing is published while a reply waits: its window is short.
bool BusThread::may_publish(Instant now) const
{
    return !layer2_.reply_waits() && !(port_.is_sending() && port_.sending_ends() - now < kDriverMargin);
}

void BusThread::publish(Instant now)
{
    if (now >= next_bus_snapshot_) publish_bus(now);
    if (now >= next_members_) {
        next_members_ = now + kMembersInterval;
        link_.members.publish(monitor_.members().table());
    }
    stations_.publish(now);
    published_until_ = now;
}

/// Page faults are to be seen from the moment on at which none should be left.
void BusThread::follow_memory()
{
    if (memory_is_ready_) return;
    memory_is_ready_ = link_.memory_is_ready.load(std::memory_order_relaxed);
    faults_at_start_ = io::page_faults_of_thread();
}

void BusThread::publish_bus(Instant now)
{
    follow_memory();
    next_bus_snapshot_ = now + SnapshotSchedule::kInterval;
    BusSnapshot snapshot{.baud = layer2_.baud(),
                         .baud_state = layer2_.baud_state(),
                         .taken_at = now,
                         .last_telegram = layer2_.last_telegram(),
                         .counters = layer2_.counters(),
                         .unanswered = monitor_.members().unanswered(),
                         .turnaround_us = turnaround_us_,
                         .turnaround_tbit = turnaround_tbit_,
                         .too_late = too_late_,
                         .page_faults = io::page_faults_of_thread() - faults_at_start_,
                         .valid = true};
    port_.write_state(snapshot);
    link_.snapshot.publish(snapshot);
}

} // namespace dpslave::app
