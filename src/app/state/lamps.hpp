// SPDX-License-Identifier: Apache-2.0
/// The lamps of all stations: the LED language gives the pattern, the sinks switch the lamps.
#pragma once

#include "dpslave/config/config.hpp"
#include "dpslave/io/led_sink.hpp"
#include "dpslave/led/pattern.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

class Lamps {
public:
    /// From now on those that the configuration names. A lamp that was there before, under whatever name,
    /// goes on without an interruption. One that cannot be opened stays dark: the result says why, a sentence
    /// each.
    std::vector<std::string> exchange(const config::Config& config);

    /// What is the case at this station from now on.
    void set(std::size_t station, const led::Condition& condition);
    /// Switches every lamp as its pattern says at `now`.
    void show(Instant now);
    /// When show() is needed next.
    Instant next_change(Instant now) const;

    const led::Condition& condition(std::size_t station) const { return conditions_[station]; }
    /// Why this lamp stays dark, a sentence; nothing: it can be switched, or none is configured.
    std::optional<std::string> trouble(std::size_t station, const std::string& lamp) const;

private:
    struct Dark {
        std::size_t station = 0;
        std::string lamp, why;
    };
    struct Lamp {
        std::size_t station = 0;
        config::LedConfig config;
        led::Pattern pattern;
        std::unique_ptr<io::LedSink> sink;
    };
    std::filesystem::path sysfs_;
    std::vector<led::Language> languages_;
    std::vector<led::Condition> conditions_;
    std::vector<Lamp> lamps_;
    std::vector<Dark> dark_; ///< those that could not be opened
};

} // namespace dpslave::app
