// SPDX-License-Identifier: Apache-2.0
#include "gsd_commands.hpp"

#include "gsd_files.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/configurator/configurator.hpp"
#include "dpslave/gsd/type_file.hpp"
#include "dpslave/io/file.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <charconv>
#include <filesystem>

namespace dpslave::dpctl {
namespace {

using Path = std::filesystem::path;

int refused(Terminal& terminal, const std::string& sentence)
{
    fmt::print(terminal.err, "dpctl: {}\n", printable(sentence));
    return kNo;
}

std::optional<std::uint32_t> number_of(std::string_view text)
{
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    if (hex) text.remove_prefix(2);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, hex ? 16 : 10);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

int print(const configurator::Outcome& outcome, Terminal& terminal)
{
    for (const std::string& line : outcome.lines) fmt::print(terminal.out, "{}\n", line);
    for (const std::string& line : outcome.messages) fmt::print(terminal.err, "{}\n", line);
    for (const std::string& sentence : outcome.refusals) refused(terminal, sentence);
    return outcome.exit;
}

const toml::TextSource kDisk = io::read_regular_file;

configurator::Files files_of(const GsdOptions& options)
{
    return {kDisk, options.profiles, io::names_in(options.profiles, ".toml")};
}

// ---- make
// ---------------------------------------------------------------------------------------------------

/// Puts what the command line says over what the mapping says. False: refused, the reason is printed.
class SelectionReader {
public:
    SelectionReader(profile::Mapping& mapping, Terminal& terminal) : into_(mapping), terminal_(terminal) {}

    bool read(const GsdOptions& options)
    {
        profile::Selection& selection = into_.selection;
        if (!options.profile.empty()) into_.profile = options.profile;
        tags("--in", options.in, selection.in);
        tags("--out", options.out, selection.out);
        tags("--in-out", options.in_out, selection.in_out);
        if (options.demand) selection.demand = true;
        if (const auto ident = number("--ident", options.ident, 1))
            selection.ident = static_cast<std::uint16_t>(*ident);
        if (const auto bits = number("--max-tsdr", options.max_tsdr, 11)) selection.max_tsdr = *bits;
        if (!options.description.empty()) selection.description = options.description;
        if (!options.model.empty()) selection.model = options.model;
        return good_;
    }

private:
    std::optional<std::uint32_t> number(const char* option, const std::string& text, std::uint32_t min)
    {
        if (text.empty()) return std::nullopt;
        const auto value = number_of(text);
        if (value && *value >= min && *value <= 0xFFFF) return value;
        refused(terminal_, fmt::format("{} {}: write a number from {} to 65535, decimal or as 0x1649.",
                                       option, text, min));
        good_ = false;
        return std::nullopt;
    }

    void tags(const char* option, const std::vector<std::string>& texts, std::vector<std::uint16_t>& into)
    {
        if (texts.empty()) return;
        into.clear();
        for (const std::string& text : texts)
            if (const auto tag = number(option, text, 1)) into.push_back(static_cast<std::uint16_t>(*tag));
    }

    profile::Mapping& into_;
    Terminal& terminal_;
    bool good_ = true;
};

} // namespace

int gsd_check(const GsdOptions& options, Terminal& terminal)
{
    const auto content = read_file(options.file);
    if (!content) return refused(terminal, options.file + " cannot be read: " + content.error().why + '.');
    return print(configurator::check(*content, options.file, options.strict), terminal);
}

int gsd_show(const GsdOptions& options, Terminal& terminal)
{
    const auto content = read_file(options.file);
    if (!content) return refused(terminal, options.file + " cannot be read: " + content.error().why + '.');
    return print(configurator::show(files_of(options), *content, options.profile, options.table), terminal);
}

int gsd_make(const GsdOptions& options, Terminal& terminal)
{
    profile::Mapping mapping;
    if (!options.mapping.empty()) {
        auto loaded = profile::load_mapping(io::read_regular_file, options.mapping);
        if (!loaded) {
            for (const toml::Fault& fault : loaded.error())
                fmt::print(terminal.err, "{}\n", to_string(fault));
            return kNo;
        }
        mapping = *std::move(loaded);
    }
    if (!SelectionReader{mapping, terminal}.read(options)) return kUsage;
    const configurator::Outcome outcome =
        configurator::make(files_of(options), mapping, options.table, options.output);
    if (const int exit = print(outcome, terminal); exit != kFine) return exit;
    if (options.output.empty()) {
        terminal.out << outcome.octets;
        return kFine;
    }
    if (const auto error = write_file(options.output, outcome.octets, options.force))
        return refused(terminal, options.output + " is not written: " + error->why + '.');
    return kFine;
}

int gsd_types(const GsdOptions& options, Terminal& terminal)
{
    const auto files = gsd::type_files(options.brief ? gsd::TypeName::brief : gsd::TypeName::printed);
    const Path folder{options.output};
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        return refused(terminal, options.output + " is not a folder: create it first, or name another.");
    for (const gsd::TypeFile& file : files)
        if (!options.force &&
            std::filesystem::exists(std::filesystem::symlink_status(folder / file.name, error)))
            return refused(terminal,
                           (folder / file.name).string() +
                               " is there already, so no file is written: choose another folder, or replace "
                               "them with --force.");
    for (const gsd::TypeFile& file : files)
        if (const auto wrong = write_file(folder / file.name, file.content, options.force))
            return refused(terminal, (folder / file.name).string() + " is not written: " + wrong->why + '.');
    return kFine;
}

} // namespace dpslave::dpctl
