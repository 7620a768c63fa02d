// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/led_sink.hpp"

#include "gpio_chips.hpp"

#include "dpslave/io/fd.hpp"
#include "dpslave/io/gpio.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;

/// 0, or errno. An attribute of sysfs takes a value with one write; opened anew each time, so that a lamp
/// that came back is found again. Lamps change a few times a second only.
int write_attribute(const fs::path& file, std::string_view value)
{
    const Fd fd{::open(file.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC)};
    if (!fd) return errno;
    const std::string line = std::string{value} + '\n';
    const ssize_t taken = ::write(fd.get(), line.data(), line.size());
    if (taken < 0) return errno;
    return taken == static_cast<ssize_t>(line.size()) ? 0 : EIO;
}

/// The first line of `file`; empty = there is no such file, or nothing in it.
std::string read_line(const fs::path& file)
{
    const Fd fd{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
    char text[64] = {};
    if (!fd || ::read(fd.get(), text, sizeof text - 1) <= 0) return {};
    const std::string line{text};
    return line.substr(0, line.find('\n'));
}

/// All of `text` as a number of at most nine digits.
std::optional<unsigned> number_of(std::string_view text)
{
    unsigned number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || text.size() > 9) return std::nullopt;
    return number;
}

std::string sentence(const std::string& sink, const fs::path& file, int error, std::string_view what_to_do)
{
    return "LED " + sink + ": " + file.string() + " cannot be written (" +
           std::system_category().message(error) + "): " + std::string{what_to_do};
}

/// One attribute that lights the lamp with one value and darkens it with another.
class Attribute final : public LedSink {
public:
    Attribute(fs::path file, std::string on) : file_(std::move(file)), on_(std::move(on)) {}
    ~Attribute() override { static_cast<void>(write_attribute(file_, "0")); }

    bool set(bool lit) override { return write_attribute(file_, lit ? std::string_view{on_} : "0") == 0; }

private:
    fs::path file_;
    std::string on_;
};

/// A line of a GPIO chip.
class LineLamp final : public LedSink {
public:
    explicit LineLamp(GpioLine line) : line_(std::move(line)) {}
    bool set(bool lit) override { return !line_.set(lit); }

private:
    GpioLine line_; // inactive when it is requested, and when it is released
};

using Opened = Result<std::unique_ptr<LedSink>, std::string>;

/// 0, or errno. The kernel makes the pin's folder in the course of the export; udev gives its files to the
/// group a little later.
int wait_until_writable(const fs::path& file, std::chrono::milliseconds longest)
{
    constexpr std::chrono::milliseconds kPause{10};
    for (;;) {
        if (::access(file.c_str(), W_OK) == 0) return 0;
        const int error = errno;
        if (longest <= kPause) return error;
        longest -= kPause;
        ::poll(nullptr, 0, static_cast<int>(kPause.count()));
    }
}

/// Returns for "LABEL:OFFSET" the number that this pin has in sysfs since the last boot; nullopt if there is
/// no such chip or pin.
std::optional<unsigned> numbered(const std::string& label_and_offset, const fs::path& gpio)
{
    const std::size_t colon = label_and_offset.rfind(':');
    if (colon == std::string::npos) return number_of(label_and_offset);
    const auto offset = number_of(std::string_view{label_and_offset}.substr(colon + 1));
    std::error_code error;
    for (fs::directory_iterator entry{gpio, error}, end; !error && entry != end; entry.increment(error)) {
        const fs::path& chip = entry->path();
        if (read_line(chip / "label") != label_and_offset.substr(0, colon)) continue;
        const auto base = number_of(read_line(chip / "base")), pins = number_of(read_line(chip / "ngpio"));
        if (offset && base && pins && *offset < *pins) return *base + *offset;
    }
    return std::nullopt;
}

Opened open_gpio(const std::string& sink, const std::string& name, const fs::path& sysfs)
{
    constexpr std::string_view kAdvice =
        "check that the pin exists and is free (`gpioinfo`), and that this user may use sysfs GPIO";
    const fs::path gpio = sysfs / "class" / "gpio";
    const auto found = numbered(name, gpio);
    if (!found)
        return Failure{"LED " + sink + ": no GPIO chip in " + gpio.string() +
                       " has this label and that many lines: check it with `gpioinfo`"};

    const std::string number = std::to_string(*found);
    const fs::path pin = gpio / ("gpio" + number);
    std::error_code ignored;
    std::chrono::milliseconds longest{0}; // a pin that was there before has the rights that it gets
    if (!fs::exists(pin, ignored)) {
        longest = std::chrono::milliseconds{250};
        // EBUSY: it was exported between the look and the write; the pin is there then.
        if (const int error = write_attribute(gpio / "export", number); error != 0 && error != EBUSY)
            return Failure{sentence(sink, gpio / "export", error, kAdvice)};
    }
    for (const char* const attribute : {"direction", "value"})
        if (const int error = wait_until_writable(pin / attribute, longest); error != 0)
            return Failure{sentence(sink, pin / attribute, error, kAdvice)};
    // "low" makes an output of it that was never high, which "out" does not guarantee; it means the pin, and
    // 0 the lamp, which differs where the pin is active low.
    if (const int error = write_attribute(pin / "direction", "low"); error != 0)
        return Failure{sentence(sink, pin / "direction", error, kAdvice)};
    if (const int error = write_attribute(pin / "value", "0"); error != 0)
        return Failure{sentence(sink, pin / "value", error, kAdvice)};
    return Opened{std::make_unique<Attribute>(pin / "value", "1")};
}

Opened open_led_class(const std::string& sink, const std::string& name, const fs::path& sysfs)
{
    const fs::path lamp = sysfs / "class" / "leds" / name;
    const fs::path brightness = lamp / "brightness";
    // A trigger (heartbeat, mmc0 ...) would disturb the pattern. A kernel built without triggers has no
    // such file.
    if (const int error = write_attribute(lamp / "trigger", "none"); error != 0 && error != ENOENT)
        return Failure{sentence(sink, lamp / "trigger", error, "check that this user may use the LED class")};
    if (const int error = write_attribute(brightness, "0"); error != 0)
        return Failure{sentence(sink, brightness, error,
                                "check the name in " + (sysfs / "class" / "leds").string() +
                                    ", and that this user may use the LED class")};
    constexpr unsigned kFull = 255; // LED_FULL; the kernel cuts it to what the lamp can
    const unsigned full = number_of(read_line(lamp / "max_brightness")).value_or(kFull);
    return Opened{std::make_unique<Attribute>(brightness, std::to_string(full))};
}

Opened open_line(const std::string& sink, const GpioRequest& request)
{
    auto taken = GpioLine::request(request);
    if (!taken) return Failure{"LED " + sink + ": " + taken.error()};
    return Opened{std::make_unique<LineLamp>(std::move(*taken))};
}

/// "line:CHIP:LINE" as "line" and "CHIP:LINE".
std::pair<std::string, std::string> cut(const std::string& text, std::size_t colon)
{
    if (colon == std::string::npos) return {text, {}};
    return {text.substr(0, colon), text.substr(colon + 1)};
}

/// A GPIO chip of sysfs: <sysfs>/class/gpio/gpiochipBASE.
struct SysfsChip {
    unsigned base = 0;
    unsigned pins = 0;
    std::string label;
    std::string device; ///< "gpiochip0", as /dev has it; empty = not known
};

/// The character device of a chip is in the folder of the device that it belongs to.
std::string device_of(const fs::path& chip)
{
    std::error_code error;
    for (fs::directory_iterator entry{chip / "device", error}, end; !error && entry != end;
         entry.increment(error)) {
        std::string name = entry->path().filename().string();
        if (name.starts_with("gpiochip") && number_of(std::string_view{name}.substr(8))) return name;
    }
    return {};
}

std::vector<SysfsChip> sysfs_chips(const fs::path& gpio)
{
    std::vector<SysfsChip> chips;
    std::error_code error;
    for (fs::directory_iterator entry{gpio, error}, end; !error && entry != end; entry.increment(error)) {
        const auto base = number_of(read_line(entry->path() / "base"));
        const auto pins = number_of(read_line(entry->path() / "ngpio"));
        if (base && pins)
            chips.push_back({*base, *pins, read_line(entry->path() / "label"), device_of(entry->path())});
    }
    return chips;
}

std::string line_target(const std::string& chip, unsigned line)
{
    return "line:" + chip + ':' + std::to_string(line);
}

/// "gpio:N" and "gpio:LABEL:OFFSET" as the line of a chip, as far as sysfs shows; else by the number.
std::string pin_target(const std::string& name, const fs::path& gpio)
{
    const auto number = numbered(name, gpio);
    if (!number) return "gpio:" + name;
    for (const SysfsChip& chip : sysfs_chips(gpio))
        if (!chip.device.empty() && *number >= chip.base && *number - chip.base < chip.pins)
            return line_target(chip.device, *number - chip.base);
    return "gpio:" + std::to_string(*number);
}

/// A chip by its path, name or label as "gpiochip0", as far as that can be known without opening it.
std::string chip_target(const std::string& chip, const fs::path& gpio)
{
    std::error_code error;
    if (is_path(chip)) {
        const fs::path real = fs::weakly_canonical(chip, error);
        const fs::path path = error ? fs::path{chip}.lexically_normal() : real;
        return path.parent_path() == "/dev" ? path.filename().string() : path.string();
    }
    for (const SysfsChip& known : sysfs_chips(gpio))
        if (!known.device.empty() && known.label == chip) return known.device;
    return chip;
}

} // namespace

std::string led_sink_target(const std::string& sink, const fs::path& sysfs)
{
    const fs::path gpio = sysfs / "class" / "gpio";
    if (const auto line = line_of_led_sink(sink))
        return line_target(chip_target(line->chip, gpio), line->line);
    const auto [kind, rest] = cut(sink, sink.find(':'));
    if (kind == "gpio") return pin_target(rest, gpio);
    if (kind != "led") return sink;
    std::error_code error;
    const fs::path lamp = fs::canonical(sysfs / "class" / "leds" / rest, error);
    return "led:" + (error ? rest : lamp.filename().string());
}

std::optional<GpioRequest> line_of_led_sink(const std::string& sink)
{
    const auto [kind, rest] = cut(sink, sink.find(':'));
    const auto [chip, line] = cut(rest, rest.rfind(':'));
    const auto number = number_of(line);
    if (kind != "line" || chip.empty() || !number) return std::nullopt;
    return GpioRequest{.chip = chip, .line = *number, .consumer = "dpslaved lamp"};
}

std::optional<std::string> judge_led_sink(const std::string& sink)
{
    const auto [kind, rest] = cut(sink, sink.find(':'));
    if (kind == "line") {
        if (line_of_led_sink(sink)) return std::nullopt;
        return "write \"line:CHIP:LINE\", for example \"line:/dev/gpiochip0:24\"; instead of its path also the label of the chip, as `gpiodetect` shows it";
    }
    if (kind == "gpio") {
        const auto [label, offset] = cut(rest, rest.rfind(':'));
        const bool has_label = rest.find(':') != std::string::npos;
        if (has_label ? !label.empty() && number_of(offset) : number_of(rest).has_value())
            return std::nullopt;
        return "write \"gpio:23\", or \"gpio:LABEL:OFFSET\" with the label of the chip and the offset on it, as `gpioinfo` shows them: the numbers change from boot to boot";
    }
    if (kind == "led") {
        if (!rest.empty() && rest != "." && rest != ".." && rest.find('/') == std::string::npos)
            return std::nullopt;
        return "write \"led:NAME\" with the name of a folder in <sysfs>/class/leds";
    }
    return "write \"line:CHIP:LINE\" for a line of a GPIO chip, \"led:NAME\" for an LED of the LED class, or \"gpio:N\" for a GPIO of sysfs";
}

Result<std::unique_ptr<LedSink>, std::string> open_led_sink(const std::string& sink, const fs::path& sysfs)
{
    if (const auto wrong = judge_led_sink(sink)) return Failure{"LED \"" + sink + "\": " + *wrong};
    if (const auto line = line_of_led_sink(sink)) return open_line(sink, *line);
    const auto [kind, rest] = cut(sink, sink.find(':'));
    return kind == "gpio" ? open_gpio(sink, rest, sysfs) : open_led_class(sink, rest, sysfs);
}

} // namespace dpslave::io
