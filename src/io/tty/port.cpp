// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/port.hpp"

#include "dpslave/io/clock.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::io {
namespace {

constexpr unsigned kMostDoublings = 3;

} // namespace

Result<Port, std::string> Port::open(std::string path, const TtySettings& settings,
                                     std::chrono::nanoseconds first_wait)
{
    const Instant before = monotonic_now();
    auto tty = Tty::open(path, settings);
    if (!tty) return Failure{tty.error()};
    Port port{std::move(path), settings, first_wait};
    port.tty_.emplace(*std::move(tty));
    port.opened_ = before;
    port.next_try_ = kNever;
    return port;
}

Port::Port(std::string path, const TtySettings& settings, std::chrono::nanoseconds first_wait)
    : path_(std::move(path)), settings_(settings), first_wait_(first_wait)
{}

bool Port::ready(Instant now)
{
    if (tty_) return true;
    if (now < next_try_) return false;
    auto again = Tty::open(path_, settings_);
    if (!again) {
        note(again.error());
        wait(now);
        return false;
    }
    tty_.emplace(*std::move(again));
    opened_ = now;
    next_try_ = kNever;
    return true;
}

void Port::lose(Instant now)
{
    if (!tty_) return;
    tty_.reset();
    if (now - opened_ >= first_wait_ * (1U << kMostDoublings)) failures_ = 0; // it was of use in between
    trouble_.clear();
    trouble_is_new_ = false;
    wait(now);
}

void Port::reopen(Instant now)
{
    if (!tty_) return;
    tty_->discard_output(); // else close() would wait until it has gone, and it would be old
    lose(now);
    next_try_ = now;
}

void Port::refuse(Instant now, std::string why)
{
    tty_.reset();
    note(std::move(why));
    wait(now);
}

std::optional<std::string> Port::take_trouble()
{
    if (!std::exchange(trouble_is_new_, false)) return std::nullopt;
    return trouble_;
}

void Port::note(std::string why)
{
    if (why == trouble_) return;
    trouble_ = std::move(why);
    trouble_is_new_ = true;
}

void Port::wait(Instant now)
{
    next_try_ = now + first_wait_ * (1U << std::min(failures_, kMostDoublings));
    ++failures_;
}

std::optional<std::string> Port::set_baud(std::uint32_t baud)
{
    settings_.baud = baud;
    if (!tty_) return std::nullopt;
    auto trouble = tty_->set_baud(baud);
    if (trouble) *trouble = path_ + ": " + *trouble;
    return trouble;
}

} // namespace dpslave::io
