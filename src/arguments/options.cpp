// SPDX-License-Identifier: Apache-2.0
#include "dpslave/arguments/options.hpp"

#include "dpslave/base/number.hpp"
#include "dpslave/input/wording.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <utility>

namespace dpslave::arguments {
namespace {

using std::chrono::nanoseconds;

/// An option or an argument whose text `read` has judged before it is taken. An argument has its type as its
/// name.
template <class Take>
CLI::Option* add(CLI::App& app, const std::string& name, const std::string& type, const std::string& help,
                 const Judge& judge, Take take)
{
    CLI::Option* const option = app.add_option_function<std::string>(
        name, [take](const std::string& text) { take(text); }, help);
    if (judge) option->check(CLI::Validator{[judge](std::string& text) { return judge(text); }, ""});
    return option->type_name(name.front() == '-' ? type : "");
}

std::optional<double> read_decimal(const std::string& text)
{
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    return error == std::errc{} && stop == end ? std::optional{number} : std::nullopt;
}

Judge time_judge(TimeLimits limits)
{
    return [limits](const std::string& text) {
        return read_duration(text, limits.least, limits.most)
                   ? std::string{}
                   : fmt::format("{}: write a time from {} to {}, such as 500ms, 10s, 5m or 1h",
                                 input::in_quotes(text), duration_text(limits.least),
                                 duration_text(limits.most));
    };
}

/// The items of a list; the blanks around each are gone.
std::vector<std::string> items_of(const std::string& text, Between between)
{
    std::vector<std::string> items;
    for (const std::string_view item : comma_items(text)) {
        const auto words = blank_words(item);
        if (between == Between::commas || words.empty())
            items.emplace_back(item);
        else
            items.insert(items.end(), words.begin(), words.end());
    }
    return items;
}

} // namespace

CLI::Option* add_time(CLI::App& app, const std::string& name, nanoseconds& into, const std::string& help,
                      TimeLimits limits)
{
    return add(app, name, "TIME", help, time_judge(limits),
               [&into](const std::string& text) { into = read_duration(text).value_or(into); })
        ->default_str(duration_text(into));
}

CLI::Option* add_time(CLI::App& app, const std::string& name, std::optional<nanoseconds>& into,
                      const std::string& help, TimeLimits limits)
{
    return add(app, name, "TIME", help, time_judge(limits),
               [&into](const std::string& text) { into = read_duration(text); });
}

Judge rate_judge(RateLimits limits)
{
    return [limits](const std::string& text) {
        const auto rate = read_rate(text);
        return rate && *rate >= limits.least && *rate <= limits.most
                   ? std::string{}
                   : fmt::format("{}: write a rate from {} to {} bit/s, such as 9600, 187.5k or 1.5M",
                                 input::in_quotes(text), limits.least, limits.most);
    };
}

CLI::Option* add_rate(CLI::App& app, const std::string& name, std::uint32_t& into, const std::string& help,
                      RateLimits limits)
{
    return add(app, name, "RATE", help, rate_judge(limits),
               [&into](const std::string& text) { into = read_rate(text).value_or(into); })
        ->default_str(std::to_string(into));
}

CLI::Option* add_number(CLI::App& app, const std::string& name, std::function<void(std::int64_t)> take,
                        const std::string& help, NumberLimits limits)
{
    const auto judge = [limits](const std::string& text) {
        return read_number(text, limits.least, limits.most)
                   ? std::string{}
                   : fmt::format("{}: write a number from {} to {}", input::in_quotes(text), limits.least,
                                 limits.most);
    };
    return add(app, name, "N", help, judge, [take = std::move(take)](const std::string& text) {
        if (const auto number = read_number(text)) take(*number);
    });
}

CLI::Option* add_decimal(CLI::App& app, const std::string& name, double& into, const std::string& help,
                         DecimalLimits limits)
{
    const auto judge = [limits](const std::string& text) {
        const auto number = read_decimal(text);
        return number && *number >= limits.least && *number <= limits.most
                   ? std::string{}
                   : fmt::format("{}: write a number from {} to {}", input::in_quotes(text), limits.least,
                                 limits.most);
    };
    return add(app, name, "N", help, judge,
               [&into](const std::string& text) { into = read_decimal(text).value_or(into); });
}

Judge choice_judge(std::vector<std::string> legal)
{
    return [legal = std::move(legal)](const std::string& text) {
        for (const std::string& one : legal)
            if (one == text) return std::string{};
        return fmt::format("{}: write {}", input::in_quotes(text), input::listed(legal));
    };
}

CLI::Option* add_choice(CLI::App& app, const std::string& name, std::string& into,
                        const std::vector<std::string>& legal, const std::string& help)
{
    return add(app, name, fmt::format("{}", fmt::join(legal, "|")), help, choice_judge(legal),
               [&into](const std::string& text) { into = text; })
        ->default_str(into);
}

CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& into, const std::string& type,
                      const std::string& help, Judge judge)
{
    return add(app, name, type, help, judge, [&into](const std::string& text) { into = text; })
        ->default_str(into);
}

CLI::Option* add_list(CLI::App& app, const std::string& name, std::vector<std::string>& into,
                      const std::string& type, const std::string& help, Between between, Judge judge)
{
    CLI::Option* const option = app.add_option_function<std::vector<std::string>>(
        name,
        [&into, between](const std::vector<std::string>& texts) {
            into.clear();
            for (const std::string& text : texts)
                for (std::string& item : items_of(text, between)) into.push_back(std::move(item));
        },
        help);
    option->check(CLI::Validator{[judge, between](std::string& text) {
                                     for (const std::string& item : items_of(text, between)) {
                                         if (item.empty())
                                             return input::in_quotes(text) + ": an item of the list is empty";
                                         if (std::string wrong = judge ? judge(item) : std::string{};
                                             !wrong.empty())
                                             return wrong;
                                     }
                                     return std::string{};
                                 },
                                 ""});
    return option->type_name(name.front() == '-' ? type : "");
}

} // namespace dpslave::arguments
