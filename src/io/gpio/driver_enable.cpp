// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/driver_enable.hpp"

#include "driver_enable_port.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/fd.hpp"
#include "dpslave/io/gpio.hpp"
#include "dpslave/io/tty.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <limits>
#include <mutex>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;

constexpr int kNoPort = -1;
/// `since` is one of these, or the moment at which the line was made active.
constexpr std::int64_t kInactive = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kGuardAtWork = kInactive + 1;

std::int64_t ticks(Instant at)
{
    return at.time_since_epoch().count();
}

std::error_code code(int error)
{
    return {error, std::system_category()};
}

GpioRequest request_of(const DriverEnableSettings& settings)
{
    return {.chip = settings.gpio_chip,
            .line = settings.gpio_line,
            .active_low = settings.active_low,
            .consumer = "dpslaved driver enable"};
}

} // namespace

struct DriverEnable::Held {
    explicit Held(DriverEnableSettings wanted) : settings(std::move(wanted)) {}
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held() { static_cast<void>(edge(false)); }

    const DriverEnableSettings settings;
    /// Held while line or port are exchanged, and by the guard while it uses them. set() does not need it: it
    /// uses the line while `works` only, and it is exchanged while not.
    std::mutex exchange_mutex;
    std::optional<GpioLine> line; ///< nullopt: not taken yet, or the chip has gone
    int port = kNoPort;
    serial_rs485 took{}; ///< what the UART's driver made of Direction::kernel

    std::atomic<std::int64_t> since{kInactive};
    std::atomic<bool> works{true};
    Instant next_try = kNever;
    unsigned failures = 0;
    std::chrono::nanoseconds edge_time{};

    std::error_code edge(bool active) noexcept
    {
        if (settings.direction == Direction::gpio)
            return line ? line->set(active) : std::make_error_code(std::errc::no_such_device);
        if (settings.direction == Direction::rts)
            return port != kNoPort ? code(set_rts(port, active != settings.active_low))
                                   : std::make_error_code(std::errc::no_such_device);
        return {};
    }
    void fail(Instant now) noexcept
    {
        if (!works.load(std::memory_order_relaxed)) return;
        next_try = now;
        failures = 0;
        works.store(false, std::memory_order_release);
    }
    void work() noexcept
    {
        next_try = kNever;
        works.store(true, std::memory_order_release);
    }
    void forget() noexcept { since.store(kInactive, std::memory_order_release); }

    std::error_code rise(Instant now) noexcept;
    std::error_code fall(Instant now) noexcept;
    bool get_back();
    std::optional<std::string> attach_rts(int fd);
    std::optional<std::string> attach_kernel(int fd);
};

/// The time is noted before the edge: a thread that is stopped in between is covered by the guard.
std::error_code DriverEnable::Held::rise(Instant now) noexcept
{
    if (!works.load(std::memory_order_acquire)) return std::make_error_code(std::errc::no_such_device);
    const std::int64_t mine = ticks(now);
    std::int64_t before = since.load(std::memory_order_acquire);
    do
        if (before == kGuardAtWork) return std::make_error_code(std::errc::resource_unavailable_try_again);
    while (!since.compare_exchange_weak(before, mine, std::memory_order_acq_rel));

    if (const auto error = edge(true)) {
        if (!edge(false)) forget(); // else the guard goes on trying
        fail(now);
        return error;
    }
    if (since.load(std::memory_order_acquire) == mine) return {};
    // This thread was delayed between the two for so long that the guard judged the line to be stuck.
    if (edge(false)) {
        since.store(mine, std::memory_order_release);
        fail(now);
    }
    return std::make_error_code(std::errc::resource_unavailable_try_again);
}

std::error_code DriverEnable::Held::fall(Instant now) noexcept
{
    if (const auto error = edge(false)) {
        fail(now);
        return error;
    }
    std::int64_t before = since.load(std::memory_order_acquire);
    while (before != kGuardAtWork && // which notes the same
           !since.compare_exchange_weak(before, kInactive, std::memory_order_acq_rel)) {
    }
    return {};
}

/// A line of a chip that went stays useless when the chip is back: it is requested anew, and is inactive by
/// that.
bool DriverEnable::Held::get_back()
{
    const std::lock_guard lock(exchange_mutex);
    if (settings.direction == Direction::gpio) {
        line.reset(); // first, or it would be in use by this process
        auto again = GpioLine::request(request_of(settings));
        if (!again) return false;
        line.emplace(std::move(*again));
    } else if (edge(false)) {
        return false;
    }
    forget();
    return true;
}

std::optional<std::string> DriverEnable::Held::attach_rts(int fd)
{
    if (!rts(fd)) return cannot(fd, Direction::rts, "it has no RTS: " + code(errno).message());
    // The kernel drops RTS as the last user closes the port, however that process ended. RTS is then
    // inactive, but not with active_low.
    if (const int error = drop_rts_on_close(fd, !settings.active_low); error != 0)
        return cannot(fd, Direction::rts, "its settings are refused: " + code(error).message());
    if (const int error = set_rts(fd, settings.active_low); error != 0)
        return cannot(fd, Direction::rts, "RTS cannot be set: " + code(error).message());
    if (rts(fd) != settings.active_low) return cannot(fd, Direction::rts, "RTS does not follow");
    return std::nullopt;
}

std::optional<std::string> DriverEnable::Held::attach_kernel(int fd)
{
    const serial_rs485 wanted = rs485_wanted(settings);
    if (const int error = set_rs485(fd, wanted, took); error != 0)
        return cannot(fd, Direction::kernel,
                      error == ENOTTY ? "the driver of this UART does not switch: TIOCSRS485"
                                      : "TIOCSRS485: " + code(error).message());
    if (const std::string wrong = judge_rs485(wanted, took); !wrong.empty())
        return cannot(fd, Direction::kernel, "read back after TIOCSRS485, " + wrong);
    return std::nullopt;
}

DriverEnable::DriverEnable(const DriverEnableSettings& settings) : held_(std::make_unique<Held>(settings))
{
    if (settings.direction == Direction::gpio) held_->fail(Instant{});
}
DriverEnable::DriverEnable(DriverEnable&&) noexcept = default;
DriverEnable& DriverEnable::operator=(DriverEnable&&) noexcept = default;
DriverEnable::~DriverEnable() = default;

Result<DriverEnable, std::string> DriverEnable::open(const DriverEnableSettings& settings)
{
    DriverEnable driver{settings};
    if (auto trouble = driver.take()) return Failure{*std::move(trouble)};
    return driver;
}

std::optional<std::string> DriverEnable::take()
{
    Held& h = *held_;
    if (h.settings.direction != Direction::gpio || h.line) return std::nullopt;
    auto line = GpioLine::request(request_of(h.settings));
    if (!line) return "driver enable: " + line.error();
    const std::lock_guard lock(h.exchange_mutex);
    h.line.emplace(std::move(*line));
    h.work();
    return std::nullopt;
}

std::optional<std::string> DriverEnable::release(const DriverEnableSettings& settings,
                                                 const std::string& port)
{
    if (settings.direction == Direction::gpio) {
        const auto taken = open(settings); // inactive by that, and given back at the end of this
        return taken ? std::nullopt : std::optional{taken.error()};
    }
    // If RTS is asserted while sending the kernel has dropped it, and to open the port would assert it anew.
    if (settings.direction != Direction::rts || !settings.active_low) return std::nullopt;
    const Fd fd{::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    // A program that has the port has a lock on it (Tty::open), and switches RTS.
    int error = !fd || ::flock(fd.get(), LOCK_EX | LOCK_NB) < 0 ? errno : 0;
    if (error == 0) error = drop_rts_on_close(fd.get(), false);
    if (error == 0) error = set_rts(fd.get(), true);
    if (error == 0) return std::nullopt;
    return "driver enable: RTS of " + port + " cannot be set (" + code(error).message() +
           "): check `port` in the configuration, and that no program has it (`fuser " + port + "`)";
}

std::optional<std::string> DriverEnable::attach(const Tty& port)
{
    Held& h = *held_;
    std::optional<std::string> trouble;
    if (h.settings.direction != Direction::kernel) trouble = end_rs485(port.fd());
    if (!trouble && h.settings.direction == Direction::rts) trouble = h.attach_rts(port.fd());
    if (h.settings.direction == Direction::kernel) trouble = h.attach_kernel(port.fd());
    if (trouble) return "driver enable: " + *trouble;
    port.keep_rs485_mode();

    const std::lock_guard lock(h.exchange_mutex);
    h.port = port.fd();
    if (h.settings.direction == Direction::rts) {
        h.forget();
        h.work();
    }
    return std::nullopt;
}

void DriverEnable::detach() noexcept
{
    Held& h = *held_;
    static_cast<void>(h.fall(monotonic_now()));
    const std::lock_guard lock(h.exchange_mutex);
    h.port = kNoPort;
    if (h.settings.direction == Direction::rts) h.forget(); // the line goes with its port
}

Direction DriverEnable::direction() const noexcept
{
    return held_->settings.direction;
}

bool DriverEnable::by_hand() const noexcept
{
    return direction() == Direction::gpio || direction() == Direction::rts;
}

std::error_code DriverEnable::set(bool sending, Instant now) noexcept
{
    if (!by_hand()) return {};
    if (sending) return held_->rise(now);
    return works() ? held_->fall(now) : std::make_error_code(std::errc::no_such_device);
}

bool DriverEnable::works() const noexcept
{
    return held_->works.load(std::memory_order_acquire);
}

bool DriverEnable::ready(Instant now)
{
    Held& h = *held_;
    if (works()) return true;
    if (now < h.next_try) return false;
    if (!h.get_back()) {
        constexpr auto kFirst = 500ms;
        constexpr unsigned kDoublings = 3; // 0.5, 1, 2, 4, 4 ... s
        h.next_try = now + kFirst * (1U << std::min(h.failures, kDoublings));
        ++h.failures;
        return false;
    }
    h.work();
    return true;
}

Instant DriverEnable::next_try() const noexcept
{
    return works() ? kNever : held_->next_try;
}

std::optional<Instant> DriverEnable::active_since() const noexcept
{
    const std::int64_t since = held_->since.load(std::memory_order_acquire);
    if (since == kInactive || since == kGuardAtWork) return std::nullopt;
    return Instant{std::chrono::nanoseconds{since}};
}

bool DriverEnable::drop_if_stuck(Instant now, std::chrono::nanoseconds limit) noexcept
{
    Held& h = *held_;
    const auto since = active_since();
    if (!since || now - *since <= limit) return false;
    const std::unique_lock lock(h.exchange_mutex, std::try_to_lock);
    if (!lock) return false; // the other thread makes the line inactive
    std::int64_t seen = ticks(*since);
    if (!h.since.compare_exchange_strong(seen, kGuardAtWork, std::memory_order_acq_rel)) return false;
    const bool dropped = !h.edge(false);
    h.since.store(dropped ? kInactive : seen, std::memory_order_release);
    return dropped;
}

bool DriverEnable::release_if_raised() noexcept
{
    Held& h = *held_;
    if (h.settings.direction != Direction::rts) return false;
    const std::unique_lock lock(h.exchange_mutex, std::try_to_lock);
    if (!lock || h.port == kNoPort) return false;
    const auto is_inactive = [&h] {
        return rts(h.port).value_or(h.settings.active_low) == h.settings.active_low;
    };
    if (h.since.load(std::memory_order_acquire) != kInactive || is_inactive()) return false;
    std::int64_t seen = kInactive; // no reply begins meanwhile
    if (!h.since.compare_exchange_strong(seen, kGuardAtWork, std::memory_order_acq_rel)) return false;
    const bool is_raised = !is_inactive(); // or a reply has begun and ended
    if (is_raised) static_cast<void>(h.edge(false));
    h.since.store(kInactive, std::memory_order_release);
    return is_raised;
}

std::optional<std::string> DriverEnable::self_check()
{
    Held& h = *held_;
    std::array<std::chrono::nanoseconds, 15> edges{};
    for (auto& edge : edges) {
        const Instant before = monotonic_now();
        const std::error_code error = by_hand() ? h.edge(false) : std::error_code{};
        if (error) return cannot_switch(h.settings, error);
        edge = monotonic_now() - before;
    }
    std::sort(edges.begin(), edges.end());
    h.edge_time = by_hand() ? edges[edges.size() / 2] : 0ns;
    return std::nullopt;
}

std::string DriverEnable::in_words() const
{
    const Held& h = *held_;
    const DriverEnableSettings& s = h.settings;
    std::string found = "driver enable: ";
    switch (s.direction) {
        case Direction::none: found += "none, the transceiver switches by itself"; break;
        case Direction::gpio:
            found += "line " + std::to_string(s.gpio_line) + " of GPIO chip " + s.gpio_chip + ", " +
                     (s.active_low ? "low" : "high") + " while sending; an edge takes " +
                     microseconds(h.edge_time);
            break;
        case Direction::kernel:
            found += "by the driver of the UART (TIOCSRS485, read back): RTS " +
                     std::string{s.active_low ? "released" : "asserted"} + " while sending" +
                     remarks_on_rs485(rs485_wanted(s), h.took);
            break;
        case Direction::rts:
            found += "RTS, " + std::string{s.active_low ? "released" : "asserted"} +
                     " while sending; an edge takes at least " + microseconds(h.edge_time);
            if (!s.active_low)
                found +=
                    "; the kernel asserts RTS for a moment whenever the port is opened, which disturbs a living bus";
            break;
    }
    if (h.port != kNoPort && s.direction != Direction::gpio)
        found += " (" + name_of_port(h.port) + " could also do: " + other_ways(h.port, s.direction) + ")";
    return found;
}

std::chrono::nanoseconds DriverEnable::edge_time() const noexcept
{
    return held_->edge_time;
}

std::optional<std::string> DriverEnable::doubt(Baud baud) const
{
    constexpr Tbit kFast{2};
    const auto edge = held_->edge_time;
    if (edge <= duration_of(kFast, baud)) return std::nullopt;
    const auto bits = edge.count() * static_cast<std::int64_t>(baud) / std::int64_t{1'000'000'000};
    return "driver enable: an edge takes " + microseconds(edge) + ", " + std::to_string(bits) +
           " bit times at " + std::to_string(static_cast<std::uint32_t>(baud)) +
           " bit/s, and the line is to be released within 11: use a line of the processor itself instead of an I2C or USB expander, direction = \"kernel\", or a lower rate";
}

} // namespace dpslave::io
