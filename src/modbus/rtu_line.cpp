// SPDX-License-Identifier: Apache-2.0
#include "rtu_line.hpp"

#include "pdu.hpp"

#include "dpslave/io/clock.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cerrno>

namespace dpslave::modbus {
namespace {

using namespace std::chrono_literals;

/// Octets around the part from the function code on: unit address before it, check sum behind it.
constexpr std::size_t kFrame = 3;

io::TtySettings tty_settings(const RtuSettings& settings)
{
    return {.baud = settings.baud,
            .data_bits = settings.data_bits,
            .parity = settings.parity,
            .stop_bits = settings.stop_bits};
}

} // namespace

int bits_of_a_character(const RtuSettings& settings)
{
    return 1 + settings.data_bits + (settings.parity == 'N' ? 0 : 1) + settings.stop_bits;
}

Result<std::unique_ptr<RtuLine>, std::string> RtuLine::open(const RtuSettings& settings,
                                                            std::atomic<bool>& is_open)
{
    auto port = io::Port::open(settings.port, tty_settings(settings), settings.reopen_after);
    if (!port) return Failure{port.error()};
    // libmodbus never opens the port: it would leave cooked modes of the tty on and fall back to 9600 in
    // silence.
    Context context{modbus_new_rtu(settings.port.c_str(), static_cast<int>(settings.baud), settings.parity,
                                   settings.data_bits, settings.stop_bits)};
    // One time-out for the answer as a whole: between its characters a driver may rest as long as it likes.
    if (!context || modbus_set_byte_timeout(context.get(), 0, 0) != 0)
        return Failure{settings.port + ": libmodbus refuses the settings of this port"};
    return std::unique_ptr<RtuLine>{new RtuLine{settings, std::move(context), *std::move(port), is_open}};
}

RtuLine::RtuLine(RtuSettings settings, Context context, io::Port port, std::atomic<bool>& is_open)
    : settings_(std::move(settings)), context_(std::move(context)), port_(std::move(port)), is_open_(is_open)
{
    use_port();
}

/// Opened just now: nobody owes an answer on it.
void RtuLine::use_port()
{
    modbus_set_socket(context_.get(), port_.tty().fd());
    late_until_ = {};
    heard_at_ = io::monotonic_now();
}

bool RtuLine::ready()
{
    if (port_.is_open()) return true;
    const bool is_back = port_.ready(io::monotonic_now());
    if (const auto why = port_.take_trouble()) spdlog::error("{}; it is tried again", *why);
    if (!is_back) return false;
    use_port();
    is_open_.store(true, std::memory_order_relaxed);
    spdlog::info("{} is back", settings_.port);
    return true;
}

void RtuLine::lose()
{
    modbus_set_socket(context_.get(), -1);
    port_.lose(io::monotonic_now());
    is_open_.store(false, std::memory_order_relaxed);
    trouble_ = settings_.port + " has gone";
    spdlog::error("{} has gone; it is opened again as soon as it returns", settings_.port);
}

std::chrono::nanoseconds RtuLine::duration_of(std::size_t characters) const
{
    return std::chrono::nanoseconds{static_cast<std::int64_t>(characters) * bits_of_a_character(settings_) *
                                    std::nano::den / settings_.baud};
}

/// 3.5 characters, beyond 19200 bit/s a fixed time (MODBUS over Serial Line V1.02, 2.5.1.1).
std::chrono::nanoseconds RtuLine::pause() const
{
    return settings_.baud > 19'200 ? std::chrono::nanoseconds{1'750us} : duration_of(7) / 2;
}

std::optional<Bytes> RtuLine::exchange(std::uint8_t unit, Bytes request)
{
    trouble_.clear();
    if (unit < kLowestUnit || unit > kHighestUnit) {
        trouble_ = "unit " + std::to_string(unit) + " is no Modbus address (1 to 247)";
        return std::nullopt;
    }
    if (!ready()) {
        trouble_ = settings_.port + " has gone";
        return std::nullopt;
    }
    if (!await_late_answer(unit) || !await_pause() || !send(unit, request)) return std::nullopt;
    return receive_answer(unit, request);
}

/// Two answers of a unit look alike, whatever was asked. False: the port is gone.
bool RtuLine::await_late_answer(std::uint8_t unit)
{
    const Instant until = std::exchange(late_until_[unit], Instant{});
    while (io::monotonic_now() < until) {
        switch (receive(unit, until)) {
            case Heard::frame:
            case Heard::noise: return true; // that was it, well or spoilt
            case Heard::gone: return false;
            case Heard::other:
            case Heard::silence:
            case Heard::broken_off: break;
        }
    }
    return true;
}

/// Without a pause a slave does not take what follows for the beginning of a request. What nobody asked for
/// passes meanwhile; a line that babbles on is waited for as long as the longest telegram takes. False: the
/// port is gone.
bool RtuLine::await_pause()
{
    const Instant end = io::monotonic_now() + duration_of(adu_.size()) + pause();
    for (Instant now = io::monotonic_now(); now < end; now = io::monotonic_now()) {
        const auto rest = std::max<std::chrono::nanoseconds>(std::min(end, heard_at_ + pause()) - now, 0ns);
        if (!port_.tty().wait_readable(rest)) return true;
        if (!port_.tty().read(adu_)) {
            lose();
            return false;
        }
        heard_at_ = io::monotonic_now();
    }
    return true;
}

bool RtuLine::send(std::uint8_t unit, Bytes request)
{
    ByteBuffer<Request::capacity() + 1> raw;
    raw.push(unit);
    raw.append(request);
    modbus_set_slave(context_.get(), unit);
    const Bytes octets = raw;
    if (modbus_send_raw_request(context_.get(), octets.data(), static_cast<int>(octets.size())) >= 0)
        return true;
    if (errno == EAGAIN || errno == EINTR || errno == EMBBADDATA) { // a port that is only slow is still there
        modbus_flush(context_.get());
        trouble_ = "the line does not take the request";
    } else {
        lose();
    }
    return false;
}

/// What fits another request is passed over: the answer may still come.
std::optional<Bytes> RtuLine::receive_answer(std::uint8_t unit, Bytes request)
{
    trouble_ = "no answer";
    // The library's write does not wait for the wire.
    const Instant until = io::monotonic_now() + duration_of(request.size() + kFrame) + settings_.timeout +
                          duration_of(longest_answer(request) + kFrame);
    for (Instant now = io::monotonic_now(); now < until; now = io::monotonic_now()) {
        switch (receive(unit, until)) {
            case Heard::frame: {
                const Bytes answer = Bytes{adu_}.subspan(1, adu_length_ - kFrame);
                if (answers(request, answer)) {
                    trouble_.clear();
                    return answer;
                }
                trouble_ = "an answer that does not fit the request: " +
                           hex(answer.first(std::min<std::size_t>(answer.size(), 5)));
                break;
            }
            case Heard::other: trouble_ = "an answer of unit " + std::to_string(adu_[0]); break;
            case Heard::silence: break;
            case Heard::broken_off: trouble_ = "the answer broke off"; break;
            case Heard::noise: return std::nullopt;
            case Heard::gone: return std::nullopt;
        }
    }
    late_until_[unit] = io::monotonic_now() + settings_.timeout;
    return std::nullopt;
}

RtuLine::Heard RtuLine::receive(std::uint8_t unit, Instant until)
{
    using std::chrono::microseconds;
    const auto left = std::max(std::chrono::ceil<microseconds>(until - io::monotonic_now()), microseconds{1});
    modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(left / 1s),
                                static_cast<std::uint32_t>((left % 1s).count()));
    adu_[0] = 0;
    errno = 0;
    const int length = modbus_receive_confirmation(context_.get(), adu_.data());
    const int error = errno;
    if (length < 0 && error == ETIMEDOUT && adu_[0] == 0) return Heard::silence;
    heard_at_ = io::monotonic_now();
    if (length >= 0) { // 0: the library itself has seen another unit
        adu_length_ = static_cast<std::size_t>(length);
        return adu_length_ > kFrame && adu_[0] == unit ? Heard::frame : Heard::other;
    }
    switch (error) {
        case ETIMEDOUT: return Heard::broken_off;
        case EAGAIN:
        case EINTR: return Heard::silence; // nothing was there after all; the caller looks at the time
        case EMBBADCRC: trouble_ = "an answer with a wrong check sum"; return Heard::noise;
        case EMBBADDATA: trouble_ = "an answer that is longer than any"; return Heard::noise;
        case ECONNRESET: // the library read nothing: a line that hung up reads like that, but not it alone
            if (!port_.tty().hung_up()) return Heard::silence;
            [[fallthrough]];
        default: lose(); return Heard::gone;
    }
}

} // namespace dpslave::modbus
