// SPDX-License-Identifier: Apache-2.0
/// The settings that a serial port had before a command used it: rate and format, who switches its
/// transceiver, and how promptly its driver hands octets on. They are put back at the end of the object.
#pragma once

#include "dpslave/base/result.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace dpslave::io {

class PortSettings {
public:
    /// Opens `path`, reads its settings and closes it. An error of device_or_resource_busy: another program
    /// has it; of inappropriate_io_control_operation: it is no serial port. `sysfs`: where it lies.
    static Result<PortSettings, std::error_code> save(const std::string& path,
                                                      const std::filesystem::path& sysfs = "/sys");

    PortSettings(PortSettings&&) noexcept;
    PortSettings& operator=(PortSettings&&) noexcept;
    /// Puts them back. A port that has gone meanwhile is left alone.
    ~PortSettings();

private:
    struct Saved;
    explicit PortSettings(std::unique_ptr<Saved> saved);
    std::unique_ptr<Saved> saved_;
};

} // namespace dpslave::io
