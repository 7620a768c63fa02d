// SPDX-License-Identifier: Apache-2.0
/// A real lamp: a pin of sysfs GPIO, or a lamp of the kernel's LED class.
#pragma once

#include "dpslave/base/result.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace dpslave::io {

class LedSink {
public:
    LedSink() = default;
    LedSink(const LedSink&) = delete;
    LedSink& operator=(const LedSink&) = delete;
    virtual ~LedSink() = default; ///< leaves the lamp dark

    /// Writes only what changes. A lamp that has gone is tried again with the next change and hinders nobody.
    virtual void set(bool lit) = 0;
};

/// "gpio:N": <sysfs>/class/gpio, exported if need be, an output. "led:NAME": <sysfs>/class/leds/NAME, trigger
/// none. The lamp is dark at first. The error is a sentence with path, reason and what to do.
Result<std::unique_ptr<LedSink>, std::string> open_led_sink(const std::string& sink,
                                                            const std::filesystem::path& sysfs);

} // namespace dpslave::io
