// SPDX-License-Identifier: Apache-2.0
/// The commands that can be typed at any simulated device: values, a list, a log. Faults depend on how it
/// speaks.
#pragma once

#include "device.hpp"
#include "values.hpp"

namespace dpslave::sim {

class DeviceCommands {
public:
    explicit DeviceCommands(DeviceLine& line) : line_(line) {}
    virtual ~DeviceCommands() = default;

    /// Carries out one line and returns what is to be said about it.
    std::vector<std::string> command(std::string_view line, Instant now);
    bool quit() const { return quit_; }
    /// Returns the help of the commands that every device has.
    static std::vector<std::string> common_help();

protected:
    using Words = std::vector<std::string>;

    virtual std::vector<std::string> help() const = 0;
    virtual std::vector<std::string> stats() = 0;
    /// A command that only this kind of device has.
    virtual std::vector<std::string> special(const Words& words, Instant now) = 0;

    /// The devices that `unit` has chosen. Precondition: all devices of the line are of the type `Unit`.
    template <class Unit = Device>
    std::vector<Unit*> chosen()
    {
        std::vector<Unit*> units;
        for (Device* const device : line_.devices())
            if (unit_.empty() || device->address() == unit_) units.push_back(static_cast<Unit*>(device));
        return units;
    }
    /// change(device, parameter) for the tag in words[1], of each device that is chosen and has it. The first
    /// sentence that is not empty ends it and is returned; empty = done.
    template <class Unit = Device, class Change>
    std::string change_tag(const Words& words, Change&& change)
    {
        const auto number = number_at(words, 1, 0, 0xFFFF);
        bool found = false;
        for (Unit* const unit : chosen<Unit>()) {
            SimParameter* const parameter =
                number ? unit->find(static_cast<std::uint16_t>(*number)) : nullptr;
            if (parameter == nullptr) continue;
            found = true;
            if (std::string wrong = change(*unit, *parameter); !wrong.empty()) return wrong;
        }
        return found ? std::string{} : no_tag(words);
    }
    /// The fault that `words` set, of those that all devices have; a sentence if there is none.
    static std::string read_fault(const Words& words, DeviceFaults& faults);

    static std::vector<std::string> one(std::string sentence); ///< no line if it is empty
    static std::string no_value(const SimParameter& parameter, const std::string& text);

private:
    static std::string no_tag(const Words& words);
    std::string set(const Words& words, Instant now);
    std::string choose_unit(const Words& words);
    std::vector<std::string> get(const Words& words, Instant now);
    std::string move(const Words& words, Instant now);
    std::vector<std::string> list(Instant now);

    DeviceLine& line_;
    std::string unit_; ///< empty = all units
    bool quit_ = false;
};

} // namespace dpslave::sim
