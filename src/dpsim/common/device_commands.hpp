// SPDX-License-Identifier: Apache-2.0
/// What can be typed at any simulated device: values, a list, a log. Faults depend on how it speaks.
#pragma once

#include "device.hpp"

namespace dpslave::sim {

class DeviceCommands {
public:
    explicit DeviceCommands(DeviceLine& line) : line_(line) {}
    virtual ~DeviceCommands() = default;

    /// Carries out one line and returns what is to be said about it.
    std::vector<std::string> command(std::string_view line, Instant now);
    bool quit() const { return quit_; }
    /// Of the commands that every device has.
    static std::vector<std::string> common_help();

protected:
    using Words = std::vector<std::string>;

    virtual std::vector<std::string> help() const = 0;
    virtual std::vector<std::string> stats() = 0;
    /// A command that only this kind of device has.
    virtual std::vector<std::string> special(const Words& words, Instant now) = 0;

    bool is_meant(const Device& device) const { return unit_.empty() || device.address() == unit_; }
    std::vector<Device*> meant();
    /// Puts a displayed value into the tag of every device that is meant. Empty = done.
    std::string set(const Words& words, Instant now);

    static std::vector<std::string> one(std::string sentence); ///< no line if it is empty
    static std::optional<std::uint16_t> tag_number(const Words& words);
    static std::string no_tag(const Words& words);
    static std::string rest_of(const Words& words, std::size_t from);

private:
    std::string choose_unit(const Words& words);
    std::vector<std::string> get(const Words& words, Instant now);
    std::string move(const Words& words, Instant now);
    std::vector<std::string> list(Instant now);

    DeviceLine& line_;
    std::string unit_; ///< empty = all units
    bool quit_ = false;
};

} // namespace dpslave::sim
