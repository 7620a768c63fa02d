// SPDX-License-Identifier: Apache-2.0
#include "rtu_line.hpp"

#include "pdu.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/thread_sign.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace dpslave::modbus {
namespace {

using namespace std::chrono_literals;

/// Between the characters of a frame a driver may rest, however short the standard has it.
constexpr auto kMinGap = 20ms;
constexpr int kGapCharacters = 20;

io::TtySettings tty_settings(const RtuSettings& settings)
{
    return {.baud = settings.baud,
            .data_bits = settings.data_bits,
            .parity = settings.parity,
            .stop_bits = settings.stop_bits,
            .mark_errors = true,
            .prompt = true};
}

} // namespace

int bits_of_a_character(const RtuSettings& settings)
{
    return 1 + settings.data_bits + (settings.parity == 'N' ? 0 : 1) + settings.stop_bits;
}

Result<std::unique_ptr<RtuLine>, std::string> RtuLine::open(const RtuSettings& settings,
                                                            std::atomic<bool>& is_open)
{
    auto port = io::SwitchedPort::open(settings.port, tty_settings(settings), settings.transceiver,
                                       settings.reopen_after);
    if (!port) return Failure{port.error()};
    // libmodbus never opens the port: it would leave cooked modes of the tty on and fall back to 9600 in
    // silence.
    Context context{modbus_new_rtu(settings.port.c_str(), static_cast<int>(settings.baud), settings.parity,
                                   settings.data_bits, settings.stop_bits)};
    if (!context) return Failure{settings.port + ": libmodbus refuses the settings of this port"};
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) < 0)
        return Failure{settings.port + ": no descriptor is left (" + std::system_category().message(errno) +
                       ')'};
    Pipe built{.in = io::Fd{ends[1]}, .out = io::Fd{ends[0]}};
    return std::unique_ptr<RtuLine>{
        new RtuLine{settings, std::move(context), std::move(built), *std::move(port), is_open}};
}

RtuLine::RtuLine(RtuSettings settings, Context context, Pipe built, io::SwitchedPort port,
                 std::atomic<bool>& is_open)
    : settings_(std::move(settings)),
      context_(std::move(context)),
      built_(std::move(built)),
      port_(std::move(port)),
      is_open_(is_open),
      character_(std::chrono::nanoseconds{bits_of_a_character(settings_) * std::nano::den / settings_.baud})
{
    modbus_set_socket(context_.get(), built_.in.get());
    use_port();
}

void RtuLine::use_port()
{
    receiver_.silence();
    hold_back_ = port_.tty().hold_back();
    takes_wire_time_ = drive::takes_wire_time(settings_.wire_time, port_.tty().is_pty());
    heard_ = {};
    bad_behind_ = false;
}

bool RtuLine::ready()
{
    if (port_.is_open()) return true;
    const bool is_back = port_.ready(now());
    if (const auto why = port_.take_trouble()) messages_.push_back({true, *why + "; it is tried again"});
    if (!is_back) return false;
    use_port();
    is_open_.store(true, std::memory_order_relaxed);
    messages_.push_back({false, settings_.port + " is back"});
    return true;
}

void RtuLine::lose()
{
    port_.lose(now());
    is_open_.store(false, std::memory_order_relaxed);
    messages_.push_back({true, settings_.port + " is missing; it is opened again as soon as it returns"});
}

void RtuLine::reopen()
{
    port_.reopen(now());
    is_open_.store(false, std::memory_order_relaxed);
}

Instant RtuLine::now() const
{
    return io::monotonic_now();
}

std::chrono::nanoseconds RtuLine::gap() const
{
    const std::int64_t bits = std::int64_t{kGapCharacters} * bits_of_a_character(settings_);
    return std::max<std::chrono::nanoseconds>(
               kMinGap, std::chrono::nanoseconds{bits * std::nano::den / settings_.baud}) +
           settings_.rules.hold_back + hold_back_;
}

/// The frame as it goes on the wire. It is in the pipe as a whole: it is shorter than what a pipe takes.
Bytes RtuLine::build(std::uint8_t unit, Bytes pdu)
{
    ByteBuffer<Request::capacity() + 1> raw;
    raw.push(unit);
    raw.append(pdu);
    modbus_set_slave(context_.get(), unit);
    const Bytes octets = raw;
    if (modbus_send_raw_request(context_.get(), octets.data(), static_cast<int>(octets.size())) < 0)
        return {};
    const ssize_t size = ::read(built_.out.get(), request_.data(), request_.size());
    return size > 0 ? Bytes{request_}.first(static_cast<std::size_t>(size)) : Bytes{};
}

bool RtuLine::send(std::uint8_t unit, Bytes pdu)
{
    may_have_left_ = false;
    if (!ready()) return false;
    receiver_.sent(unit, pdu);
    const Bytes request = build(unit, pdu);
    if (request.empty()) return false;
    const std::error_code trouble = port_.write(request);
    // Without a stall only a part of it has gone, or nothing.
    may_have_left_ = trouble == std::errc::timed_out && io::this_thread_stalled();
    // A port that is only slow, or whose guard is at work, or that was not written to, is still there.
    const bool is_there = !trouble || trouble == std::errc::timed_out ||
                          trouble == std::errc::operation_canceled ||
                          trouble == std::errc::resource_unavailable_try_again;
    if (!port_.is_open())
        is_open_.store(false, std::memory_order_relaxed); // its driver enable has failed: ready() says so
    else if (!is_there)
        lose();
    return !trouble;
}

ModbusPort::Heard RtuLine::receive(Instant until)
{
    if (!ready()) return Heard::gone;
    const Instant latest =
        until + character_ * std::int64_t{kLongestFrame} + gap(); // a line may never stop sending
    for (;;) {
        if (const Heard heard = take_heard(); heard != Heard::silence) return heard;
        const bool in_frame = receiver_.in_frame();
        const Instant at = now();
        const Instant end = in_frame ? std::min(at + gap(), latest) : until;
        if (fetch(end)) continue; // also what waits in the port when it is too late
        if (!port_.is_open()) return Heard::gone;
        if (!in_frame) return Heard::silence;
        const FrameReceiver::Found found = receiver_.silence();
        if (found == FrameReceiver::Found::broken) return Heard::broken;
        if (found == FrameReceiver::Found::rest) return Heard::rest;
    }
}

/// Returns when the next of the octets read was on the line at the latest: the others came after it.
Instant RtuLine::end_of_next() const
{
    const std::size_t behind = heard_.size() + (bad_behind_ ? 1 : 0) - 1;
    return drive::latest_begin(read_at_, behind, character_);
}

/// Returns whether the octets read have become a frame or something broken; silence: they are used up.
ModbusPort::Heard RtuLine::take_heard()
{
    while (!heard_.empty() || bad_behind_) {
        FrameReceiver::Found found{};
        const Instant end = end_of_next();
        if (heard_.empty()) {
            bad_behind_ = false;
            found = receiver_.fault(end);
        } else {
            found = receiver_.feed(heard_.front(), end);
            heard_ = heard_.subspan(1);
        }
        if (found == FrameReceiver::Found::frame) return Heard::frame;
        if (found == FrameReceiver::Found::broken) return Heard::broken;
    }
    return Heard::silence;
}

/// Returns false if nothing came, or the port has gone.
bool RtuLine::fetch(Instant until)
{
    if (!port_.tty().wait_readable(std::max<std::chrono::nanoseconds>(until - now(), 0ns))) return false;
    const auto chunk = [&] {
        const io::InCall read{io::PortCall::read};
        return port_.tty().read(buffer_);
    }();
    if (!chunk) {
        lose();
        return false;
    }
    if (io::this_thread_stalled()) return false; // what it brings is no answer, and the port goes
    read_at_ = now();
    heard_ = chunk->octets;
    bad_behind_ = chunk->bad_character;
    return !heard_.empty() || bad_behind_ || now() < until;
}

} // namespace dpslave::modbus
