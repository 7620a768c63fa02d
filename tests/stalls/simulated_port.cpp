// SPDX-License-Identifier: Apache-2.0
/// With it the functions of the program that the simulation takes the place of: its clock, the wait of a line
/// that has nothing to do, and the opening of a port.
#include "simulated_port.hpp"

#include "app/line/line_backend.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/thread_sign.hpp"
#include "dpslave/modbus/modbus_client.hpp"

#include <poll.h>

#include <algorithm>

namespace dpslave::stalls {
namespace {

/// What one turn of the loop takes at least.
constexpr std::chrono::microseconds kTurn{100};

/// EI-ASCII: EOT, the address four times, and STX before what is written.
bool is_value(Bytes octets)
{
    return octets.size() > 5 && octets[5] == 0x02;
}

bool is_value_of_modbus(Bytes pdu)
{
    return pdu[0] == 6 || pdu[0] == 16;
}

/// As io/switched_port does it.
template <class Leave>
bool write_as_the_program(World& world, bool& has_unsent, bool& may_have_left, unsigned& opened,
                          bool is_value, const Leave& leave)
{
    may_have_left = false;
    if (std::exchange(opened, world.times_closed()) != world.times_closed()) {
        has_unsent = false;
        world.open();
    }
    if (!io::this_thread_may_write()) return false;
    if (std::exchange(has_unsent, false)) world.judge().sent_on(world.now());
    {
        const io::InCall write{io::PortCall::write};
        has_unsent = !world.writes(is_value, leave);
    }
    {
        const io::InCall drain{io::PortCall::drain};
        world.may_stall(Where::drain);
    }
    may_have_left = io::this_thread_stalled();
    return !may_have_left;
}

/// False: the call stalls, and what it brings is no answer.
bool fetches(World& world)
{
    {
        const io::InCall read{io::PortCall::read};
        world.may_stall(Where::read);
    }
    return !io::this_thread_stalled();
}

/// The end of the slice of a wait.
Instant slice_end(const World& world, Instant until)
{
    const Instant end = std::min(until, io::waits_of_this_thread_end());
    return std::clamp(end, world.now(), world.now() + io::ThreadSign::kSlice);
}

} // namespace

bool EiPort::write(Bytes octets)
{
    return write_as_the_program(world_, has_unsent_, may_have_left_, opened_, is_value(octets),
                                [&] { line_.write(octets); });
}

std::size_t EiPort::read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout)
{
    const Instant until = world_.now() + timeout;
    for (;;) {
        world_.may_rest();
        const Instant end = slice_end(world_, until);
        const std::size_t got = line_.read(into, end - line_.time);
        world_.waits_until(line_.time);
        if (io::this_thread_stalled()) return 0;
        if (got != 0) return fetches(world_) ? got : 0;
        if (world_.now() >= std::min(until, io::waits_of_this_thread_end())) return 0;
    }
}

bool FramesPort::send(std::uint8_t unit, Bytes pdu)
{
    return write_as_the_program(world_, has_unsent_, may_have_left_, opened_, is_value_of_modbus(pdu),
                                [&] { line_.send(unit, pdu); });
}

modbus::ModbusPort::Heard FramesPort::receive(Instant until)
{
    for (;;) {
        world_.may_rest();
        const Heard heard = line_.receive(slice_end(world_, until));
        world_.waits_until(line_.time);
        if (io::this_thread_stalled()) return Heard::silence;
        if (heard != Heard::silence) return fetches(world_) ? heard : Heard::silence;
        if (world_.now() >= std::min(until, io::waits_of_this_thread_end())) return heard;
    }
}

} // namespace dpslave::stalls

// ---- in the place of functions of the program

namespace dpslave::io {

Instant monotonic_now() noexcept
{
    const stalls::World* const world = stalls::World::current();
    return world != nullptr ? world->now() : Instant{std::chrono::hours{1}};
}

void sleep_until(Instant when) noexcept
{
    if (stalls::World* const world = stalls::World::current()) world->waits_until(when);
}

std::chrono::nanoseconds unix_now() noexcept
{
    return monotonic_now().time_since_epoch();
}

} // namespace dpslave::io

namespace dpslave::app {

drive::BlockRule LineBackend::block_rule(const config::LineConfig& line)
{
    constexpr int kBitsOfACharacter = 10;
    return line.protocol == config::kModbusRtu
               ? modbus::ModbusClient::block_rule(line.baud, kBitsOfACharacter)
               : drive::BlockRule{};
}

Result<std::unique_ptr<LineBackend>, std::string> LineBackend::open(const config::LineConfig&,
                                                                    const Listeners& listeners)
{
    auto made = std::make_unique<LineBackend>(listeners);
    made->backend_ = stalls::World::current()->open_port();
    return made;
}

int LineBackend::fd() const
{
    return 0; // ppoll() below knows it
}

void LineBackend::reopen()
{
    stalls::World::current()->close();
}

/// No other program has the port.
std::optional<io::ChangedSettings> LineBackend::changed_settings() const
{
    return std::nullopt;
}
std::error_code LineBackend::set_again(const io::ChangedSettings&)
{
    return {};
}

void LineBackend::tell_port_messages() {}
void LineBackend::set_units(const std::vector<DriveUnit>&) {}
std::string LineBackend::driver_in_words() const
{
    return {};
}

} // namespace dpslave::app

/// A line with nothing to do: time passes, and what has come meanwhile is to be looked at.
extern "C" int ppoll(pollfd* fds, nfds_t count, const timespec* timeout, const __sigset_t*)
{
    using namespace dpslave;
    stalls::World* const world = stalls::World::current();
    world->may_rest();
    const std::chrono::nanoseconds wait =
        std::chrono::seconds{timeout->tv_sec} + std::chrono::nanoseconds{timeout->tv_nsec};
    world->waits_until(world->now() + std::max<std::chrono::nanoseconds>(wait, stalls::kTurn));
    if (count > 1 && fds[1].fd >= 0) fds[1].revents = POLLIN;
    return 1;
}
