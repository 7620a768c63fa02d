// SPDX-License-Identifier: Apache-2.0
#include "tty_line.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/thread_sign.hpp"

namespace dpslave::app {

TtyLine::TtyLine(io::SwitchedPort port, drive::WireTime wire_time, std::atomic<bool>& is_open,
                 LineHappenings& happenings)
    : port_(std::move(port)),
      wire_time_(wire_time),
      takes_wire_time_(drive::takes_wire_time(wire_time_, port_.tty().is_pty())),
      is_open_(is_open),
      happenings_(happenings)
{}

bool TtyLine::ready()
{
    if (port_.is_open()) return true;
    const bool is_back = port_.ready(now());
    if (const auto why = port_.take_trouble())
        happenings_.tell(Severity::error, 0, *why + "; it is tried again",
                         std::exchange(is_untold_, false) ? LineHappenings::Kind::port_missing
                                                          : LineHappenings::Kind::other);
    if (!is_back) return false;
    takes_wire_time_ = drive::takes_wire_time(wire_time_, port_.tty().is_pty());
    is_open_.store(true, std::memory_order_relaxed);
    is_untold_ = false;
    happenings_.tell(Severity::info, 0, port_.path() + " is back");
    return true;
}

void TtyLine::lose()
{
    port_.lose(now());
    is_open_.store(false, std::memory_order_relaxed);
    happenings_.tell(Severity::error, 0,
                     port_.path() + " is missing; it is opened again as soon as it returns",
                     LineHappenings::Kind::port_missing);
}

void TtyLine::reopen()
{
    port_.reopen(now());
    is_open_.store(false, std::memory_order_relaxed);
}

bool TtyLine::write(Bytes octets)
{
    may_have_left_ = false;
    if (!ready()) return false;
    const std::error_code trouble = port_.write(octets);
    // Without a stall only a part of it has gone, or nothing.
    may_have_left_ = trouble == std::errc::timed_out && io::this_thread_stalled();
    // A port that is only slow, or whose guard is at work, or that was not written to, is still there.
    const bool is_there = !trouble || trouble == std::errc::timed_out ||
                          trouble == std::errc::operation_canceled ||
                          trouble == std::errc::resource_unavailable_try_again;
    if (!port_.is_open()) { // its driver enable has failed: ready() says so
        is_open_.store(false, std::memory_order_relaxed);
        is_untold_ = true;
    } else if (!is_there) {
        lose();
    }
    return !trouble;
}

std::size_t TtyLine::read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout)
{
    if (!port_.is_open() || !port_.tty().wait_readable(timeout)) return 0;
    const auto chunk = [&] {
        const io::InCall read{io::PortCall::read};
        return port_.tty().read(into);
    }();
    if (!chunk) {
        lose();
        return 0;
    }
    if (io::this_thread_stalled()) return 0; // it has stalled: what it brings is no answer, and the port goes
    return chunk->octets.size();
}

Instant TtyLine::now() const
{
    return io::monotonic_now();
}

void TtyLine::discard()
{
    if (port_.is_open() && port_.tty().discard_input()) lose();
}

} // namespace dpslave::app
