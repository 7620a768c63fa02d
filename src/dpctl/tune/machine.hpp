// SPDX-License-Identifier: Apache-2.0
/// Facts of the machine that decide how late a reply can be: kernel, processors, the port's UART and driver,
/// the threads in between. Read from /proc, /sys and /dev below a root folder ("/" in service, a tree of its
/// own in a test). What cannot be read is missing, never guessed. Source: wire reference 11.1, 11.5 and 11.6.
///
/// A port is looked at from outside and never opened: open(2) raises RTS and DTR, and on many boards RTS is
/// what switches the transceiver to sending.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::io {

enum class Policy : std::uint8_t { ordinary, fifo, round_robin, deadline };

struct ThreadFacts {
    int id = 0;       ///< as chrt(1) takes it
    std::string name; ///< the kernel keeps 15 characters of it: "irq/30-uart-pl0"
    Policy policy = Policy::ordinary;
    int priority = 0; ///< 1..99 with fifo and round_robin, otherwise 0
    std::string cpus; ///< where it may run, as the kernel writes lists: "0-2"; empty = not known
    std::uint64_t major_faults = 0; ///< pages that had to be read from a disk
    bool kernel = false;            ///< a thread of the kernel
    bool is_realtime() const { return policy != Policy::ordinary; }
};

struct MachineFacts {
    std::string release; ///< "6.1.0-56-rt-amd64"; empty = not known
    std::string version; ///< "#1 SMP PREEMPT_RT Debian ..."
    bool preempt_rt = false;
    bool threaded_irqs = false; ///< PREEMPT_RT, or `threadirqs` on the kernel's command line
    /// us of each period that real-time threads may use; -1 = all of it
    std::optional<int> rt_runtime_us;
    int processors = 0;                 ///< that are online; 0 = not known
    std::string isolated;               ///< list of processors, empty = none
    std::vector<std::string> governors; ///< each once; empty = the frequency does not change
    std::string deepest_idle;           ///< name of the enabled idle state that takes longest to leave
    std::optional<int> idle_exit_us;    ///< and how long that takes; nothing = no idle states
    /// The limit on the exit latency that a process holds (PM QoS, /dev/cpu_dma_latency); nothing = none
    /// does, or not readable (root only).
    std::optional<int> latency_limit_us;
    bool virtual_machine = false;
    /// Kernel workers that may carry characters from the driver to the reader (flush_to_ldisc).
    std::vector<ThreadFacts> unbound_workers;
    /// Threads of programs that have a real-time policy.
    std::vector<ThreadFacts> realtime_threads;
};
MachineFacts read_machine(const std::filesystem::path& root);

struct PortFacts {
    std::string path; ///< as it was asked for
    std::string name; ///< behind links: "ttyS1"; "pts/3" of a pty
    bool there = false;
    bool serial = false; ///< the kernel lists it as a tty with a device
    bool pty = false;
    bool usb = false;
    std::string device;                      ///< its folder in sysfs, without the root
    std::string driver;                      ///< "uart-pl011", "ftdi_sio"; empty = not known
    std::optional<int> type;                 ///< PORT_... of linux/serial_core.h: 4 = 16550A
    std::optional<std::uint32_t> uart_clock; ///< Hz; a sixteenth of it is the highest rate of most UARTs
    std::optional<int> fifo;                 ///< characters that the transmitter takes at once
    std::optional<int> trigger; ///< characters in the receive FIFO that make an interrupt (rx_trig_bytes)
    bool trigger_settable = false;
    std::optional<int> latency_timer_ms; ///< of an FTDI adapter
    bool dma = false;                    ///< the device tree gives its receiver a DMA channel
    std::optional<int> irq;
    std::optional<ThreadFacts>
        irq_thread; ///< the slowest of that interrupt; nothing = the IRQ is not threaded
};
PortFacts read_port(const std::filesystem::path& root, const std::string& path);

struct ProcessFacts {
    std::vector<ThreadFacts> threads;
    std::optional<std::uint64_t> locked_kib; ///< memory that is never paged out
};
/// Nothing if there is no such process.
std::optional<ProcessFacts> read_process(const std::filesystem::path& root, int pid);

} // namespace dpslave::io
