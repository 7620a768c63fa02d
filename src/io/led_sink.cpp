// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/led_sink.hpp"

#include "dpslave/io/fd.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string_view>
#include <system_error>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;

/// 0, or errno. An attribute of sysfs takes a value with one write; opened anew each time, so that a lamp
/// that came back is found again. Lamps change a few times a second: nobody notices the price.
int write_attribute(const fs::path& file, std::string_view value)
{
    const Fd fd{::open(file.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC)};
    if (!fd) return errno;
    const std::string line = std::string{value} + '\n';
    const ssize_t taken = ::write(fd.get(), line.data(), line.size());
    if (taken < 0) return errno;
    return taken == static_cast<ssize_t>(line.size()) ? 0 : EIO;
}

/// The first number in `file`; none = there is no such file, or no number in it.
std::optional<unsigned> read_number(const fs::path& file)
{
    const Fd fd{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
    char text[16] = {};
    if (!fd || ::read(fd.get(), text, sizeof text - 1) <= 0) return std::nullopt;
    unsigned number = 0;
    const char* at = text;
    for (; *at >= '0' && *at <= '9'; ++at) number = number * 10 + static_cast<unsigned>(*at - '0');
    if (at == text) return std::nullopt;
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

    void set(bool lit) override
    {
        if (lit == lit_) return;
        if (write_attribute(file_, lit ? std::string_view{on_} : "0") == 0) lit_ = lit;
    }

private:
    fs::path file_;
    std::string on_;
    bool lit_ = false; // open_led_sink() has darkened it
};

using Opened = Result<std::unique_ptr<LedSink>, std::string>;

/// 0, or errno. The kernel makes the pin's folder in the course of the export; udev gives its files to the
/// group a little later.
int wait_until_writable(const fs::path& file)
{
    constexpr int kTries = 50;
    constexpr int kPauseMs = 10;
    int error = 0;
    for (int i = 0; i < kTries; ++i) {
        if (::access(file.c_str(), W_OK) == 0) return 0;
        error = errno;
        ::poll(nullptr, 0, kPauseMs);
    }
    return error;
}

Opened open_gpio(const std::string& sink, const std::string& number, const fs::path& sysfs)
{
    constexpr std::string_view kAdvice =
        "check that the pin exists and is free (`gpioinfo`), and that this user may use sysfs GPIO";
    if (number.empty() || number.size() > 9 ||
        !std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; }))
        return Failure{"LED " + sink + ": \"" + number + "\" is no GPIO number: write \"gpio:23\""};

    const fs::path gpio = sysfs / "class" / "gpio";
    const fs::path pin = gpio / ("gpio" + number);
    std::error_code ignored;
    if (!fs::exists(pin, ignored)) {
        // EBUSY: somebody exported it between the look and the write; the pin is there then.
        if (const int error = write_attribute(gpio / "export", number); error != 0 && error != EBUSY)
            return Failure{sentence(sink, gpio / "export", error, kAdvice)};
    }
    if (const int error = wait_until_writable(pin / "direction"); error != 0)
        return Failure{sentence(sink, pin / "direction", error, kAdvice)};
    if (const int error = write_attribute(pin / "direction", "out"); error != 0)
        return Failure{sentence(sink, pin / "direction", error, kAdvice)};
    if (const int error = write_attribute(pin / "value", "0"); error != 0)
        return Failure{sentence(sink, pin / "value", error, kAdvice)};
    return Opened{std::make_unique<Attribute>(pin / "value", "1")};
}

Opened open_led_class(const std::string& sink, const std::string& name, const fs::path& sysfs)
{
    if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
        return Failure{"LED " + sink + ": \"" + name +
                       "\" is no name of a lamp: write \"led:NAME\" with a name from " +
                       (sysfs / "class" / "leds").string()};
    const fs::path lamp = sysfs / "class" / "leds" / name;
    const fs::path brightness = lamp / "brightness";
    // A trigger (heartbeat, mmc0 ...) would write into our pattern. A kernel built without triggers has no
    // such file.
    if (const int error = write_attribute(lamp / "trigger", "none"); error != 0 && error != ENOENT)
        return Failure{sentence(sink, lamp / "trigger", error, "check that this user may use the LED class")};
    if (const int error = write_attribute(brightness, "0"); error != 0)
        return Failure{sentence(sink, brightness, error,
                                "check the name in " + (sysfs / "class" / "leds").string() +
                                    ", and that this user may use the LED class")};
    constexpr unsigned kFull = 255; // LED_FULL; the kernel cuts it to what the lamp can
    const unsigned full = read_number(lamp / "max_brightness").value_or(kFull);
    return Opened{std::make_unique<Attribute>(brightness, std::to_string(full))};
}

} // namespace

Result<std::unique_ptr<LedSink>, std::string> open_led_sink(const std::string& sink, const fs::path& sysfs)
{
    const std::size_t colon = sink.find(':');
    const std::string kind = sink.substr(0, colon);
    const std::string rest = colon == std::string::npos ? std::string{} : sink.substr(colon + 1);
    if (kind == "gpio") return open_gpio(sink, rest, sysfs);
    if (kind == "led") return open_led_class(sink, rest, sysfs);
    return Failure{"LED \"" + sink + "\": unknown kind of sink: write \"gpio:N\" or \"led:NAME\""};
}

} // namespace dpslave::io
