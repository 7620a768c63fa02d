// SPDX-License-Identifier: Apache-2.0
/// The output of a lamp: a line of a GPIO chip, a lamp of the kernel's LED class, or a pin of sysfs GPIO.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/io/gpio.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace dpslave::io {

class LedSink {
public:
    LedSink() = default;
    LedSink(const LedSink&) = delete;
    LedSink& operator=(const LedSink&) = delete;
    virtual ~LedSink() = default; ///< the lamp is off then

    /// Each call here, and the end, may wait for a bus (I2C). False: the lamp cannot be switched, and has to
    /// be opened again.
    virtual bool set(bool lit) = 0;
};

/// "line:CHIP:LINE": a GPIO character device, chip as GpioRequest has it. "led:NAME":
/// <sysfs>/class/leds/NAME, trigger none. "gpio:N": <sysfs>/class/gpio, exported if need be, an output;
/// "gpio:LABEL:OFFSET" where N is another one after each boot. The lamp is dark at first. It may wait half a
/// second for udev to give a pin that it has exported to the group. The error is a sentence with path, reason
/// and what to do.
Result<std::unique_ptr<LedSink>, std::string> open_led_sink(const std::string& sink,
                                                            const std::filesystem::path& sysfs);

/// Returns what to write instead of `sink` if its form is wrong, in the words of open_led_sink() without the
/// name; nullopt if the form is right. It opens nothing.
std::optional<std::string> judge_led_sink(const std::string& sink);
/// Returns the line that a sink of the kind "line:" asks for; nullopt if it is another kind, or its form is
/// wrong.
std::optional<GpioRequest> line_of_led_sink(const std::string& sink);

/// Returns the lamp or pin that `sink` drives, the same for each of its names as far as <sysfs> shows: two
/// spellings of a path, "gpio:N" and "line:CHIP:LINE" of one line. It is for comparison only. It opens no
/// device.
std::string led_sink_target(const std::string& sink, const std::filesystem::path& sysfs);

} // namespace dpslave::io
