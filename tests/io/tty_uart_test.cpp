// SPDX-License-Identifier: Apache-2.0
/// Tests what is concluded from the UART behind a tty: the rate on the wire, and how soon it hands octets on.
/// The UARTs are made of what the kernel says of them: no such hardware is at hand.
#include "io/tty/uart.hpp"
#include "pty.hpp"
#include "support/folder.hpp"

#include "dpslave/io/tty.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/serial.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <fstream>
#include <sstream>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Uart uart_of(int type, std::uint32_t baud_base, const std::string& driver)
{
    Uart uart;
    uart.type = type;
    uart.baud_base = baud_base;
    uart.driver = driver;
    uart.name = "ttyS1";
    return uart;
}

const Uart kPcPort = uart_of(PORT_16550A, 115'200, "serial");
const Uart kUnknown{};

TEST(UartRate, TakenByADriverMayBeOffByOnePercentAtMost)
{
    EXPECT_EQ(judge_rate(kUnknown, 187'500, 187'500), "");
    EXPECT_EQ(judge_rate(kUnknown, 45'450, 45'455), ""); // 0.01 %: a divisor of 33 from 24 MHz
    EXPECT_EQ(judge_rate(kUnknown, 100'000, 101'000), "");
    EXPECT_EQ(judge_rate(kUnknown, 100'000, 99'000), "");
    EXPECT_NE(judge_rate(kUnknown, 100'000, 101'001), "");
    EXPECT_NE(judge_rate(kUnknown, 100'000, 98'999), "");
}

TEST(UartRate, ThatTheDriverDidNotTakeIsRefused)
{
    EXPECT_EQ(judge_rate(kUnknown, 187'500, 115'200),
              "this UART cannot do 187500 bit/s (it took 115200): choose a rate that it can do, or another "
              "adapter");
    EXPECT_THAT(judge_rate(kUnknown, 45'450, 9'600), HasSubstr("45450 bit/s (it took 9600)"));
    EXPECT_THAT(judge_rate(kUnknown, 9'600, 4'000'000'000), HasSubstr("it took 4000000000"));
    EXPECT_THAT(judge_rate(kPcPort, 187'500, 115'200), HasSubstr("`setserial /dev/ttyS1 baud_base N`"));
}

/// The 8250 driver reads 93750 back whatever the divisor makes of it.
TEST(UartRate, ThatTheUartCannotMakeIsRefusedWithTheRateOnTheWire)
{
    EXPECT_EQ(rate_on_the_wire(kPcPort, 93'750), 115'200U);
    EXPECT_EQ(
        judge_rate(kPcPort, 93'750, 93'750),
        "this UART cannot do 93750 bit/s (it divides its clock by a whole number, which makes 115200 of "
        "it): choose a rate that it can do, or another adapter; the driver takes the UART to "
        "reach 115200 bit/s: if its clock is another one, set it as root with `setserial "
        "/dev/ttyS1 baud_base N`");
}

struct ClockRow {
    std::uint32_t baud_base; ///< clock / 16
    std::vector<std::uint32_t> can;
};

void PrintTo(const ClockRow& row, std::ostream* out)
{
    *out << row.baud_base;
}

class EachClock : public testing::TestWithParam<ClockRow> {};

/// Wire reference 11.2, with 1 % as the limit.
TEST_P(EachClock, MakesTheRatesOfTheReferenceAndNoOthers)
{
    for (const char* const driver : {"", "serial8250", "serial", "of_serial"}) {
        const Uart uart = uart_of(PORT_16550A, GetParam().baud_base, driver);
        std::vector<std::uint32_t> can;
        for (const Baud baud : kBauds) {
            const auto rate = static_cast<std::uint32_t>(baud);
            if (judge_rate(uart, rate, rate).empty()) can.push_back(rate);
        }
        EXPECT_EQ(can, GetParam().can) << driver;
    }
}

INSTANTIATE_TEST_SUITE_P(
    OfA16550, EachClock,
    testing::Values(ClockRow{115'200, {9'600, 19'200}}, ClockRow{460'800, {9'600, 19'200}},
                    ClockRow{921'600, {9'600, 19'200}},
                    ClockRow{1'500'000, {9'600, 19'200, 45'450, 93'750, 187'500, 500'000, 1'500'000}},
                    ClockRow{1'562'500, {9'600, 19'200}},
                    ClockRow{3'000'000, {9'600, 19'200, 45'450, 93'750, 187'500, 500'000, 1'500'000}},
                    ClockRow{5'000'000, {9'600, 19'200, 45'450, 93'750, 500'000}}));

/// They have fractions, other oversampling, or a clock that follows the rate: what they read back counts.
TEST(UartRate, OfADriverWithADivisorOfItsOwnIsNotCalculated)
{
    for (const char* const driver : {"dw-apb-uart", "omap8250", "exar_serial", "ftdi_sio", "uart-pl011"})
        EXPECT_EQ(rate_on_the_wire(uart_of(PORT_16550A, 115'200, driver), 93'750), std::nullopt) << driver;
    EXPECT_EQ(rate_on_the_wire(uart_of(32 /* PORT_AMBA */, 115'200, ""), 93'750), std::nullopt);
    EXPECT_EQ(rate_on_the_wire(uart_of(PORT_16550A, 0, "serial"), 93'750), std::nullopt)
        << "no clock is known";
    EXPECT_EQ(rate_on_the_wire(kUnknown, 93'750), std::nullopt);
}

/// The part of sysfs that belongs to one tty.
class FakeSysfs {
public:
    /// `driver`: of the device. `serial_core`: with the two devices that newer kernels put in between.
    FakeSysfs(const std::string& tty, const std::string& driver, bool serial_core = false)
    {
        fs::path device = root_ / "devices/pnp0/00:01";
        drive(device, driver);
        if (serial_core) {
            drive(device /= "00:01:0", "ctrl");
            drive(device /= "00:01:0.0", "port");
        }
        folder_ = device / "tty/ttyS1";
        fs::create_directories(folder_);
        fs::create_directory_symlink(device, folder_ / "device");
        struct stat info {};
        if (::stat(tty.c_str(), &info) != 0) throw std::system_error{errno, std::system_category(), tty};
        fs::create_directories(root_ / "dev/char");
        fs::create_directory_symlink(
            folder_, root_ / "dev/char" /
                         (std::to_string(major(info.st_rdev)) + ":" + std::to_string(minor(info.st_rdev))));
    }

    const fs::path& root() const { return root_; }
    void write(const std::string& attribute, const std::string& text) const
    {
        std::ofstream{folder_ / attribute} << text;
    }
    /// A number other than 1 that cannot be changed, as for a user without the right to it. Returns it.
    std::string freeze(const std::string& attribute) const
    {
        fs::create_symlink("/proc/sys/kernel/random/poolsize", folder_ / attribute);
        std::string number = read(attribute);
        number.pop_back(); // the line break
        return number;
    }
    std::string read(const std::string& attribute) const
    {
        std::ostringstream text;
        text << std::ifstream{folder_ / attribute}.rdbuf();
        return text.str();
    }

private:
    void drive(const fs::path& device, const std::string& driver) const
    {
        fs::create_directories(device);
        fs::create_directories(root_ / "bus/drivers" / driver);
        fs::create_directory_symlink(root_ / "bus/drivers" / driver, device / "driver");
    }

    dpslave::test::Folder made_;
    fs::path root_ = made_.path(), folder_;
};

constexpr TtySettings kPrompt{.baud = 187'500, .mark_errors = true, .prompt = true};

std::vector<std::string> warnings_of(const Pty& cable, const FakeSysfs& sysfs,
                                     const TtySettings& settings = kPrompt)
{
    const auto tty = Tty::open(cable.path(), settings, sysfs.root());
    if (!tty) throw std::runtime_error{tty.error()};
    return tty->warnings();
}

TEST(UartLook, FindsNameAndDriverOfOlderAndNewerKernels)
{
    for (const bool serial_core : {false, true}) {
        Pty cable;
        const FakeSysfs sysfs{cable.path(), "serial8250", serial_core};
        const Fd fd{::open(cable.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};

        const Uart uart = look_at(fd.get(), sysfs.root());

        EXPECT_EQ(uart.name, "ttyS1");
        EXPECT_EQ(uart.driver, "serial8250");
        EXPECT_TRUE(uart.pty);
    }
}

TEST(UartLook, WithoutSysfsOrOnAPtyFindsNothingAndWarnsOfNothing)
{
    Pty cable;
    for (const char* const sysfs : {"/no-such-folder", "/sys"}) {
        const auto tty = Tty::open(cable.path(), kPrompt, sysfs);
        ASSERT_TRUE(tty) << tty.error();
        EXPECT_THAT(tty->warnings(), IsEmpty());
    }
}

TEST(UartTrigger, IsSetToOneWhereTheDriverHasIt)
{
    Pty cable;
    const FakeSysfs sysfs{cable.path(), "serial8250"};
    sysfs.write("rx_trig_bytes", "8\n");

    EXPECT_THAT(warnings_of(cable, sysfs), IsEmpty());

    EXPECT_EQ(sysfs.read("rx_trig_bytes"), "1\n");
}

TEST(UartTrigger, StaysAsItIsOnALineThatIsInNoHurry)
{
    Pty cable;
    const FakeSysfs sysfs{cable.path(), "serial8250"};
    sysfs.write("rx_trig_bytes", "8\n");

    EXPECT_THAT(warnings_of(cable, sysfs, {.baud = 9'600}), IsEmpty());

    EXPECT_EQ(sysfs.read("rx_trig_bytes"), "8\n");
}

TEST(UartTrigger, ThatStaysAboveOneIsAWarningWithItsCostAndRemedy)
{
    Pty cable;
    const FakeSysfs sysfs{cable.path(), "serial8250"};
    const std::string number = sysfs.freeze("rx_trig_bytes");

    EXPECT_THAT(
        warnings_of(cable, sysfs),
        ElementsAre("the UART hands on what it receives by " + number +
                    " octets, and fewer only after the line was idle for a while: this costs up to 44 "
                    "bit times of the time that an answer may take; a longer max_tsdr, here and in "
                    "the master's GSD, makes room for it. Better: let root or a udev rule write 1 to "
                    "/sys/class/tty/ttyS1/rx_trig_bytes"));
}

struct DriverRow {
    const char* driver;
    const char* cost; ///< null = no warning
};

void PrintTo(const DriverRow& row, std::ostream* out)
{
    *out << row.driver;
}

class WithoutTrigger : public testing::TestWithParam<DriverRow> {};

/// Wire reference 11.5.
TEST_P(WithoutTrigger, CostsWhatTheReferenceSaysOfItsDriver)
{
    Pty cable;
    const FakeSysfs sysfs{cable.path(), GetParam().driver};

    const auto warnings = warnings_of(cable, sysfs);

    if (GetParam().cost == nullptr)
        EXPECT_THAT(warnings, IsEmpty());
    else
        EXPECT_THAT(warnings, ElementsAre(HasSubstr(GetParam().cost)));
}

INSTANTIATE_TEST_SUITE_P(
    AtAPort, WithoutTrigger,
    testing::Values(DriverRow{"uart-pl011", "costs up to 32 bit times of"},
                    DriverRow{"serial8250", "costs up to 44 bit times of"},
                    DriverRow{"omap8250", "costs up to 44 bit times of"},
                    DriverRow{"imx-uart", "costs up to 88 bit times of"},
                    DriverRow{"cp210x", "up to 1 ms (9 bit times at 9.6 kbit/s, 1500 at 1.5 Mbit/s)"},
                    DriverRow{"cdc_acm", "once in a USB frame"}, DriverRow{"some-uart", nullptr}));

TEST(UartTrigger, OfAChipWithoutFifoIsNoneAndNoWarning)
{
    Uart uart = uart_of(PORT_16450, 115'200, "serial8250");
    uart.folder = fs::temp_directory_path() / "dpslave-no-such-folder";

    EXPECT_THAT(set_prompt(uart), IsEmpty());
}

TEST(UartLatencyTimer, OfAnFtdiAdapterIsSetToOneMillisecond)
{
    Pty cable;
    const FakeSysfs sysfs{cable.path(), "ftdi_sio"};
    sysfs.write("device/latency_timer", "16\n");

    EXPECT_THAT(warnings_of(cable, sysfs),
                ElementsAre(AllOf(HasSubstr("once in a USB frame"), HasSubstr("up to 1 ms"))));
    EXPECT_EQ(sysfs.read("device/latency_timer"), "1\n");
}

TEST(UartLatencyTimer, ThatCannotBeSetIsAWarning)
{
    Pty cable;
    const FakeSysfs sysfs{cable.path(), "ftdi_sio"};

    EXPECT_THAT(warnings_of(cable, sysfs),
                ElementsAre(AllOf(HasSubstr("up to 16 ms (153 bit times at 9.6 kbit/s, 24000 at 1.5 Mbit/s)"),
                                  HasSubstr("/sys/class/tty/ttyS1/device/latency_timer"))));
}

TEST(UartLatencyTimer, IsNotedWhenThePortIsOpenedAndNotReadAgain)
{
    const Pty cable;
    const FakeSysfs sysfs{cable.path(), "ftdi_sio"};
    sysfs.write("device/latency_timer", "4\n");
    const Fd fd{::open(cable.path().c_str(), O_RDWR | O_NOCTTY)};
    Uart uart = look_at(fd.get(), sysfs.root());
    uart.pty = false;
    note_triggers(uart);

    sysfs.write("device/latency_timer", "16\n");

    EXPECT_EQ(hold_back(uart, std::chrono::microseconds{1}), std::chrono::milliseconds{5});
}

TEST(UartFormat, OfAUartWithoutParityIsRefusedAlthoughItsDriverTakesIt)
{
    Pty cable;
    const FakeSysfs sysfs{cable.path(), "bcm2835-aux-uart"};

    const auto bus = Tty::open(cable.path(), kPrompt, sysfs.root());

    ASSERT_FALSE(bus);
    EXPECT_THAT(bus.error(), AllOf(testing::StartsWith(cable.path()), HasSubstr("no parity"),
                                   HasSubstr("use its other UART")));
    EXPECT_TRUE(Tty::open(cable.path(), {.baud = 9'600, .parity = 'N'}, sysfs.root()));
}

} // namespace
} // namespace dpslave::io
