// SPDX-License-Identifier: Apache-2.0
/// The common part of both versions of libgpiod: it finds the chip that is meant, and has the sentences for
/// one that cannot be opened.
#pragma once

#include "dpslave/io/gpio.hpp"

#include <cerrno>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dpslave::io {

/// Is a chip given by its path? Otherwise by its name or label.
bool is_path(const std::string& chip);
/// The GPIO chips in `devices`, lowest number first.
std::vector<std::string> gpio_chips(const std::filesystem::path& devices);

std::string why_no_chip(const GpioRequest& request, int error);
std::string why_ambiguous(const GpioRequest& request, const std::string& one, const std::string& other);
std::string why_no_line(const GpioRequest& request, std::size_t lines);
/// `consumer`: the user of the line, empty if it is not known.
std::string why_not_taken(const GpioRequest& request, int error, std::string_view consumer);

/// `open(path)`: a pointer-like Chip, or an empty one and errno. `label(chip)`: its label. libgpiod has a
/// search for a label too (version 1 only), but that one gives up at the first chip that this user may not
/// open.
template <class Chip, class Open, class Label>
Result<Chip, std::string> find_chip(const GpioRequest& request, Open open, Label label)
{
    if (is_path(request.chip)) {
        Chip chip = open(request.chip);
        if (!chip) return Failure{why_no_chip(request, errno)};
        return chip;
    }
    Chip found{};
    std::string found_at;
    int error = ENOENT;
    for (const std::string& path : gpio_chips(request.devices)) {
        Chip chip = open(path);
        if (!chip) {
            if (errno == EACCES || errno == EPERM) error = errno; // it may be that one
            continue;
        }
        if (std::filesystem::path{path}.filename() != request.chip && label(chip) != request.chip) continue;
        if (found) return Failure{why_ambiguous(request, found_at, path)};
        found = std::move(chip);
        found_at = path;
    }
    if (!found) return Failure{why_no_chip(request, error)};
    return found;
}

} // namespace dpslave::io
