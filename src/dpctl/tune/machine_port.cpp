// SPDX-License-Identifier: Apache-2.0
// What sysfs says about a serial port.
#include "proc_files.hpp"

#include <string_view>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;

std::optional<int> small_number(const fs::path& path)
{
    const auto number = file_number(path);
    return number ? std::optional{static_cast<int>(*number)} : std::nullopt;
}

/// The name below /dev, behind links such as /dev/serial/by-id.
std::string name_of(const fs::path& real, const fs::path& dev)
{
    const fs::path inside = real.lexically_relative(dev);
    return inside.empty() || *inside.begin() == ".." ? real.filename().string() : inside.string();
}

/// Kernels from 6.6 on put two devices of their own (bus serial-base, drivers "port" and "ctrl") between a
/// tty and its hardware: the first device above them is meant.
fs::path hardware_of(fs::path device)
{
    std::error_code error;
    for (; !device.empty() && device != device.parent_path(); device = device.parent_path()) {
        const fs::path driver = fs::canonical(device / "driver", error);
        if (!error && driver.parent_path().parent_path().filename() != "serial-base") return device;
        if (error && !fs::exists(device / "uevent")) break; // a folder between devices, or the end
    }
    return {};
}

/// The thread of this interrupt that would answer last: ordinary before real-time, low before high.
std::optional<ThreadFacts> irq_thread(const fs::path& root, int irq)
{
    const std::string prefix = "irq/" + std::to_string(irq) + "-";
    std::optional<ThreadFacts> slowest;
    for (const int pid : numbers_in(root / "proc")) {
        auto thread = read_thread(root / "proc" / std::to_string(pid));
        if (!thread || !thread->kernel || thread->name.rfind(prefix, 0) != 0) continue;
        if (!slowest || thread->priority < slowest->priority) slowest = std::move(thread);
    }
    return slowest;
}

void read_uart(const fs::path& root, const fs::path& tty, PortFacts& port)
{
    port.type = small_number(tty / "type");
    if (const auto clock = file_number(tty / "uartclk"); clock && *clock > 0)
        port.uart_clock = static_cast<std::uint32_t>(*clock);
    port.fifo = small_number(tty / "xmit_fifo_size");
    port.trigger = small_number(tty / "rx_trig_bytes");
    std::error_code error;
    const auto mode = fs::status(tty / "rx_trig_bytes", error).permissions();
    port.trigger_settable = !error && port.trigger && (mode & fs::perms::owner_write) != fs::perms::none;
    if (const auto irq = small_number(tty / "irq"); irq && *irq > 0) {
        port.irq = irq;
        port.irq_thread = irq_thread(root, *irq);
    }
}

} // namespace

PortFacts read_port(const fs::path& root, const std::string& path)
{
    PortFacts port;
    port.path = path;
    std::error_code error;
    const fs::path real = fs::canonical(root / fs::path(path).relative_path(), error);
    if (error) return port;
    port.there = true;
    port.name = name_of(real, fs::canonical(root / "dev", error));
    port.pty = port.name.rfind("pts/", 0) == 0;
    if (port.pty) return port;

    const fs::path tty = root / "sys/class/tty" / port.name;
    const fs::path device = fs::canonical(tty / "device", error);
    if (error) return port; // a virtual console, or no tty at all
    port.serial = true;
    port.latency_timer_ms = small_number(device / "latency_timer");
    if (const fs::path hardware = hardware_of(device); !hardware.empty()) {
        port.driver = fs::canonical(hardware / "driver", error).filename().string();
        port.device = "/" + hardware.lexically_relative(fs::canonical(root, error)).string();
        port.usb = port.device.find("/usb") != std::string::npos;
        // Entries end with NUL: "rx" NUL "tx" NUL.
        port.dma = file_text(hardware / "of_node/dma-names").value_or("").find("rx") != std::string::npos;
    }
    read_uart(root, tty, port);
    return port;
}

} // namespace dpslave::io
