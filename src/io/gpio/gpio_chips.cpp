// SPDX-License-Identifier: Apache-2.0
#include "gpio_chips.hpp"

#include <algorithm>
#include <tuple>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;

std::string line_of(const GpioRequest& request)
{
    return "line " + std::to_string(request.line) + " of GPIO chip " + request.chip;
}

} // namespace

bool is_path(const std::string& chip)
{
    return chip.find('/') != std::string::npos;
}

std::vector<std::string> gpio_chips(const fs::path& devices)
{
    std::vector<std::string> paths;
    std::error_code error;
    for (fs::directory_iterator entry{devices, error}, end; !error && entry != end; entry.increment(error))
        if (entry->path().filename().string().starts_with("gpiochip"))
            paths.push_back(entry->path().string());
    std::sort(paths.begin(), paths.end(), [](const std::string& a, const std::string& b) {
        return std::forward_as_tuple(a.size(), a) < std::forward_as_tuple(b.size(), b); // 2 before 10
    });
    return paths;
}

std::string why_no_chip(const GpioRequest& request, int error)
{
    const std::string chip = "GPIO chip " + request.chip;
    switch (error) {
        case ENOENT:
        case ENXIO:
            return chip +
                   (is_path(request.chip) ? " is not there"
                                          : " is not there: no chip has this name or label") +
                   "; `gpiodetect` lists the chips of this machine";
        case EACCES:
        case EPERM:
            return chip +
                   ": this user may not open it: the udev rule 60-dpslaved.rules gives GPIO chips to the group dpslaved-devices, and another rule may give them to a group gpio: see ls -l /dev/gpiochip*. Of a service, name that group with SupplementaryGroups= in the unit, as dpslaved.service does, and allow DeviceAllow=char-gpiochip rw; by hand, add the user to the group";
        case ENOTTY:
        case ENODEV:
        case EINVAL: return chip + " is no GPIO chip; `gpiodetect` lists the chips of this machine";
        default:
            return chip + " cannot be opened (" + std::system_category().message(error) +
                   "); `gpiodetect` lists the chips of this machine";
    }
}

std::string why_ambiguous(const GpioRequest& request, const std::string& one, const std::string& other)
{
    return "GPIO chip " + request.chip + " could be " + one + " or " + other + ": give the path of the chip";
}

std::string why_no_line(const GpioRequest& request, std::size_t lines)
{
    return line_of(request) + " does not exist: the chip has " + std::to_string(lines) +
           " lines, from 0 to " + std::to_string(lines == 0 ? 0 : lines - 1) + "; `gpioinfo` lists them";
}

std::string why_not_taken(const GpioRequest& request, int error, std::string_view consumer)
{
    if (error == EBUSY)
        return line_of(request) + " is in use" +
               (consumer.empty() ? std::string{} : " by \"" + std::string{consumer} + '"') +
               ": stop that program or choose another line; `gpioinfo` lists lines and their users";
    if (error == EACCES || error == EPERM) return why_no_chip(request, error);
    return line_of(request) + " cannot be made an output (" + std::system_category().message(error) +
           "): choose another line; `gpioinfo` lists them";
}

} // namespace dpslave::io
