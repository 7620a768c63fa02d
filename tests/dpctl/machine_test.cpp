// SPDX-License-Identifier: Apache-2.0
// Facts of a machine, read from trees that are written as kernels show them.
#include "dpctl/tune/machine.hpp"
#include "machine_tree.hpp"

#include <gmock/gmock.h>

namespace dpslave::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class Machine : public testing::Test {
protected:
    MachineFacts machine() const { return read_machine(tree.root()); }
    PortFacts port(const std::string& path) const { return read_port(tree.root(), path); }
    test::MachineTree tree;
};

// ---------------------------------------------------------------- kernel and processors

TEST_F(Machine, ReadsAStockKernel)
{
    test::stock_pc(tree);
    const MachineFacts facts = machine();

    EXPECT_EQ(facts.release, "6.1.0-56-amd64");
    EXPECT_FALSE(facts.preempt_rt);
    EXPECT_FALSE(facts.threaded_irqs);
    EXPECT_EQ(facts.rt_runtime_us, 950000);
    EXPECT_EQ(facts.processors, 4);
    EXPECT_EQ(facts.isolated, "");
    EXPECT_FALSE(facts.virtual_machine);
}

TEST_F(Machine, RecognisesPreemptRtByTheVersionAndByTheKernelsOwnFile)
{
    tree.kernel("5.10", "#1 SMP PREEMPT_RT Debian");
    EXPECT_TRUE(machine().preempt_rt);
    EXPECT_TRUE(machine().threaded_irqs);
    tree.kernel("4.19", "#1 SMP PREEMPT RT Debian");
    EXPECT_TRUE(machine().preempt_rt);
    tree.kernel("6.12", "#1 SMP PREEMPT_DYNAMIC Debian");
    EXPECT_FALSE(machine().preempt_rt);
    tree.file("sys/kernel/realtime", "1\n");
    EXPECT_TRUE(machine().preempt_rt);
}

TEST_F(Machine, RecognisesThreadedInterruptsOfAStockKernelByItsCommandLine)
{
    tree.kernel("6.1", "#1 SMP PREEMPT_DYNAMIC", "root=/dev/sda1 threadirqs quiet");
    EXPECT_TRUE(machine().threaded_irqs);
    tree.kernel("6.1", "#1 SMP PREEMPT_DYNAMIC", "root=/dev/sda1 nothreadirqs=1 threadirqs_off");
    EXPECT_FALSE(machine().threaded_irqs);
}

TEST_F(Machine, NamesEachGovernorOnce)
{
    tree.processors(4, "powersave");
    tree.file("sys/devices/system/cpu/cpu2/cpufreq/scaling_governor", "performance\n");

    EXPECT_THAT(machine().governors, ElementsAre("performance", "powersave"));
}

TEST_F(Machine, CountsTheProcessorsThatAreOnline)
{
    tree.file("sys/devices/system/cpu/online", "0,2-4,7\n");

    EXPECT_EQ(machine().processors, 5);
}

TEST_F(Machine, FindsTheIdleStateThatTakesLongestToLeaveAndLeavesOutDisabledOnes)
{
    test::stock_pc(tree);
    EXPECT_EQ(machine().deepest_idle, "C6");
    EXPECT_EQ(machine().idle_exit_us, 133);

    tree.idle_state(0, 2, "C6", 133, true);
    EXPECT_EQ(machine().deepest_idle, "C1");
    EXPECT_EQ(machine().idle_exit_us, 2);
}

TEST_F(Machine, ReportsTheLatencyLimitOnlyWhereAProcessHoldsOne)
{
    EXPECT_EQ(machine().latency_limit_us, std::nullopt); // no such file, or no right to it
    tree.latency_limit(2'000'000'000);
    EXPECT_EQ(machine().latency_limit_us, std::nullopt);
    tree.latency_limit(0);
    EXPECT_EQ(machine().latency_limit_us, 0);
}

TEST_F(Machine, RecognisesAVirtualMachine)
{
    test::virtual_machine(tree);
    EXPECT_TRUE(machine().virtual_machine);
    tree.file("proc/cpuinfo", "flags\t\t: fpu vme hypervisors\n");
    EXPECT_FALSE(machine().virtual_machine);
    tree.file("proc/device-tree/compatible", std::string("linux,dummy-virt\0", 17));
    EXPECT_TRUE(machine().virtual_machine);
}

TEST_F(Machine, FindsRealTimeThreadsOfProgramsAndTheKernelsUnboundWorkers)
{
    test::stock_pc(tree);
    tree.kernel_thread(18, "migration/0", 99, 1); // the kernel's own: no rival
    tree.program_thread(300, 300, "multipathd", 99, 2);
    tree.program_thread(400, 400, "dpslaved", 0, 0);
    tree.program_thread(400, 401, "bus", 80, 1, "3");
    const MachineFacts facts = machine();

    ASSERT_THAT(facts.realtime_threads, SizeIs(2));
    EXPECT_EQ(facts.realtime_threads[0].name, "multipathd");
    EXPECT_EQ(facts.realtime_threads[0].policy, Policy::round_robin);
    EXPECT_EQ(facts.realtime_threads[1].name, "bus");
    EXPECT_EQ(facts.realtime_threads[1].priority, 80);
    EXPECT_EQ(facts.realtime_threads[1].cpus, "3");
    ASSERT_THAT(facts.unbound_workers, SizeIs(1));
    EXPECT_EQ(facts.unbound_workers[0].id, 71);
    EXPECT_EQ(facts.unbound_workers[0].policy, Policy::ordinary);
}

TEST_F(Machine, ReadsAThreadWhoseNameHasBracketsAndBlanks)
{
    tree.program_thread(300, 300, "a) S 1 (b", 7, 1);

    ASSERT_THAT(machine().realtime_threads, SizeIs(1));
    EXPECT_EQ(machine().realtime_threads[0].name, "a) S 1 (b");
    EXPECT_EQ(machine().realtime_threads[0].priority, 7);
}

TEST_F(Machine, FindsNothingInAnEmptyTree)
{
    const MachineFacts facts = machine();

    EXPECT_EQ(facts.release, "");
    EXPECT_EQ(facts.processors, 0);
    EXPECT_EQ(facts.idle_exit_us, std::nullopt);
    EXPECT_THAT(facts.governors, IsEmpty());
    EXPECT_FALSE(port("/dev/ttyS1").there);
    EXPECT_FALSE(read_process(tree.root(), 1));
}

TEST_F(Machine, TruncatedStatIsNoThread)
{
    tree.file("proc/9/stat", "9 (x) S 2 0\n");
    tree.file("proc/10/stat", "");

    EXPECT_THAT(machine().unbound_workers, IsEmpty());
}

// ---------------------------------------------------------------- ports

TEST_F(Machine, Reads16550OfAPc)
{
    test::stock_pc(tree);
    const PortFacts facts = port("/dev/ttyS1");

    EXPECT_TRUE(facts.there);
    EXPECT_TRUE(facts.serial);
    EXPECT_FALSE(facts.usb);
    EXPECT_EQ(facts.driver, "serial");
    EXPECT_EQ(facts.type, 4);
    EXPECT_EQ(facts.uart_clock, 1'843'200u);
    EXPECT_EQ(facts.fifo, 16);
    EXPECT_EQ(facts.trigger, 8);
    EXPECT_TRUE(facts.trigger_settable);
    EXPECT_EQ(facts.irq, 3);
    EXPECT_FALSE(facts.irq_thread);
}

TEST_F(Machine, LooksThroughTheSerialBaseBusOfNewKernels)
{
    test::stock_pc(tree);
    std::filesystem::remove_all(tree.root() / "sys/class");
    tree.uart({"ttyS1", "pnp0/00:05/00:05:0/00:05:0.0", "serial-base/drivers/port", 4, 1'843'200, 16, 3, 8});
    tree.file("sys/devices/pnp0/00:05/00:05:0/uevent", "");
    tree.link("sys/devices/pnp0/00:05/00:05:0/driver", "sys/bus/serial-base/drivers/ctrl");

    EXPECT_EQ(port("/dev/ttyS1").driver, "serial");
    EXPECT_EQ(port("/dev/ttyS1").device, "/sys/devices/pnp0/00:05");
}

TEST_F(Machine, ReadsPl011AndTheThreadOfItsInterrupt)
{
    test::tuned_pi(tree);
    const PortFacts facts = port("/dev/ttyAMA0");

    EXPECT_EQ(facts.driver, "uart-pl011");
    EXPECT_EQ(facts.uart_clock, 48'000'000u);
    EXPECT_FALSE(facts.trigger);
    EXPECT_FALSE(facts.trigger_settable);
    EXPECT_FALSE(facts.dma);
    ASSERT_TRUE(facts.irq_thread);
    EXPECT_EQ(facts.irq_thread->id, 80);
    EXPECT_EQ(facts.irq_thread->priority, 85);
}

TEST_F(Machine, ReportsTheSlowestThreadOfASharedInterrupt)
{
    test::tuned_pi(tree);
    tree.kernel_thread(82, "irq/30-other", 50, 1);
    tree.kernel_thread(83, "irq/300-third", 1, 1);

    EXPECT_EQ(port("/dev/ttyAMA0").irq_thread->id, 82);
}

TEST_F(Machine, SeesTheDmaChannelOfAReceiver)
{
    test::beaglebone(tree);
    EXPECT_EQ(port("/dev/ttyS4").driver, "omap8250");
    EXPECT_TRUE(port("/dev/ttyS4").dma);
}

TEST_F(Machine, AReadOnlyTriggerIsNotSettable)
{
    test::stock_pc(tree);
    tree.file("sys/devices/pnp0/00:05/tty/ttyS1/rx_trig_bytes", "8\n", 0444);

    EXPECT_EQ(port("/dev/ttyS1").trigger, 8);
    EXPECT_FALSE(port("/dev/ttyS1").trigger_settable);
}

TEST_F(Machine, FollowsTheNamesOfUdevToAUsbAdapter)
{
    test::ftdi_adapter(tree);
    const PortFacts facts = port("/dev/serial/by-path/usb-FTDI_FT232R");

    EXPECT_EQ(facts.name, "ttyUSB0");
    EXPECT_TRUE(facts.usb);
    EXPECT_EQ(facts.driver, "ftdi_sio");
    EXPECT_EQ(facts.latency_timer_ms, 16);
}

TEST_F(Machine, RecognisesAPtyAndWhatIsNoSerialPort)
{
    test::virtual_machine(tree);
    tree.file("dev/null", "");

    EXPECT_TRUE(port("/dev/pts/3").pty);
    EXPECT_FALSE(port("/dev/pts/3").serial);
    EXPECT_TRUE(port("/dev/null").there);
    EXPECT_FALSE(port("/dev/null").serial);
}

// ---------------------------------------------------------------- a process

TEST_F(Machine, ReadsTheThreadsAndTheLockedMemoryOfAProcess)
{
    tree.program_thread(400, 400, "dpslaved", 0, 0);
    tree.program_thread(400, 401, "bus", 80, 1, "3", 2);
    tree.file("proc/400/status", "Name:\tdpslaved\nVmLck:\t   48212 kB\n");

    const auto facts = read_process(tree.root(), 400);
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->locked_kib, 48212u);
    ASSERT_THAT(facts->threads, SizeIs(2));
    EXPECT_EQ(facts->threads[1].name, "bus");
    EXPECT_EQ(facts->threads[1].policy, Policy::fifo);
    EXPECT_EQ(facts->threads[1].major_faults, 2u);
}

} // namespace
} // namespace dpslave::io
