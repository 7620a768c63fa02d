// SPDX-License-Identifier: Apache-2.0
/// One output line of a GPIO character device, through libgpiod (version 1 on Debian 12, 2 on Debian 13:
/// CMake chooses the source).
#pragma once

#include "dpslave/base/result.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace dpslave::io {

struct GpioRequest {
    std::string chip{};      ///< "/dev/gpiochip0", or the name or label of a chip as `gpiodetect` shows them
    unsigned line = 0;       ///< offset on that chip
    bool active_low = false; ///< the pin is low while the line is active
    std::string consumer{};  ///< as `gpioinfo` shows the user of the line; at most 31 characters
    std::filesystem::path devices = "/dev"; ///< where a label is searched for
};

class GpioLine {
public:
    /// Takes the line as an output that is inactive at once, for this process alone, until the end of the
    /// object. The error is a sentence: chip not there, no right to it, line in use (with its consumer), no
    /// such line.
    static Result<GpioLine, std::string> request(const GpioRequest& request);

    GpioLine(GpioLine&&) noexcept;
    GpioLine& operator=(GpioLine&&) noexcept;
    ~GpioLine(); ///< inactive, then closed

    /// One system call, no allocation. May be called from any thread, though two at a time only where both
    /// want the same. An error: the chip has gone; every later call fails, too, even if the chip comes back.
    std::error_code set(bool active) noexcept;

private:
    struct Held;
    explicit GpioLine(std::unique_ptr<Held> held);
    std::unique_ptr<Held> held_;
};

} // namespace dpslave::io
