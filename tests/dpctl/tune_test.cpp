// SPDX-License-Identifier: Apache-2.0
// Tests what dpctl tune says of machines: each number is that of the wire reference, 11.2, 11.5 and 11.6, and
// each verdict was worked out by hand from those.
#include "control/lines.hpp"
#include "dpctl/tune/tune.hpp"
#include "dpctl/tune/tune_uart.hpp"
#include "dpctl_bench.hpp"
#include "gsd/second_hand.hpp"
#include "machine_tree.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

namespace dpslave::dpctl {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using enum Verdict;

// ---------------------------------------------------------------- the tables of the wire reference

// Where a divisor lies in the middle (312.5 at 48 MHz, 12.5 at 100 MHz) the 8250 driver takes the greater
// one: DIV_ROUND_CLOSEST of linux/math.h. The table has the smaller one there, as far off on the other side.
constexpr double kFar = 99; ///< a dash in the table: more than 5 %

struct Divisor {
    const char* name;
    std::uint32_t clock;
    std::array<double, 7> percent;
};
class TuneDivisor : public testing::TestWithParam<Divisor> {};

TEST_P(TuneDivisor, MakesTheRateThatTheTableSays)
{
    for (const Baud baud : kBauds) {
        const double expected = GetParam().percent[index_of(baud)];
        const double found = divisor_error(GetParam().clock, baud);
        if (expected == kFar)
            EXPECT_GT(std::abs(found), 5) << text(baud);
        else
            EXPECT_NEAR(found, expected, 0.005001) << text(baud);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Wire11_2, TuneDivisor,
    testing::Values(Divisor{"PcCom", 1'843'200, {0.00, 0.00, kFar, kFar, kFar, kFar, kFar}},
                    Divisor{"MHz7_3728", 7'372'800, {0.00, 0.00, 1.39, -1.70, kFar, kFar, kFar}},
                    Divisor{"MHz14_7456", 14'745'600, {0.00, 0.00, 1.39, -1.70, -1.70, kFar, kFar}},
                    Divisor{"MHz24", 24'000'000, {0.16, 0.16, 0.01, 0.00, 0.00, 0.00, 0.00}},
                    Divisor{"MHz25", 25'000'000, {-0.15, 0.47, 1.11, -1.96, 4.17, 4.17, 4.17}},
                    Divisor{"MHz48", 48'000'000, {-0.16, 0.16, 0.01, 0.00, 0.00, 0.00, 0.00}},
                    Divisor{"MHz50", 50'000'000, {-0.15, -0.15, -0.35, 1.01, -1.96, 4.17, 4.17}},
                    Divisor{"MHz80", 80'000'000, {-0.03, 0.16, 0.01, 0.63, -1.23, 0.00, kFar}},
                    Divisor{"MHz100", 100'000'000, {0.01, -0.15, -0.35, -0.50, 1.01, -3.85, 4.17}}),
    [](const auto& row) { return row.param.name; });

struct Budget {
    const char* name;
    std::uint32_t software_us;
    std::uint32_t timeout; ///< T_bit; 0 = trigger 1, or none
    std::array<std::uint32_t, 7> needed;
};
class TuneBudget : public testing::TestWithParam<Budget> {};

TEST_P(TuneBudget, NeedsTheMaxTsdrThatTheTableSays)
{
    for (const Baud baud : kBauds)
        EXPECT_EQ(needed_tsdr(GetParam().timeout, GetParam().software_us, baud),
                  GetParam().needed[index_of(baud)])
            << text(baud);
}

INSTANTIATE_TEST_SUITE_P(Wire11_6, TuneBudget,
                         testing::Values(Budget{"Us300Trigger1", 300, 0, {14, 17, 25, 40, 68, 161, 461}},
                                         Budget{"Us300After32", 300, 32, {35, 38, 46, 61, 89, 182, 482}},
                                         Budget{"Us300After44", 300, 44, {47, 50, 58, 73, 101, 194, 494}},
                                         Budget{"Us1000After44", 1000, 44, {54, 64, 90, 138, 232, 544, 1544}},
                                         Budget{
                                             "Us2500After44", 2500, 44, {68, 92, 158, 279, 513, 1294, 3794}},
                                         Budget{"Us4000Usb", 4000, 0, {50, 88, 193, 386, 761, 2011, 6011}}),
                         [](const auto& row) { return row.param.name; });

TEST(TuneDefaults, AreTheClassDefaultsOfTheGsd)
{
    EXPECT_THAT(kDefaultMaxTsdr, ElementsAre(60, 60, 60, 60, 60, 100, 150));
    EXPECT_EQ(kCeiling, 1000u);
}

// ---------------------------------------------------------------- machines

class Tune : public testing::Test {
protected:
    void on(void (*machine)(test::MachineTree&), const std::string& port)
    {
        machine(tree);
        port_ = port;
    }
    /// A daemon that serves the port, its bus thread as configured by default, with a clean record.
    void serves(Baud baud)
    {
        BusFacts bus;
        bus.pid = 400;
        bus.baud = baud;
        bus.promised.fill(60);
        bus.thread = io::ThreadFacts{401, "bus", io::Policy::fifo, 80, "3", 0, false};
        bus.locked_kib = 48212;
        bus_ = bus;
    }
    TuneFacts facts() const
    {
        return {io::read_machine(tree.root()), io::read_port(tree.root(), port_), users_, bus_};
    }
    std::vector<RateJudgment> rates() const { return judge_rates(facts()); }
    std::vector<Verdict> verdicts() const
    {
        std::vector<Verdict> out;
        for (const RateJudgment& one : rates()) out.push_back(one.verdict);
        return out;
    }
    std::vector<std::uint32_t> needs() const
    {
        std::vector<std::uint32_t> out;
        for (const RateJudgment& one : rates()) out.push_back(one.needed);
        return out;
    }
    std::string reason(Baud baud) const { return rates()[index_of(baud)].reason; }
    std::vector<TuneFinding> findings() const { return tune_findings(facts(), rates()); }
    std::vector<std::string> names() const
    {
        std::vector<std::string> out;
        for (const TuneFinding& one : findings()) out.push_back(one.name);
        return out;
    }
    TuneFinding finding(const std::string& name) const
    {
        for (const TuneFinding& one : findings())
            if (one.name == name) return one;
        ADD_FAILURE() << "no finding " << name;
        return {};
    }

    test::MachineTree tree;
    std::string port_;
    io::PortUsers users_{};
    std::optional<BusFacts> bus_;
};

TEST_F(Tune, NamesWhoElseHasThePortAndSaysWhereItMayNotLook)
{
    on(test::stock_pc, "/dev/ttyS1");
    users_ = {.port = "/dev/ttyS1", .users = {{812, "agetty"}}, .is_console = true, .hidden = 9};
    EXPECT_EQ(shared_port(users_)->severity, Severity::mend);
    EXPECT_EQ(shared_port(users_)->what,
              "/dev/ttyS1 is used by others: process 812 (agetty), and it is the console of the kernel");
    const auto all = tune_findings(facts(), rates());
    EXPECT_TRUE(std::ranges::any_of(all, [](const auto& one) { return one.name == "port.shared"; }));

    users_ = {.port = "/dev/ttyS1", .users = {}, .hidden = 9};
    EXPECT_EQ(shared_port(users_)->severity, Severity::know);
    EXPECT_THAT(shared_port(users_)->what,
                HasSubstr("the files of 9 processes of other users cannot be seen"));

    users_ = {.port = "/dev/ttyS1", .users = {}};
    EXPECT_FALSE(shared_port(users_));
}

// 16550A, trigger 8, stock kernel: 44 T_bit and 2500 us; its clock makes 115200 and fractions.
TEST_F(Tune, AStockPcHoldsTheTwoRatesThatItsClockMakes)
{
    on(test::stock_pc, "/dev/ttyS1");

    EXPECT_THAT(verdicts(), ElementsAre(holds, holds, cannot, cannot, cannot, cannot, cannot));
    EXPECT_THAT(needs(), ElementsAre(68, 92, 0, 0, 0, 0, 0));
    EXPECT_EQ(reason(Baud::k9_6), "with max_tsdr = 68");
    EXPECT_EQ(reason(Baud::k93_75), "UART makes 115200 (+22.88 %)");
    EXPECT_EQ(reason(Baud::k187_5), "UART makes 115200 (-38.56 %)");
}

// The same with a clock of 24 MHz: "fine up to 187.5k and out of range at 500k" (wire reference 11.6,
// "Reading"); with the 1000 us that a stock kernel has at its best 500k would need 544, which is below the
// ceiling.
TEST_F(Tune, AStockKernelHoldsUpTo187_5AndIsOutOfRangeAbove)
{
    on(test::stock_pc, "/dev/ttyS1");
    tree.file("sys/devices/pnp0/00:05/tty/ttyS1/uartclk", "24000000\n");

    EXPECT_THAT(verdicts(), ElementsAre(holds, holds, holds, holds, holds, doubtful, cannot));
    EXPECT_THAT(needs(), ElementsAre(68, 92, 158, 279, 513, 1294, 3794));
    EXPECT_EQ(reason(Baud::k500), "needs 544 to 1294, masters wait 1000: measure it");
    EXPECT_EQ(reason(Baud::k1500), "needs 1544 to 3794, masters wait 1000");
}

TEST_F(Tune, ReceiveTrigger1Saves33BitTimes)
{
    on(test::stock_pc, "/dev/ttyS1");
    tree.file("sys/devices/pnp0/00:05/tty/ttyS1/uartclk", "24000000\n");
    tree.file("sys/devices/pnp0/00:05/tty/ttyS1/rx_trig_bytes", "1\n");

    EXPECT_EQ(needs()[index_of(Baud::k9_6)], 68u - 33);
    EXPECT_EQ(reason(Baud::k9_6), "as promised");
    EXPECT_THAT(names(), Not(Contains("uart.trigger")));
}

// PL011 on PREEMPT_RT, tuned: 32 T_bit and 300 us, every rate exact.
TEST_F(Tune, ATunedPiHoldsEveryRateWithTheFiguresOfTheTable)
{
    on(test::tuned_pi, "/dev/ttyAMA0");

    EXPECT_THAT(verdicts(), Each(holds));
    EXPECT_THAT(needs(), ElementsAre(35, 38, 46, 61, 89, 182, 482));
    EXPECT_EQ(reason(Baud::k45_45), "as promised");
    EXPECT_EQ(reason(Baud::k93_75), "with max_tsdr = 61");
    for (const RateJudgment& one : rates())
        EXPECT_LE(std::abs(one.error_percent.value()), 0.011) << text(one.baud);
    for (const TuneFinding& one : findings()) EXPECT_EQ(one.severity, Severity::know) << one.name;
}

TEST_F(Tune, APreemptRtKernelThatIsNotTunedMayNeedWhatAStockKernelHasAtItsBest)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    tree.processors(4, "ondemand");

    EXPECT_EQ(needs()[index_of(Baud::k187_5)], 32u + 188); // 1000 us are 187.5 bits
    EXPECT_EQ(reason(Baud::k1500), "needs 482 to 1532, masters wait 1000: measure it");
}

TEST_F(Tune, ADeepIdleStateIsHarmlessWhileAProcessHoldsTheLatency)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    tree.idle_state(0, 1, "C6", 133);
    EXPECT_FALSE(is_tuned(facts()));
    EXPECT_THAT(names(), Contains("cpu.idle"));

    tree.latency_limit(0);
    EXPECT_TRUE(is_tuned(facts()));
    EXPECT_THAT(names(), Not(Contains("cpu.idle")));
}

// 8250_omap at 48 MHz: 44 T_bit; ondemand and one processor: 1000 us.
TEST_F(Tune, ABeagleBoneIsDoubtfulWhileItsReceiverHasDma)
{
    on(test::beaglebone, "/dev/ttyS4");

    EXPECT_THAT(verdicts(), Each(doubtful));
    EXPECT_THAT(needs(), ElementsAre(54, 64, 90, 138, 232, 544, 1544));
    EXPECT_THAT(names(), AllOf(Contains("uart.dma"), Contains("uart.trigger"), Contains("cpu.single")));
}

TEST_F(Tune, ATunedBeagleBoneWithTrigger1HoldsWhatTheTableSays)
{
    on(test::beaglebone, "/dev/ttyS4");
    tree.processors(1, "performance");
    std::filesystem::remove_all(tree.root() / "sys/devices/platform/ocp/481a8000.serial/of_node");
    tree.file("sys/devices/platform/ocp/481a8000.serial/tty/ttyS4/rx_trig_bytes", "1\n");

    EXPECT_THAT(verdicts(), Each(holds));
    EXPECT_THAT(needs(), ElementsAre(14, 17, 25, 40, 68, 161, 461));
}

// FT232R: 4000 us, and 15 ms more while its timer is at 16.
TEST_F(Tune, AnFtdiAdapterIsNeverMoreThanDoubtful)
{
    on(test::ftdi_adapter, "/dev/ttyUSB0");

    EXPECT_THAT(verdicts(), ElementsAre(doubtful, doubtful, doubtful, cannot, cannot, cannot, cannot));
    EXPECT_EQ(needs()[0], 11u + 183); // 19000 us are 182.4 bits
    EXPECT_THAT(finding("usb.latency_timer").steps.front(),
                HasSubstr("echo 1 > /sys/class/tty/ttyUSB0/device/latency_timer"));
    EXPECT_THAT(finding("usb.latency_timer").cost, HasSubstr("15000 us"));
}

TEST_F(Tune, AnFtdiAdapterWithItsTimerAt1NeedsWhatTheTableSays)
{
    on(test::ftdi_adapter, "/dev/ttyUSB0");
    tree.file("sys/devices/pci0000:00/0000:00:14.0/usb1/1-2/1-2:1.0/ttyUSB0/latency_timer", "1\n");

    EXPECT_THAT(verdicts(), ElementsAre(doubtful, doubtful, doubtful, doubtful, doubtful, cannot, cannot));
    EXPECT_THAT(needs(), ElementsAre(50, 88, 193, 386, 761, 2011, 6011));
    EXPECT_THAT(names(), Not(Contains("usb.latency_timer")));
}

TEST_F(Tune, AUartWithoutParityCannotServeAnyRate)
{
    on(test::mini_uart, "/dev/ttyS0");

    EXPECT_THAT(verdicts(), Each(cannot));
    EXPECT_EQ(reason(Baud::k9_6), "no parity, and PROFIBUS is 8E1");
    EXPECT_EQ(finding("port.no_rate").severity, Severity::mend);
    EXPECT_THAT(finding("port.no_rate").steps.front(), HasSubstr("/dev/ttyAMA0"));
}

TEST_F(Tune, APtyIsForTryingOnlyAndNothingIsToBeMended)
{
    on(test::virtual_machine, "/dev/pts/3");

    EXPECT_THAT(verdicts(), ElementsAre(doubtful, doubtful, doubtful, doubtful, doubtful, doubtful, cannot));
    EXPECT_EQ(reason(Baud::k9_6), "a pty is not a real line: for tests only");
    EXPECT_THAT(names(), ElementsAre("kernel.virtual"));

    serves(Baud::k187_5);
    for (const TuneFinding& one : findings()) EXPECT_NE(one.severity, Severity::mend) << one.name;
}

TEST_F(Tune, APortThatIsNotThereCannot)
{
    on(test::virtual_machine, "/dev/ttyS9");
    EXPECT_THAT(verdicts(), Each(cannot));
    EXPECT_THAT(finding("port.no_rate").what, HasSubstr("no such port"));

    tree.file("dev/null", "");
    port_ = "/dev/null";
    EXPECT_THAT(finding("port.no_rate").what, HasSubstr("no serial port"));
}

TEST_F(Tune, ARateWhoseErrorIsBeyondTheStandardButNotBeyondUseIsDoubtful)
{
    on(test::tuned_pi, "/dev/ttyS1");
    tree.uart({"ttyS1", "platform/uart", "platform/drivers/dw-apb-uart", 4, 100'000'000, 64, 5, 1});

    EXPECT_EQ(rates()[index_of(Baud::k45_45)].verdict, doubtful); // -0.35 %
    EXPECT_THAT(reason(Baud::k45_45), HasSubstr("(-0.35 %), 0.3 % is allowed"));
    EXPECT_EQ(rates()[index_of(Baud::k187_5)].verdict, cannot); // +1.01 %
}

TEST_F(Tune, NamesTheInterruptsOfTrigger1AndTheGapsOfASmallFifo)
{
    on(test::tuned_pi, "/dev/ttyS1");
    tree.uart({"ttyS1", "platform/uart", "platform/drivers/dw-apb-uart", 4, 24'000'000, 16, 5, 1});

    EXPECT_EQ(reason(Baud::k500),
              "gaps in replies of more than 16 octets, unless the FIFO is refilled within 22 us");
    EXPECT_EQ(reason(Baud::k1500), "136363 interrupts a second: too many for most boards");
    EXPECT_EQ(rates()[index_of(Baud::k187_5)].verdict, holds);
}

TEST_F(Tune, AUartWithAnUnknownClockIsDoubtful)
{
    on(test::stock_pc, "/dev/ttyS1");
    tree.file("sys/devices/pnp0/00:05/tty/ttyS1/uartclk", "");

    EXPECT_EQ(rates()[0].verdict, doubtful);
    EXPECT_EQ(reason(Baud::k9_6), "clock of the UART not known: try as root");
}

// ---------------------------------------------------------------- what was measured

TEST_F(Tune, TheRateOfTheBusMustNotNeedMoreThanIsPromised)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k187_5);

    const TuneFinding found = finding("rate.max_tsdr");
    EXPECT_EQ(found.severity, Severity::mend);
    EXPECT_EQ(found.what,
              "At 187.5 kbit/s this machine may need 89 bit times to begin a reply, and 60 are promised");
    EXPECT_THAT(found.steps[0], HasSubstr("max_tsdr = 89"));
    EXPECT_THAT(found.steps[1], HasSubstr("dpctl gsd make --max-tsdr 89"));

    bus_->promised[index_of(Baud::k187_5)] = 89;
    EXPECT_THAT(names(), Not(Contains("rate.max_tsdr")));
}

TEST_F(Tune, ACleanRecordBeatsTheEstimate)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k187_5);
    bus_->traffic.replies = 2000;

    EXPECT_EQ(reason(Baud::k187_5), "measured: 2000 replies, none late, none repeated");
    EXPECT_EQ(rates()[index_of(Baud::k187_5)].needed, 60u);
    EXPECT_THAT(names(), Not(Contains("rate.max_tsdr")));

    bus_->traffic.replies = 1999; // too few for a statement
    EXPECT_EQ(reason(Baud::k187_5), "with max_tsdr = 89");
}

TEST_F(Tune, ABadRecordBeatsTheEstimateToo)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k93_75);
    bus_->traffic.replies = 9990;
    bus_->traffic.too_late = 5;
    bus_->traffic.overtaken = 3;
    bus_->traffic.repeated = 2;
    EXPECT_EQ(rates()[index_of(Baud::k93_75)].verdict, holds); // one in a thousand: the master's retry

    bus_->traffic.repeated = 4;
    EXPECT_EQ(rates()[index_of(Baud::k93_75)].verdict, doubtful);
    EXPECT_EQ(reason(Baud::k93_75), "measured: 12 of 10002 replies late or repeated");
    EXPECT_EQ(reason(Baud::k45_45), "as promised"); // another rate: nothing was measured there

    bus_->traffic.too_late = 200;
    EXPECT_EQ(rates()[index_of(Baud::k93_75)].verdict, cannot);
    EXPECT_THAT(finding("rate.cannot").steps.front(), HasSubstr("Set the master to 1.5 Mbit/s"));
}

TEST_F(Tune, AMeasuredTurnaroundThatIsWorseThanPlannedCountsWithHalfOfItOnTop)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k500);
    bus_->traffic.measured = 5000;
    bus_->traffic.highest_us = 822; // 22 us of it are min T_SDR

    EXPECT_EQ(software_part(facts()).low_us, 800u);
    EXPECT_EQ(software_part(facts()).high_us, 1200u);
    EXPECT_EQ(needs()[index_of(Baud::k9_6)], 32u + 12); // 1200 us are 11.5 bits

    bus_->traffic.highest_us = 122; // better than planned proves nothing: the way to the reader is not in it
    EXPECT_EQ(software_part(facts()).low_us, 300u);
    EXPECT_EQ(software_part(facts()).high_us, 300u);
}

// ---------------------------------------------------------------- findings

TEST_F(Tune, NamesWhatAStockPcCouldDoBetterWithACommandEach)
{
    on(test::stock_pc, "/dev/ttyS1");

    EXPECT_THAT(names(), ElementsAre("uart.trigger", "kernel.stock", "cpu.governor", "cpu.idle", "uart.clock",
                                     "cpu.isolated"));
    EXPECT_THAT(finding("uart.trigger").steps[0], HasSubstr("echo 1 > /sys/class/tty/ttyS1/rx_trig_bytes"));
    EXPECT_EQ(finding("uart.trigger").cost, "33 bit times at every rate");
    EXPECT_THAT(finding("kernel.stock").steps[0], HasSubstr("apt install linux-image-rt-amd64"));
    EXPECT_THAT(finding("cpu.governor").steps[0], HasSubstr("cpupower frequency-set -g performance"));
    EXPECT_EQ(finding("cpu.idle").cost, "133 us: 3 bit times at 19.2 kbit/s");
}

TEST_F(Tune, TheInterruptsThreadBelongsAboveTheBusThread)
{
    on(test::beaglebone, "/dev/ttyS4");

    EXPECT_THAT(finding("irq.priority").steps, ElementsAre("chrt -f -p 85 80"));
    tree.kernel_thread(80, "irq/45-481a8000", 80, 1);
    EXPECT_THAT(names(), Contains("irq.priority")) << "beside it is not above it";
    tree.kernel_thread(80, "irq/45-481a8000", 81, 1);
    EXPECT_THAT(names(), Not(Contains("irq.priority")));
}

TEST_F(Tune, TheInterruptsThreadIsNeverSentWhereTheBusThreadIsAlready)
{
    on(test::beaglebone, "/dev/ttyS4");
    serves(Baud::k9_6);

    bus_->thread->priority = 98;
    EXPECT_THAT(finding("irq.priority").steps, ElementsAre("chrt -f -p 99 80"));
}

TEST_F(Tune, ABusThreadAtTheHighestPriorityHasToComeDownForTheInterruptsThread)
{
    on(test::beaglebone, "/dev/ttyS4");
    serves(Baud::k9_6);
    bus_->thread->priority = 99;

    for (const int irq : {50, 99}) {
        tree.kernel_thread(80, "irq/45-481a8000", irq, 1);
        const std::vector<std::string> steps = finding("irq.priority").steps;
        ASSERT_FALSE(steps.empty()) << irq;
        EXPECT_THAT(steps.front(), HasSubstr("priority = 80 under [realtime], and restart dpslaved")) << irq;
        EXPECT_THAT(steps, Each(Not(HasSubstr("chrt")))) << irq;
    }
}

TEST_F(Tune, AnOrdinaryKernelWorkerIsNamedOnPreemptRt)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    EXPECT_THAT(names(), Not(Contains("kworker.priority")));

    tree.kernel_thread(72, "kworker/u8:2-flush", 0, 0);
    EXPECT_THAT(finding("kworker.priority").cost, HasSubstr("15 to 20 ms"));
}

TEST_F(Tune, AnotherProgramWithThePriorityOfTheBusThreadIsARival)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k9_6);
    tree.program_thread(400, 401, "bus", 80, 1, "3");
    EXPECT_THAT(names(), Not(Contains("thread.rival")));

    tree.program_thread(300, 300, "multipathd", 99, 2);
    EXPECT_THAT(finding("thread.rival").what,
                HasSubstr("Thread 300 of another program, 'multipathd', has SCHED_RR 99"));
    EXPECT_FALSE(is_tuned(facts()));
}

TEST_F(Tune, AnIsolatedProcessorIsForTheBusThread)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k9_6);
    EXPECT_THAT(names(), Not(Contains("cpu.not_pinned")));

    bus_->thread->cpus = "0-2";
    EXPECT_THAT(finding("cpu.not_pinned").steps, ElementsAre("cpu = 3 under [realtime]"));
    EXPECT_EQ(finding("cpu.not_pinned").what, "Processor 3 is isolated, but the bus thread runs on 0-2");
}

TEST_F(Tune, ABusThreadIsPinnedWhereverAllItsProcessorsAreIsolated)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k9_6);
    for (const auto& [isolated, cpus] : std::vector<std::pair<const char*, const char*>>{
             {"2-3", "3"}, {"2-3", "2-3"}, {"2-3", "2,3"}, {"1,3", "3"}, {"0-1,3", "0,3"}, {"8-11", "10"}}) {
        tree.file("sys/devices/system/cpu/isolated", std::string{isolated} + "\n");
        bus_->thread->cpus = cpus;
        EXPECT_THAT(names(), Not(Contains("cpu.not_pinned"))) << cpus << " of " << isolated;
    }
}

TEST_F(Tune, ABusThreadThatMayLeaveTheIsolatedProcessorsIsNotPinned)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k9_6);
    for (const auto& [isolated, cpus] : std::vector<std::pair<const char*, const char*>>{
             {"2-3", "1"}, {"2-3", "1-2"}, {"2-3", "0-3"}, {"2,5", "3"}, {"2-3", "13"}}) {
        tree.file("sys/devices/system/cpu/isolated", std::string{isolated} + "\n");
        bus_->thread->cpus = cpus;
        EXPECT_THAT(finding("cpu.not_pinned").steps, ElementsAre("cpu = 2 under [realtime]"))
            << cpus << " of " << isolated;
    }
    EXPECT_EQ(finding("cpu.not_pinned").what, "Processors 2-3 are isolated, but the bus thread runs on 13");
}

TEST_F(Tune, ProcessorsThatAreNotKnownAreNotJudged)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k9_6);
    for (const char* cpus : {"", "x", "3,", "3-", "-3", "3-2", "0-2000000000", "3 4", "99999999999"}) {
        bus_->thread->cpus = cpus;
        EXPECT_THAT(names(), Not(Contains("cpu.not_pinned"))) << cpus;
    }
}

TEST_F(Tune, ADaemonWithoutTheRightToRealTimeIsReportedWithTheSteps)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k9_6);
    bus_->thread = io::ThreadFacts{401, "bus", io::Policy::ordinary, 0, "3", 7, false};
    bus_->locked_kib = 0;

    EXPECT_THAT(finding("daemon.ordinary").steps[0], HasSubstr("LimitRTPRIO=80"));
    EXPECT_THAT(finding("daemon.not_locked").steps[0], HasSubstr("LimitMEMLOCK=infinity"));
    EXPECT_THAT(finding("daemon.page_faults").what, HasSubstr("7 page faults"));
    EXPECT_EQ(software_part(facts()).high_us, 2500u);
}

TEST_F(Tune, AKernelThatGivesRealTimeNoTimeMustBeMended)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    tree.file("proc/sys/kernel/sched_rt_runtime_us", "0\n");

    EXPECT_EQ(finding("kernel.no_realtime").severity, Severity::mend);
}

// ---------------------------------------------------------------- the daemon's replies

TEST(TuneReplies, GiveRatePromiseAndTraffic)
{
    const BusFacts facts =
        bus_facts({.port = "/dev/ttyS1", .baud = 187500, .baud_state = "DP_Control"},
                  report::read<report::GetInfoReply>(
                      Json::parse(R"({"stations": [{"bauds": [9600, 187500], "max_tsdr": [60, 90]},
                                     {"bauds": [9600, 187500], "max_tsdr": [70, 80]}]})")),
                  report::read<report::GetCountersReply>(Json::parse(
                      R"({"groups": [{"name": "unwinder", "counters": [{"name": "late", "value": 77}]},
            {"name": "bus", "counters": [{"name": "replies", "value": 5000}, {"name": "late", "value": 1},
             {"name": "overtaken", "value": 2}, {"name": "retries", "value": 3}, {"name": "page_faults", "value": 4}]}],
            "turnaround": [{"unit": "us", "count": 4990, "p999": 210, "highest": 400},
                           {"unit": "T_bit", "count": 4990, "p999": 40, "highest": 75}]})")));

    EXPECT_EQ(facts.baud, Baud::k187_5);
    EXPECT_EQ(facts.promised[index_of(Baud::k9_6)], 60u);
    EXPECT_EQ(facts.promised[index_of(Baud::k187_5)], 80u);
    EXPECT_EQ(facts.promised[index_of(Baud::k500)], std::nullopt);
    EXPECT_EQ(facts.traffic.replies, 5000u);
    EXPECT_EQ(facts.traffic.too_late, 1u);
    EXPECT_EQ(facts.traffic.overtaken, 2u);
    EXPECT_EQ(facts.traffic.repeated, 3u);
    EXPECT_EQ(facts.traffic.page_faults, 4u);
    EXPECT_EQ(facts.traffic.measured, 4990u);
    EXPECT_EQ(facts.traffic.p999_us, 210u);
    EXPECT_EQ(facts.traffic.highest_us, 400u);
}

TEST(TuneReplies, GiveNoRateWhileItIsSearchedAndNothingOfAForeignAnswer)
{
    EXPECT_EQ(bus_facts({.baud = 9600, .baud_state = "Baud_Search"}, {}, {}).baud, std::nullopt);
    const BusFacts facts =
        bus_facts(report::read<report::Bus>(Json::parse(R"({"baud": 12, "baud_state": 3})")),
                  report::read<report::GetInfoReply>(
                      Json::parse(R"({"stations": [1, {"bauds": ["x"], "max_tsdr": [1]}]})")),
                  report::read<report::GetCountersReply>(
                      Json::parse(R"({"groups": 5, "turnaround": [{"unit": "us", "highest": -1}]})")));
    EXPECT_EQ(facts.baud, std::nullopt);
    EXPECT_EQ(facts.traffic.highest_us, std::nullopt);
}

// ---------------------------------------------------------------- pictures and the program

TEST_F(Tune, PrintsFactsRatesAndWhatIsToDoWithin80Columns)
{
    on(test::tuned_pi, "/dev/ttyAMA0");
    serves(Baud::k93_75);

    const TuneFacts all = facts();
    const std::string picture = render_tune(all, rates(), findings(), false);
    EXPECT_EQ(picture, test::lines(R"(
  kernel      6.1.0-56-rt-arm64, PREEMPT_RT
  processors  4, isolated: 3, governor performance, real time 950 ms of each
              second
  port        /dev/ttyAMA0, PL011, driver uart-pl011, FIFO 32, clock 48 MHz, IRQ
              30 (thread 80: FIFO 85)
  daemon      pid 400, 93.75 kbit/s, bus thread FIFO 80 on 3, memory locked, 0
              replies

          RATE  VERDICT  NEEDS  PROMISED  WHY
    9.6 kbit/s  holds       35        60  as promised
   19.2 kbit/s  holds       38        60  as promised
  45.45 kbit/s  holds       46        60  as promised
> 93.75 kbit/s  holds       61        60  with max_tsdr = 61
  187.5 kbit/s  holds       89        60  with max_tsdr = 89
    500 kbit/s  holds      182        60  with max_tsdr = 182
    1.5 Mbit/s  holds      482        60  with max_tsdr = 482
  NEEDS, PROMISED: MaxTsdr in bit times. More needed than promised: write
  max_tsdr under [bus], and give the master the GSD of dpctl gsd make --max-tsdr

1. At 93.75 kbit/s this machine may need 61 bit times to begin a reply, and
   60 are promised
   costs replies that are not sent, because the master does not wait for them
   - Write max_tsdr = 61 under [bus], and restart dpslaved
   - Give the master the GSD that dpctl gsd make --max-tsdr 61 writes, so that
     it waits as long

note: The UART keeps fewer characters than its trigger until the line was
   idle for 32 bit times
   costs 21 bit times at every rate
   - The driver has no setting for it: the figures above have room for it
)"));
}

TEST_F(Tune, NoLineIsLongerThan80Columns)
{
    const std::vector<std::pair<void (*)(test::MachineTree&), const char*>> machines{
        {test::stock_pc, "/dev/ttyS1"},
        {test::beaglebone, "/dev/ttyS4"},
        {test::ftdi_adapter, "/dev/ttyUSB0"},
        {test::mini_uart, "/dev/ttyS0"}};
    for (const auto& [machine, port] : machines) {
        on(machine, port);
        std::istringstream picture(render_tune(facts(), rates(), findings(), false));
        for (std::string line; std::getline(picture, line);) EXPECT_LE(line.size(), 80u) << line;
    }
}

TEST_F(Tune, PrintsJsonInTheFormThatTheManualPageHas)
{
    on(test::stock_pc, "/dev/ttyS1");
    const Json json = tune_json(facts(), rates(), findings());

    EXPECT_EQ(json["machine"]["preempt_rt"], false);
    EXPECT_EQ(json["port"]["trigger"], 8);
    EXPECT_EQ(json["port"]["irq_thread"], nullptr);
    EXPECT_EQ(json["daemon"], nullptr);
    EXPECT_EQ(json["rates"].size(), 7u);
    EXPECT_EQ(json["rates"][0]["verdict"], "holds");
    EXPECT_EQ(json["rates"][0]["needed_tbit"], 68);
    EXPECT_EQ(json["rates"][6]["needed_tbit"], nullptr);
    EXPECT_EQ(json["findings"][0]["severity"], "better");

    serves(Baud::k9_6);
    const Json served = tune_json(facts(), rates(), findings());
    EXPECT_EQ(served["daemon"]["bus_thread"]["policy"], "fifo");
    const std::string page = test::content_of(test::kSource / "docs/man/dpctl.1.scd");
    for (const char* part : {"machine", "port", "daemon"})
        for (const auto& item : served[part].items()) EXPECT_THAT(page, HasSubstr('"' + item.key() + '"'));
    for (const char* array : {"rates", "findings"})
        for (const auto& item : served[array][0].items())
            EXPECT_THAT(page, HasSubstr('"' + item.key() + '"'));
}

TEST(DpctlTune, WithoutPortAndWithoutDaemonSaysWhatToType)
{
    const test::Ran ran = test::dpctl({"tune", "--socket", "/nonexistent/control.sock"});

    EXPECT_EQ(ran.exit, 3);
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr("If none runs, name the port: dpctl tune /dev/ttyS1\n"));
}

TEST(DpctlTune, JudgesAPortWithoutADaemon)
{
    const test::Ran none =
        test::dpctl({"tune", "/dev/no-such-port", "--socket", "/nonexistent/control.sock"});
    EXPECT_EQ(none.exit, 1);
    EXPECT_EQ(none.err, "");
    EXPECT_THAT(none.out, HasSubstr("/dev/no-such-port cannot serve a bus: no such port"));

    const test::Ran json =
        test::dpctl({"tune", "/dev/null", "--json", "--socket", "/nonexistent/control.sock"});
    EXPECT_EQ(json.exit, 1);
    EXPECT_EQ(Json::parse(json.out)["findings"][0]["name"], "port.no_rate");
}

TEST(DpctlTune, TakesThePortOfTheRunningDaemon)
{
    const test::FixtureDaemon daemon;
    const test::Ran ran = test::dpctl({"tune", "--json", "--socket", daemon.socket()});

    ASSERT_THAT(ran.exit, testing::AnyOf(0, 1)) << ran.err;
    const Json json = Json::parse(ran.out);
    EXPECT_EQ(json["port"]["path"], "/dev/ttyS1");
    EXPECT_EQ(json["daemon"]["baud"], 187500);
}

} // namespace
} // namespace dpslave::dpctl
