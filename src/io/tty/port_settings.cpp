// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/port_settings.hpp"

#include "uart.hpp"

#include "dpslave/io/fd.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <fcntl.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <optional>

namespace dpslave::io {

namespace fs = std::filesystem;

namespace {

Fd open_port(const std::string& path)
{
    return Fd{::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
}

std::string content(const fs::path& file)
{
    std::ifstream in{file};
    std::string text;
    std::getline(in, text);
    return text;
}

} // namespace

/// These settings are changed by Tty, DriverEnable and set_prompt().
struct PortSettings::Saved {
    struct SysfsFile {
        fs::path path;
        std::string text; ///< empty: the driver has no such file
    };

    std::string path;
    termios2 line{};
    std::optional<serial_rs485> rs485;
    std::optional<int> flags; ///< of serial_struct
    std::array<SysfsFile, 2> files{};
};

PortSettings::PortSettings(std::unique_ptr<Saved> saved) : saved_(std::move(saved)) {}
PortSettings::PortSettings(PortSettings&&) noexcept = default;
PortSettings& PortSettings::operator=(PortSettings&&) noexcept = default;

Result<PortSettings, std::error_code> PortSettings::save(const std::string& path, const fs::path& sysfs)
{
    auto saved = std::make_unique<Saved>();
    saved->path = path;
    const Fd port = open_port(path);
    if (!port || ::ioctl(port.get(), TCGETS2, &saved->line) < 0)
        return Failure{std::error_code{errno, std::generic_category()}};
    if (::flock(port.get(), LOCK_EX | LOCK_NB) < 0) // as Tty::open does
        return Failure{std::make_error_code(std::errc::device_or_resource_busy)};
    serial_rs485 rs485{};
    if (::ioctl(port.get(), TIOCGRS485, &rs485) == 0) saved->rs485 = rs485;
    serial_struct serial{};
    if (::ioctl(port.get(), TIOCGSERIAL, &serial) == 0) saved->flags = serial.flags;
    const fs::path folder = look_at(port.get(), sysfs).folder;
    if (!folder.empty())
        for (std::size_t i = 0; i < saved->files.size(); ++i) {
            const fs::path file = folder / (i == 0 ? "rx_trig_bytes" : "device/latency_timer");
            saved->files[i] = {file, content(file)};
        }
    return PortSettings{std::move(saved)};
}

PortSettings::~PortSettings()
{
    if (!saved_) return;
    const Fd port = open_port(saved_->path);
    if (!port) return;
    static_cast<void>(::ioctl(port.get(), TCSETS2, &saved_->line));
    if (saved_->rs485) static_cast<void>(::ioctl(port.get(), TIOCSRS485, &*saved_->rs485));
    if (serial_struct serial{}; saved_->flags && ::ioctl(port.get(), TIOCGSERIAL, &serial) == 0) {
        serial.flags = *saved_->flags;
        static_cast<void>(::ioctl(port.get(), TIOCSSERIAL, &serial));
    }
    for (const Saved::SysfsFile& file : saved_->files)
        if (!file.text.empty() && content(file.path) != file.text)
            std::ofstream{file.path} << file.text << '\n';
}

} // namespace dpslave::io
