// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/tty_line.hpp"

#include "dpslave/io/clock.hpp"

#include <spdlog/spdlog.h>

namespace dpslave::app {

TtyLine::TtyLine(io::Port port, std::atomic<bool>& is_open) : port_(std::move(port)), is_open_(is_open) {}

bool TtyLine::ready()
{
    if (port_.is_open()) return true;
    const bool is_back = port_.ready(now());
    if (const auto why = port_.take_trouble()) spdlog::error("{}; it is tried again", *why);
    if (!is_back) return false;
    is_open_.store(true, std::memory_order_relaxed);
    spdlog::info("{} is back", port_.path());
    return true;
}

void TtyLine::lose()
{
    port_.lose(now());
    is_open_.store(false, std::memory_order_relaxed);
    spdlog::error("{} has gone; it is opened again as soon as it returns", port_.path());
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
