// SPDX-License-Identifier: Apache-2.0
/// The settings of a port as its driver took them, and how those in force differ from them later. Separate
/// from tty.cpp for the same reason as tty_settings.
#pragma once

#include "dpslave/io/changed_settings.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <system_error>

namespace dpslave::io {

class KeptSettings {
public:
    KeptSettings();
    KeptSettings(KeptSettings&&) noexcept;
    KeptSettings& operator=(KeptSettings&&) noexcept;
    ~KeptSettings();

    /// Those in force now are the ones that are wanted. A port that has gone changes nothing.
    void note(int fd) noexcept;
    /// The same of the RS-485 mode; before the first call nothing is wanted of it.
    void note_rs485(int fd) noexcept;
    /// Two system calls, one where the UART has no RS-485 mode, and no allocation. Nothing: they are as they
    /// were noted, or the port has gone.
    std::optional<ChangedSettings> changed(int fd) const noexcept;
    /// Sets those that were noted, with the rate as it was asked for, and reads them back. What waits to be
    /// sent is discarded.
    std::error_code set_again(int fd, std::uint32_t baud) const noexcept;

private:
    struct Settings;
    std::unique_ptr<Settings> noted_;
};

} // namespace dpslave::io
