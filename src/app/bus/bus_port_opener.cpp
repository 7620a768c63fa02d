// SPDX-License-Identifier: Apache-2.0
#include "bus_port_opener.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/realtime.hpp"

#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>

namespace dpslave::app {

io::TtySettings bus_tty_settings(const config::Config& config)
{
    constexpr Baud kEveryUart = Baud::k9_6;
    io::TtySettings settings;
    settings.baud = static_cast<std::uint32_t>(config.bus.baud.value_or(kEveryUart));
    settings.mark_errors = true;
    settings.prompt = true;
    settings.receive_only = config.bus.listen;
    const io::DriverEnableSettings& driver = config.bus.driver_enable;
    settings.drop_rts_at_close = driver.direction != io::Direction::rts || !driver.active_low;
    return settings;
}

BusPortOpener::BusPortOpener(const config::Config& config, io::DriverEnable& driver, BusLink& link,
                             std::chrono::nanoseconds first_wait)
    : place_(config.file.string() + ':' + std::to_string(config.bus.port_line) + ": [bus]: "),
      baud_(config.bus.baud),
      port_(config.bus.port, bus_tty_settings(config), first_wait),
      driver_(driver),
      link_(link)
{}

BusPortOpener::~BusPortOpener()
{
    thread_.request_stop();
    wake_.ring();
}

void BusPortOpener::start()
{
    thread_ = std::jthread([this](const std::stop_token& stop) {
        try {
            run(stop);
        } catch (const std::exception& error) { // no memory left
            spdlog::critical("the thread that opens the bus port ended because of an error: {}",
                             error.what());
            link_.failed.store(true, std::memory_order_relaxed);
        }
        state_.store(State::ended, std::memory_order_release);
    });
}

bool BusPortOpener::await_first_try(std::chrono::milliseconds limit) const
{
    const Instant end = io::monotonic_now() + limit;
    while (!has_tried_.load(std::memory_order_acquire)) {
        if (io::monotonic_now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    return true;
}

bool BusPortOpener::end(std::chrono::milliseconds limit)
{
    thread_.request_stop();
    wake_.ring();
    const Instant end = io::monotonic_now() + limit;
    while (state_.load(std::memory_order_acquire) != State::ended) {
        if (io::monotonic_now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    return true;
}

void BusPortOpener::run(const std::stop_token& stop)
{
    io::name_thread("opener");
    while (!stop.stop_requested()) {
        wake_.clear();
        if (!stack_is_small_ && link_.memory_is_ready.load(std::memory_order_relaxed)) {
            stack_is_small_ = true;
            io::unlock_deep_stack(); // it waits for ports anyway
        }
        const Instant now = io::monotonic_now();
        State state = state_.load(std::memory_order_acquire);
        if (state == State::lost || state == State::refused) {
            close(state, now);
            state = State::closed;
            state_.store(state, std::memory_order_relaxed);
        }
        if (state == State::closed && open(now)) {
            state = State::lent;
            state_.store(state, std::memory_order_release);
        }
        has_tried_.store(true, std::memory_order_release);
        if (state == State::lent && !driver_.works()) static_cast<void>(driver_.ready(now));
        wait(now);
    }
    close(State::lost, io::monotonic_now());
}

/// For the bus thread, or until something is to be tried again.
void BusPortOpener::wait(Instant now)
{
    const bool is_lent = state_.load(std::memory_order_relaxed) == State::lent;
    const Instant next = is_lent ? driver_.next_try() : port_.next_try();
    int limit = -1;
    if (next != kNever)
        limit = static_cast<int>(
            std::max(std::chrono::ceil<std::chrono::milliseconds>(next - now), std::chrono::milliseconds{0})
                .count());
    pollfd rung{.fd = wake_.fd(), .events = POLLIN, .revents = 0};
    ::poll(&rung, 1, limit);
}

void BusPortOpener::close(State how, Instant now)
{
    driver_.detach(); // before the port is closed
    if (how == State::refused) {
        port_.refuse(now, why_);
        tell_trouble();
    } else {
        port_.lose(now);
    }
}

bool BusPortOpener::open(Instant now)
{
    if (now < port_.next_try()) return false;
    if (const auto trouble = driver_.take())
        port_.refuse(now, *trouble);
    else if (port_.ready(now)) {
        const auto refused = join();
        if (!refused) {
            look_at_rates();
            std::exchange(was_open_, true) ? tell_warnings() : tell_first();
            return true;
        }
        driver_.detach();
        port_.refuse(now, port_.path() + ": " + *refused);
    }
    was_missing_ = true;
    tell_trouble();
    return false;
}

std::optional<std::string> BusPortOpener::join()
{
    if (auto trouble = driver_.attach(port_.tty())) return trouble;
    return was_open_ ? std::nullopt : driver_.self_check();
}

void BusPortOpener::look_at_rates()
{
    if (baud_) return;
    io::TtyBauds bauds = port_.tty().bauds();
    rates_missing_ = std::move(bauds.why_not);
    // A port that vanishes while it is asked can do nothing.
    if (bauds.can.any()) rates_ = bauds.can;
}

/// What the log says of a port that was not open before.
void BusPortOpener::tell_first()
{
    const std::string& path = port_.path();
    for (const std::string& warning : port_.tty().warnings()) spdlog::warn("{}: {}", path, warning);
    spdlog::info("{}: {}", path, driver_.in_words());
    if (!rates_missing_.empty()) spdlog::warn("{}: {}", path, rates_missing_);
    Baud highest = baud_.value_or(Baud::k9_6); // that the bus may have
    if (!baud_)
        for (const Baud baud : kBauds)
            if (rates_.test(index_of(baud))) highest = std::max(highest, baud);
    if (const auto doubt = driver_.doubt(highest)) spdlog::warn("{}: {}", path, *doubt);
}

void BusPortOpener::tell_warnings()
{
    std::string all;
    for (const std::string& one : port_.tty().warnings()) all += (all.empty() ? "" : ". ") + one;
    if (!all.empty()) say(true, port_.path() + ": " + all);
}

void BusPortOpener::tell_trouble()
{
    if (const auto why = port_.take_trouble())
        say(false, (was_open_ ? "" : place_) + *why + "; it is tried again");
}

void BusPortOpener::say(bool is_warning, std::string text)
{
    auto told = std::make_unique<PortMessage>(PortMessage{.is_warning = is_warning, .text = std::move(text)});
    static_cast<void>(link_.port_messages.offer(told)); // not read yet: the older one is as true
}

} // namespace dpslave::app
