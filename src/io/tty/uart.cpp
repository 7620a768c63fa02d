// SPDX-License-Identifier: Apache-2.0
#include "uart.hpp"

#include "dpslave/io/uart_kind.hpp"

#include <linux/major.h>
#include <linux/serial.h>
#include <linux/serial_core.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;

template <class Set, class T>
bool is_one_of(const Set& set, const T& value)
{
    return std::find(set.begin(), set.end(), value) != set.end();
}

bool is_pty(unsigned device_major)
{
    return device_major >= UNIX98_PTY_SLAVE_MAJOR &&
           device_major < UNIX98_PTY_SLAVE_MAJOR + UNIX98_PTY_MAJOR_COUNT;
}

/// The driver of the device, not those of the serial core, which newer kernels put in between ("port" of
/// "ctrl" of it).
std::string driver_of(const fs::path& tty)
{
    constexpr std::array<std::string_view, 2> kCore{"port", "ctrl"};
    std::error_code error;
    fs::path device = fs::canonical(tty / "device", error);
    while (!error) {
        const std::string driver = fs::canonical(device / "driver", error).filename().string();
        if (error || !is_one_of(kCore, driver)) return error ? "" : driver;
        device = device.parent_path();
    }
    return {};
}

/// Returns the number that a file of sysfs holds; nullopt if there is no such file, or no number in it.
std::optional<long> number_in(const fs::path& file)
{
    std::ifstream in{file};
    long number = 0;
    if (in >> number) return number;
    return std::nullopt;
}

/// Sets a file of sysfs to 1, if it is there, and reads back what has become of it.
std::optional<long> set_to_one(const fs::path& file)
{
    const auto number = number_in(file);
    if (!number || number == 1) return number;
    std::ofstream{file} << "1\n";
    return number_in(file);
}

std::string as_root(const Uart& uart, const std::string& attribute)
{
    return "let root or a udev rule write 1 to /sys/class/tty/" + uart.name + "/" + attribute;
}

/// `what` is in bit times, or named in them.
std::string costs(const std::string& what)
{
    return ": this costs " + what +
           " of the time that an answer may take; a longer max_tsdr, here and in the master's GSD, makes room for it";
}

/// Bit times are the same at every rate; a time is not.
std::string in_bit_times(long milliseconds)
{
    return std::to_string(milliseconds) + " ms (" + std::to_string(milliseconds * 9'600 / 1'000) +
           " bit times at 9.6 kbit/s, " + std::to_string(milliseconds * 1'500) + " at 1.5 Mbit/s)";
}

bool is_plain_8250(const Uart& uart)
{
    return uart_kind(uart.driver) == UartKind::i8250;
}

/// Returns how long the receiver waits on an idle line before it hands on fewer octets than its trigger, in
/// bit times; 0 if it has no such wait, or nothing is known about it.
std::uint32_t idle_wait(const Uart& uart)
{
    constexpr std::array kWithoutFifo{PORT_8250, PORT_16450};
    if (is_plain_8250(uart) && is_one_of(kWithoutFifo, uart.type)) return 0;
    return idle_timeout(uart_kind(uart.driver));
}

std::optional<std::string> trigger_warning(const Uart& uart)
{
    const auto trigger = set_to_one(uart.folder / "rx_trig_bytes");
    if (trigger == 1) return std::nullopt;
    const std::uint32_t wait = idle_wait(uart);
    if (trigger)
        return "the UART hands on what it receives by " + std::to_string(*trigger) +
               " octets, and fewer only after the line was idle for a while" +
               costs("up to " + std::to_string(wait != 0 ? wait : 44) + " bit times") +
               ". Better: " + as_root(uart, "rx_trig_bytes");
    if (wait == 0) return std::nullopt;
    return "the UART hands a few octets on only after the line was idle for a while, and its driver (" +
           uart.driver + ") has no receive trigger to set" +
           costs("up to " + std::to_string(wait) + " bit times");
}

std::optional<std::string> usb_warning(const Uart& uart)
{
    const UartKind kind = uart_kind(uart.driver);
    if (!is_usb(kind)) return std::nullopt;
    if (kind == UartKind::ftdi) {
        const long timer = set_to_one(uart.folder / "device/latency_timer").value_or(16);
        if (timer != 1)
            return "the USB adapter gathers what it receives" + costs("up to " + in_bit_times(timer)) +
                   ". Better: " + as_root(uart, "device/latency_timer");
    }
    return "the USB adapter hands on what it receives once in a USB frame" +
           costs("up to " + in_bit_times(1)) + ". A UART on the board does better";
}

} // namespace

Uart look_at(int fd, const fs::path& sysfs)
{
    Uart uart;
    struct stat info {};
    if (::fstat(fd, &info) < 0) return uart;
    uart.pty = is_pty(major(info.st_rdev));
    const fs::path link = sysfs / "dev/char" /
                          (std::to_string(major(info.st_rdev)) + ":" + std::to_string(minor(info.st_rdev)));
    std::error_code error;
    if (fs::path folder = fs::canonical(link, error); !error) {
        uart.name = folder.filename().string();
        uart.driver = driver_of(folder);
        uart.folder = std::move(folder);
    }
    refresh(uart, fd);
    return uart;
}

void refresh(Uart& uart, int fd)
{
    serial_struct serial{};
    if (uart.pty || ::ioctl(fd, TIOCGSERIAL, &serial) < 0) return;
    uart.type = serial.type;
    uart.baud_base = static_cast<std::uint32_t>(std::max(serial.baud_base, 0));
}

std::optional<std::uint32_t> rate_on_the_wire(const Uart& uart, std::uint32_t asked)
{
    // Chips of the family that divide by whole numbers only; drivers of their own (DesignWare, OMAP, Exar
    // ...) have fractions, other oversampling, or a clock that follows the rate.
    constexpr std::array kWhole{PORT_8250, PORT_16450, PORT_16550, PORT_16550A, PORT_16750, PORT_NS16550A};
    if (uart.baud_base == 0 || asked == 0 || !is_one_of(kWhole, uart.type)) return std::nullopt;
    if (!uart.driver.empty() && !is_plain_8250(uart)) return std::nullopt;
    const std::uint64_t base = uart.baud_base;
    const std::uint64_t divisor = std::max<std::uint64_t>((base + asked / 2) / asked, 1);
    return static_cast<std::uint32_t>((base + divisor / 2) / divisor);
}

std::string rate_remedy(const Uart& uart)
{
    std::string choice = "choose a rate that it can do, or another adapter";
    if (uart.baud_base == 0 || (!uart.driver.empty() && !is_plain_8250(uart))) return choice;
    return choice + "; the driver takes the UART to reach " + std::to_string(uart.baud_base) +
           " bit/s: if its clock is another one, set it as root with `setserial " +
           (uart.name.empty() ? "PORT" : "/dev/" + uart.name) + " baud_base N`";
}

std::string judge_rate(const Uart& uart, std::uint32_t asked, std::uint32_t took)
{
    const auto too_far = [asked](std::uint32_t rate) {
        const std::uint32_t off = asked > rate ? asked - rate : rate - asked;
        return std::uint64_t{off} * 100 > asked;
    };
    const auto cannot = [&](const std::string& instead) {
        return "this UART cannot do " + std::to_string(asked) + " bit/s (" + instead +
               "): " + rate_remedy(uart);
    };
    if (too_far(took)) return cannot("it took " + std::to_string(took));
    const auto wire = rate_on_the_wire(uart, asked);
    if (!wire || !too_far(*wire)) return {};
    return cannot("it divides its clock by a whole number, which makes " + std::to_string(*wire) + " of it");
}

std::vector<std::string> set_prompt(const Uart& uart)
{
    std::vector<std::string> warnings;
    if (uart.folder.empty()) return warnings;
    if (auto warning = trigger_warning(uart)) warnings.push_back(*std::move(warning));
    if (auto warning = usb_warning(uart)) warnings.push_back(*std::move(warning));
    return warnings;
}

void note_triggers(Uart& uart)
{
    if (uart.folder.empty()) return;
    uart.latency_timer = number_in(uart.folder / "device/latency_timer");
    uart.receive_trigger = number_in(uart.folder / "rx_trig_bytes");
}

std::chrono::nanoseconds hold_back(const Uart& uart, std::chrono::nanoseconds bit_time)
{
    constexpr std::chrono::milliseconds kUsbFrame{1};
    const UartKind kind = uart_kind(uart.driver);
    if (uart.folder.empty() || uart.pty) return {};
    if (kind == UartKind::ftdi) return std::chrono::milliseconds{uart.latency_timer.value_or(16)} + kUsbFrame;
    if (is_usb(kind)) return kUsbFrame;
    if (uart.receive_trigger == 1) return {};
    return idle_wait(uart) * bit_time;
}

} // namespace dpslave::io
