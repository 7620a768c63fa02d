// SPDX-License-Identifier: Apache-2.0
/// A /proc, /sys and /dev of a test's own. Each machine below is written down as its kernel shows it; files
/// that no test reads are left out.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace dpslave::test {

class MachineTree {
public:
    MachineTree()
    {
        std::string name = (std::filesystem::temp_directory_path() / "machine-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        root_ = name;
    }
    MachineTree(const MachineTree&) = delete;
    MachineTree& operator=(const MachineTree&) = delete;
    ~MachineTree()
    {
        std::error_code ignored;
        std::filesystem::remove_all(root_, ignored);
    }

    const std::filesystem::path& root() const { return root_; }

    void file(const std::string& path, const std::string& text, unsigned mode = 0644)
    {
        const auto full = root_ / path;
        std::filesystem::create_directories(full.parent_path());
        std::filesystem::remove(full);
        std::ofstream(full, std::ios::binary) << text;
        ::chmod(full.c_str(), mode);
    }
    /// A relative link, as sysfs has them.
    void link(const std::string& path, const std::string& target)
    {
        const auto full = root_ / path;
        std::filesystem::create_directories(full.parent_path());
        std::filesystem::create_directories(root_ / target);
        std::filesystem::create_symlink((root_ / target).lexically_relative(full.parent_path()), full);
    }

    void kernel(const std::string& release, const std::string& version, const std::string& cmdline = "quiet")
    {
        file("proc/sys/kernel/osrelease", release + "\n");
        file("proc/sys/kernel/version", version + "\n");
        file("proc/sys/kernel/sched_rt_runtime_us", "950000\n");
        file("proc/cmdline", cmdline + "\n");
    }
    void processors(int count, const std::string& governor)
    {
        const std::string cpus = "sys/devices/system/cpu/";
        file(cpus + "online", count > 1 ? "0-" + std::to_string(count - 1) + "\n" : "0\n");
        file(cpus + "isolated", "\n");
        for (int n = 0; n < count; ++n)
            if (!governor.empty())
                file(cpus + "cpu" + std::to_string(n) + "/cpufreq/scaling_governor", governor + "\n");
    }
    void idle_state(int cpu, int state, const std::string& name, int latency_us, bool disabled = false)
    {
        const std::string folder =
            "sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/cpuidle/state" + std::to_string(state);
        file(folder + "/name", name + "\n");
        file(folder + "/latency", std::to_string(latency_us) + "\n");
        file(folder + "/disable", disabled ? "1\n" : "0\n");
    }
    void latency_limit(std::int32_t us)
    {
        file("dev/cpu_dma_latency", std::string(reinterpret_cast<const char*>(&us), sizeof us));
    }

    /// One thread, as stat(5) of proc has it: policy 0 ordinary, 1 FIFO, 2 round robin; `flags` 0x200040 =
    /// kernel.
    void thread(const std::string& folder, int id, const std::string& name, unsigned flags, int priority,
                int policy, const std::string& cpus = "0-3", int major_faults = 0)
    {
        const std::string fields =
            " S 2 0 0 0 -1 " + std::to_string(flags) + " 0 0 " + std::to_string(major_faults) +
            " 0 0 0 0 0 20 0 1 0 5 0 0 18446744073709551615 0 0 0 0 0 0 0 2147483647 0 1 "
            "0 0 17 1 ";
        file(folder + "/stat", std::to_string(id) + " (" + name + ")" + fields + std::to_string(priority) +
                                   " " + std::to_string(policy) + " 0 0 0 0 0 0 0 0 0 0 0\n");
        file(folder + "/status",
             "Name:\t" + name + "\nVmLck:\t       0 kB\nCpus_allowed_list:\t" + cpus + "\n");
    }
    void kernel_thread(int pid, const std::string& name, int priority = 0, int policy = 0)
    {
        thread("proc/" + std::to_string(pid), pid, name, 0x200040, priority, policy);
    }
    /// A process of one thread or of several, the first of which is its leader.
    void program_thread(int pid, int tid, const std::string& name, int priority, int policy,
                        const std::string& cpus = "0-3", int major_faults = 0)
    {
        const std::string process = "proc/" + std::to_string(pid);
        thread(process + "/task/" + std::to_string(tid), tid, name, 0x400000, priority, policy, cpus,
               major_faults);
        if (pid == tid) thread(process, pid, name, 0x400000, priority, policy, cpus, major_faults);
    }

    struct Uart {
        std::string tty;    ///< "ttyS1"
        std::string device; ///< below sys/devices
        std::string driver; ///< "platform/drivers/omap8250", below sys/bus
        int type;
        long clock;
        int fifo;
        int irq;
        int trigger = 0; ///< 0 = the driver has no such file
    };
    void uart(const Uart& uart)
    {
        const std::string device = "sys/devices/" + uart.device, tty = device + "/tty/" + uart.tty;
        file("dev/" + uart.tty, "");
        file(device + "/uevent", "");
        link(device + "/driver", "sys/bus/" + uart.driver);
        link(tty + "/device", device);
        link("sys/class/tty/" + uart.tty, tty);
        file(tty + "/type", std::to_string(uart.type) + "\n");
        file(tty + "/uartclk", std::to_string(uart.clock) + "\n");
        file(tty + "/xmit_fifo_size", std::to_string(uart.fifo) + "\n");
        file(tty + "/irq", std::to_string(uart.irq) + "\n");
        if (uart.trigger > 0) file(tty + "/rx_trig_bytes", std::to_string(uart.trigger) + "\n");
    }

private:
    std::filesystem::path root_;
};

/// An industrial PC with Debian's stock kernel: 16550A at 1.8432 MHz (115200 bit/s at most), trigger 8.
inline void stock_pc(MachineTree& tree)
{
    tree.kernel("6.1.0-56-amd64", "#1 SMP PREEMPT_DYNAMIC Debian 6.1.192-2 (2026-10-02)");
    tree.processors(4, "powersave");
    tree.idle_state(0, 0, "POLL", 0);
    tree.idle_state(0, 1, "C1", 2);
    tree.idle_state(0, 2, "C6", 133);
    tree.latency_limit(2'000'000'000);
    tree.uart({"ttyS1", "pnp0/00:05", "pnp/drivers/serial", 4, 1'843'200, 16, 3, 8});
    tree.kernel_thread(2, "kthreadd");
    tree.kernel_thread(71, "kworker/u8:1-events_unbound");
    tree.kernel_thread(72, "kworker/0:1-events");
}

/// Raspberry Pi 4 with a PREEMPT_RT kernel: PL011 at 48 MHz, tuned, the interrupt's thread above the bus
/// thread.
inline void tuned_pi(MachineTree& tree)
{
    tree.kernel("6.1.0-56-rt-arm64", "#1 SMP PREEMPT_RT Debian 6.1.176-1 (2026-08-11)", "isolcpus=3");
    tree.file("sys/kernel/realtime", "1\n");
    tree.processors(4, "performance");
    tree.file("sys/devices/system/cpu/isolated", "3\n");
    tree.uart({"ttyAMA0", "platform/soc/fe201000.serial", "amba/drivers/uart-pl011", 32, 48'000'000, 32, 30});
    tree.kernel_thread(80, "irq/30-uart-pl0", 85, 1);
    tree.kernel_thread(81, "irq/31-mmc0", 50, 1);
    tree.kernel_thread(71, "kworker/u8:1-events_unbound", 60, 1);
}

/// BeagleBone Black with a PREEMPT_RT kernel: 8250_omap at 48 MHz, FIFO 64, trigger 48, one processor.
inline void beaglebone(MachineTree& tree)
{
    tree.kernel("5.10.168-ti-rt-r76", "#1bookworm SMP PREEMPT_RT Fri Oct 2 2026");
    tree.processors(1, "ondemand");
    tree.uart(
        {"ttyS4", "platform/ocp/481a8000.serial", "platform/drivers/omap8250", 1, 48'000'000, 64, 45, 48});
    tree.file("sys/devices/platform/ocp/481a8000.serial/of_node/dma-names", std::string("tx\0rx\0", 6));
    tree.kernel_thread(80, "irq/45-481a8000", 50, 1);
}

/// FT232R adapter with the latency timer as the driver leaves it, on a stock kernel.
inline void ftdi_adapter(MachineTree& tree)
{
    tree.kernel("6.1.0-56-amd64", "#1 SMP PREEMPT_DYNAMIC Debian 6.1.192-2 (2026-10-02)");
    tree.processors(4, "performance");
    const std::string device = "sys/devices/pci0000:00/0000:00:14.0/usb1/1-2/1-2:1.0/ttyUSB0";
    tree.file("dev/ttyUSB0", "");
    tree.file(device + "/uevent", "");
    tree.file(device + "/latency_timer", "16\n");
    tree.link(device + "/driver", "sys/bus/usb-serial/drivers/ftdi_sio");
    tree.link(device + "/tty/ttyUSB0/device", device);
    tree.link("sys/class/tty/ttyUSB0", device + "/tty/ttyUSB0");
    tree.link("dev/serial/by-id", "dev/serial/by-path");
    std::filesystem::create_symlink("../../ttyUSB0", tree.root() / "dev/serial/by-path/usb-FTDI_FT232R");
}

/// Raspberry Pi with the mini-UART (no parity) as its serial port.
inline void mini_uart(MachineTree& tree)
{
    tree.kernel("6.1.0-56-rt-arm64", "#1 SMP PREEMPT_RT Debian 6.1.176-1 (2026-08-11)");
    tree.processors(4, "performance");
    tree.uart({"ttyS0", "platform/soc/fe215040.serial", "platform/drivers/bcm2835-aux-uart", 3, 500'000'000,
               8, 29, 1});
}

/// A virtual machine with a pty, the way the daemon is tried.
inline void virtual_machine(MachineTree& tree)
{
    tree.kernel("6.1.0-56-amd64", "#1 SMP PREEMPT_DYNAMIC Debian 6.1.192-2 (2026-10-02)");
    tree.processors(2, "");
    tree.file("proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu vme hypervisor lahf_lm\n");
    tree.file("dev/pts/3", "");
}

} // namespace dpslave::test
