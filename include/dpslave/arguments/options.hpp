// SPDX-License-Identifier: Apache-2.0
/// The kinds of arguments that a command line takes, each with its one reader, one name in the help and one
/// sentence for what it refuses.
#pragma once

#include "dpslave/base/typed.hpp"

#include <chrono>
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace dpslave::arguments {

/// From `least` to `most`, both included.
template <class T>
struct Limits {
    T least, most;
};
using TimeLimits = Limits<std::chrono::nanoseconds>;
using RateLimits = Limits<std::uint32_t>;
using NumberLimits = Limits<std::int64_t>;
using DecimalLimits = Limits<double>;

/// Judges one text. Empty: it is right. Otherwise the sentence that stands behind the name of the option.
using Judge = std::function<std::string(const std::string&)>;

/// A time: 10, 10s, 500ms, 5m, 1h, 3d.
CLI::Option* add_time(CLI::App& app, const std::string& name, std::chrono::nanoseconds& into,
                      const std::string& help, TimeLimits limits);
CLI::Option* add_time(CLI::App& app, const std::string& name, std::optional<std::chrono::nanoseconds>& into,
                      const std::string& help, TimeLimits limits);

/// A rate in bit/s: 187500, 187.5k, 1.5M.
CLI::Option* add_rate(CLI::App& app, const std::string& name, std::uint32_t& into, const std::string& help,
                      RateLimits limits);
/// Judges a rate of a list.
Judge rate_judge(RateLimits limits);

/// A whole number in decimal, or in hexadecimal behind 0x.
CLI::Option* add_number(CLI::App& app, const std::string& name, std::function<void(std::int64_t)> take,
                        const std::string& help, NumberLimits limits);
template <std::integral Number>
CLI::Option* add_number(CLI::App& app, const std::string& name, Number& into, const std::string& help,
                        NumberLimits limits)
{
    return add_number(
        app, name, [&into](std::int64_t number) { into = static_cast<Number>(number); }, help, limits);
}

/// A number with decimals.
CLI::Option* add_decimal(CLI::App& app, const std::string& name, double& into, const std::string& help,
                         DecimalLimits limits);

/// One text of a closed set.
CLI::Option* add_choice(CLI::App& app, const std::string& name, std::string& into,
                        const std::vector<std::string>& legal, const std::string& help);
/// Judges one text of a closed set.
Judge choice_judge(std::vector<std::string> legal);

/// A text of any content, called `type` in the help.
CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& into, const std::string& type,
                      const std::string& help, Judge judge = {});

/// A list, called `type` in the help. Commas stand between its items, with `Between::commas_and_blanks`
/// blanks, too. It may be given several times, and have several words where the command itself takes none.
enum class Between : std::uint8_t { commas, commas_and_blanks };
CLI::Option* add_list(CLI::App& app, const std::string& name, std::vector<std::string>& into,
                      const std::string& type, const std::string& help, Between between, Judge judge = {});

} // namespace dpslave::arguments
