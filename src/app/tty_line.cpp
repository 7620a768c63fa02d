// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/tty_line.hpp"

#include "dpslave/io/clock.hpp"

#include <spdlog/spdlog.h>

namespace dpslave::app {

TtyLine::TtyLine(std::string path, const io::TtySettings& settings, io::Tty tty, std::atomic<bool>& is_open)
    : path_(std::move(path)), settings_(settings), tty_(std::move(tty)), is_open_(is_open)
{
    is_open_.store(true, std::memory_order_relaxed);
}

bool TtyLine::ready()
{
    if (tty_) return true;
    const Instant now = io::monotonic_now();
    if (now < next_reopen_) return false;
    next_reopen_ = now + kReopenAfter;
    auto again = io::Tty::open(path_, settings_);
    if (!again) return false;
    tty_.emplace(std::move(*again));
    is_open_.store(true, std::memory_order_relaxed);
    spdlog::info("{} is back", path_);
    return true;
}

void TtyLine::lose()
{
    tty_.reset();
    is_open_.store(false, std::memory_order_relaxed);
    next_reopen_ = io::monotonic_now() + kReopenAfter;
    spdlog::error("{} has gone; it is opened again as soon as it returns", path_);
}

bool TtyLine::write(Bytes octets)
{
    if (!ready()) return false;
    const std::error_code trouble = tty_->write(octets);
    if (trouble && trouble != std::errc::timed_out) lose(); // a port that is only slow is still there
    return !trouble;
}

std::size_t TtyLine::read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout)
{
    if (!tty_ || !tty_->wait_readable(timeout)) return 0;
    const auto chunk = tty_->read(into);
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
    if (tty_ && tty_->discard_input()) lose();
}

} // namespace dpslave::app
