// SPDX-License-Identifier: Apache-2.0
#include "tty_line.hpp"

#include "dpslave/io/clock.hpp"

namespace dpslave::app {

TtyLine::TtyLine(io::Port port, std::atomic<bool>& is_open) : port_(std::move(port)), is_open_(is_open) {}

bool TtyLine::ready()
{
    log_.on_time(now());
    if (port_.is_open()) return true;
    const bool is_back = port_.ready(now());
    if (const auto why = port_.take_trouble())
        log_.say(LimitedLog::Level::error, *why + "; it is tried again", now());
    if (!is_back) return false;
    is_open_.store(true, std::memory_order_relaxed);
    log_.say(LimitedLog::Level::info, port_.path() + " is back", now());
    return true;
}

void TtyLine::lose()
{
    port_.lose(now());
    is_open_.store(false, std::memory_order_relaxed);
    log_.say(LimitedLog::Level::error, port_.path() + " is missing; it is opened again as soon as it returns",
             now());
}

bool TtyLine::write(Bytes octets)
{
    if (!ready()) return false;
    const std::error_code trouble = port_.tty().write(octets);
    if (trouble && trouble != std::errc::timed_out) lose(); // a port that is only slow is still there
    return !trouble;
}

std::size_t TtyLine::read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout)
{
    if (!port_.is_open() || !port_.tty().wait_readable(timeout)) return 0;
    const auto chunk = port_.tty().read(into);
    if (!chunk) {
        lose();
        return 0;
    }
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
