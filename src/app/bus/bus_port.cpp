// SPDX-License-Identifier: Apache-2.0
#include "bus_port.hpp"

#include "dpslave/io/clock.hpp"

#include <sys/epoll.h>

#include <utility>

namespace dpslave::app {

BusPort::BusPort(const config::BusConfig& config, BusPortOpener& opener, io::DriverEnable& driver,
                 io::Epoll& epoll, std::uint64_t key, BusLink& link)
    : opener_(opener),
      driver_(driver),
      echo_(config.echo),
      epoll_(epoll),
      key_(key),
      link_(link),
      trace_(link.trace),
      backlog_(io::monotonic_now())
{
    if (!config.listen) sender_.emplace(driver);
}

/// What it can do is known before anything is heard through it. Its octets are reported by their edges: each
/// arrival once, and asking the port again whether something is left costs more than the reply.
void BusPort::take(fdl::Layer2& layer2)
{
    port_ = opener_.lent();
    if (port_ == nullptr) return;
    layer2.set_port(opener_.rates(), driver_.edge_time()); // the driver goes on before the first bit
    const bool is_first = !std::exchange(was_open_, true);
    if (is_first) backlog_ = BacklogAge{port_->opened()};
    if (!is_first || opener_.was_missing()) report(PortEvent::back);
    guard_reported_ = false;
    static_cast<void>(layer2.take_baud_change()); // it is set here
    if (port_->settings().baud != static_cast<std::uint32_t>(layer2.baud())) set_baud(layer2.baud());
    if (!is_open()) return;
    epoll_.add(port_->tty().fd(), EPOLLIN | EPOLLET, key_);
    link_.hold_back_ns.store(port_->tty().hold_back().count(), std::memory_order_relaxed);
}

void BusPort::set_baud(Baud baud)
{
    if (sender_) sender_->abort();
    link_.baud.store(baud, std::memory_order_relaxed);
    trace_.rate(io::monotonic_now(), baud);
    if (!is_open()) return;
    if (const auto trouble = port_->set_baud(static_cast<std::uint32_t>(baud))) {
        report(PortEvent::lost);
        detach();
        opener_.refuse(*trouble);
    }
}

void BusPort::read(fdl::Layer2& layer2)
{
    while (is_open()) {
        trace_.commit(); // what was noted lies in the buffer
        const auto chunk = port_->tty().read(buffer_);
        if (!chunk) return lose();
        const Instant read_at = io::monotonic_now();
        const bool more = chunk->more || chunk->bad_character;
        if (!chunk->octets.empty()) hear(chunk->octets, read_at, more, layer2);
        if (chunk->bad_character) {
            hear_withheld(echo_.on_character_error(read_at), read_at, layer2);
            trace_.bad_character(read_at, layer2.baud());
            layer2.on_character_error(read_at);
        }
        if (!chunk->more) return;
    }
}

void BusPort::hear(Bytes octets, Instant read_at, bool more, fdl::Layer2& layer2)
{
    const auto foreign = echo_.remove(octets, read_at);
    if (foreign.octets.empty()) return;
    heard_at_ = read_at;
    layer2.assume_backlog(backlog_.age_of(read_at));
    hear_withheld(foreign.withheld, read_at, layer2);
    trace_.heard(foreign.octets, read_at, more, layer2.baud());
    layer2.on_bytes(foreign.octets, read_at, more);
    // The master goes on: what has not left by now would meet its telegrams. (A bad character alone may be
    // one of our echo.) Behind layer 2, because the answer has to wait anyway.
    discard_what_is_stuck();
}

/// They looked like an echo until now. The next call of echo_ reuses their place.
void BusPort::hear_withheld(Bytes octets, Instant read_at, fdl::Layer2& layer2)
{
    if (octets.empty()) return;
    trace_.heard(octets, read_at, true, layer2.baud());
    trace_.commit();
    layer2.on_bytes(octets, read_at, true);
}

void BusPort::note_silence(fdl::Layer2& layer2)
{
    if (const auto at = layer2.take_silence()) trace_.silence(*at, layer2.baud());
}

void BusPort::commit_trace(fdl::Layer2& layer2)
{
    while (const auto request = layer2.take_unanswered()) trace_.unanswered(*request, layer2.baud());
    trace_.commit();
}

std::optional<Instant> BusPort::send(const Reply& reply)
{
    if (!sender_ || !is_open()) {
        ++unsent_;
        note_unsent(reply, fdl::Unanswered::Why::unsent);
        return std::nullopt;
    }
    const auto written =
        sender_->send(reply.octets, port_->tty(), reply.baud, reply.window_ended + driver_.edge_time());
    if (!written) {
        const bool is_late = written.error() == BusSender::Unsent::too_late;
        ++(is_late ? late_ : unsent_);
        note_unsent(reply, is_late ? fdl::Unanswered::Why::late : fdl::Unanswered::Why::unsent);
        if (written.error() == BusSender::Unsent::port_gone) lose();
        return std::nullopt;
    }
    trace_.sent(reply.octets, reply.begins, *written, reply.baud);
    const Tbit length{static_cast<std::uint32_t>(reply.octets.size()) * kCharacter.count};
    const Instant over = *written + duration_of(length, reply.baud);
    // The FIFO of the UART and the kernel's own workers delay an echo as they do the rest of a telegram.
    leaves_by_ = over + fdl::silence_limit(reply.baud);
    left_ = reply;
    left_.octets = {};
    echo_.sent(reply.octets, over + duration_of(fdl::kTsyn, reply.baud), leaves_by_);
    return *written;
}

/// A reply that the transmitter holds back (an adapter that hangs, a handshake) must not leave at some later
/// time.
void BusPort::discard_what_is_stuck()
{
    if (std::exchange(leaves_by_, kNever) == kNever || !is_open()) return;
    if (!port_->tty().discard_unsent()) return;
    ++unsent_;
    ++stuck_;
    left_.begins = io::monotonic_now();
    note_unsent(left_, fdl::Unanswered::Why::unsent);
}

void BusPort::note_unsent(const Reply& reply, fdl::Unanswered::Why why)
{
    trace_.unanswered({.why = why, .address = reply.address, .at = reply.begins}, reply.baud);
}

void BusPort::finish_sending()
{
    if (is_sending() && is_open()) sender_->finish(port_->tty());
}

void BusPort::check(Instant now, fdl::Layer2& layer2)
{
    if (now >= leaves_by_) discard_what_is_stuck();
    if (!is_open()) take(layer2);
    if (sender_ && is_open()) check_driver_enable();
}

/// An edge of the driver enable that failed is reported once, and the way back is tried for. So is the first
/// time that the guard was needed.
void BusPort::check_driver_enable()
{
    if (sender_->driver_guarded() != guarded_ && !std::exchange(guard_reported_, true))
        report(PortEvent::driver_guarded);
    guarded_ = sender_->driver_guarded();
    const bool works = driver_.works();
    if (std::exchange(driver_worked_, works) == works) return;
    report(works ? PortEvent::driver_back : PortEvent::driver_lost);
    if (!works) opener_.wake();
}

void BusPort::set_again(const io::ChangedSettings& changed)
{
    if (sender_ && changed.harms_octets) sender_->abort();
    ++settings_changed_;
    const std::error_code refused = port_->tty().set_again(changed);
    link_.settings_changed.push(changed); // full: the log has enough of it
    if (refused) lose();
}

void BusPort::lose()
{
    detach();
    report(PortEvent::lost);
    opener_.give_back();
}

void BusPort::detach()
{
    if (sender_) sender_->abort();
    epoll_.remove(port_->tty().fd());
    port_ = nullptr;
}

void BusPort::write_state(BusSnapshot& snapshot) const
{
    snapshot.port_open = is_open();
    snapshot.counters.late += late_;
    snapshot.counters.replies -= late_; // layer 2 had handed them over
    snapshot.unsent = unsent_;
    snapshot.settings_changed = settings_changed_;
    snapshot.driver_works = driver_.works();
    snapshot.echo_broken = echo_.broken();
    snapshot.echo_missing = echo_.missing();
    if (!sender_) return;
    snapshot.write_errors = sender_->write_errors() + stuck_;
    snapshot.driver_errors = sender_->driver_errors();
    snapshot.driver_guarded = sender_->driver_guarded();
}

} // namespace dpslave::app
