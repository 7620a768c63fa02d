// SPDX-License-Identifier: Apache-2.0
#include "help.hpp"

#include "dpslave/base/typed.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <utility>

namespace dpslave::arguments {
namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kNames = 26; ///< where the explanation of an option begins

/// The words of `text` behind `first`, which is not broken; each further line begins with `indent` blanks.
/// `ending` stands at the end of a line that goes on.
std::string wrapped(std::string first, std::string_view text, std::size_t indent,
                    std::string_view ending = {})
{
    std::string out, line = std::move(first);
    bool has_word = false;
    for (const std::string_view word : blank_words(text)) {
        if (has_word && line.size() + 1 + word.size() + ending.size() > kWidth) {
            out += line + std::string{ending} + '\n';
            line.assign(indent, ' ');
            has_word = false;
        }
        line += (has_word ? " " : "") + std::string{word};
        has_word = true;
    }
    return out + line + '\n';
}

/// A name, and what it is beside it, or below a name that is too long.
std::string entry(const std::string& name, const std::string& text)
{
    std::string first = "  " + name;
    if (text.empty()) return first + '\n';
    if (first.size() + 2 > kNames) return first + '\n' + wrapped(std::string(kNames, ' '), text, kNames);
    first.resize(kNames, ' ');
    return wrapped(std::move(first), text, kNames);
}

bool is_command(std::string_view line)
{
    const auto words = blank_words(line);
    return line.starts_with(' ') && !words.empty() &&
           (words[0] == "dpctl" || words[0] == "dpsim" || words[0] == "dpslaved");
}

/// Where the text of "  1  the answer is no" begins; of a line in one piece `begin`.
std::size_t text_column(std::string_view line, std::size_t begin)
{
    constexpr std::size_t kMost = 50;
    const std::size_t gap = line.find("  ", begin);
    const std::size_t text = gap == std::string_view::npos ? gap : line.find_first_not_of(' ', gap);
    return text <= kMost ? text : begin;
}

std::string fitted_line(std::string_view line)
{
    if (line.size() <= kWidth) return std::string{line} + '\n';
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    if (!is_command(line)) {
        const std::size_t text = text_column(line, begin);
        return wrapped(std::string{line.substr(0, text)}, line.substr(text), text);
    }
    const std::size_t gap = line.find("   ", begin);
    const std::string command =
        wrapped(std::string(begin, ' '), line.substr(begin, gap - begin), begin + 4, " \\");
    if (gap == std::string_view::npos) return command;
    return command + wrapped(std::string(begin + 4, ' '), line.substr(gap), begin + 4);
}

/// CLI11's own formatter with lines that fit.
class Formatter final : public CLI::Formatter {
public:
    Formatter()
    {
        label("SUBCOMMAND", "COMMAND");
        label("SUBCOMMANDS", "COMMAND");
        label("Positionals", "Arguments");
    }
    std::string make_option(const CLI::Option* option, bool is_positional) const override
    {
        std::string name = make_option_name(option, is_positional);
        std::replace(name.begin(), name.end(), ',', ' ');
        name = is_positional ? name : with_comma(name);
        if (option->get_type_size() != 0 && !option->get_type_name().empty())
            name += ' ' + option->get_type_name();
        std::string text = option->get_description();
        if (option->get_required() && !is_positional)
            text += " (required)";
        else if (!option->get_default_str().empty())
            text += " (default: " + option->get_default_str() + ')';
        return entry(name, text);
    }
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override
    {
        std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
        for (std::size_t at = 0; (at = help.find("\n\n\n", at)) != std::string::npos;) help.erase(at, 1);
        return help;
    }
    std::string make_subcommand(const CLI::App* command) const override
    {
        return entry(command->get_name(), command->get_description());
    }
    std::string make_description(const CLI::App* app) const override
    {
        return fitted(app->get_description()) + '\n';
    }
    std::string make_footer(const CLI::App* app) const override { return fitted(app->get_footer()); }

private:
    static std::string with_comma(const std::string& names)
    {
        const auto blank = names.find(' ');
        return blank == std::string::npos ? names : names.substr(0, blank) + ',' + names.substr(blank);
    }
};

} // namespace

std::string fitted(std::string_view text)
{
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        out += fitted_line(text.substr(at, end - at));
        at = end + 1;
    }
    return out;
}

std::shared_ptr<CLI::FormatterBase> help_formatter()
{
    return std::make_shared<Formatter>();
}

} // namespace dpslave::arguments
