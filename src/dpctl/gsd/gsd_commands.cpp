// SPDX-License-Identifier: Apache-2.0
#include "gsd_commands.hpp"

#include "dpctl/cli/words.hpp"
#include "gsd_files.hpp"
#include "gsd_page.hpp"
#include "gsd_station.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/configurator/configurator.hpp"
#include "dpslave/gsd/type_file.hpp"
#include "dpslave/io/file.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace dpslave::dpctl {
namespace {

using Path = std::filesystem::path;

using configurator::Outcome;

Outcome refused(std::string sentence, int exit = kNo)
{
    return {.exit = exit, .refusals = {std::move(sentence)}};
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

/// What dpctl has for a finding. The page shows the same sentences, so they cannot name it.
constexpr struct {
    std::string_view code, hint;
} kHints[] = {
    {"ident_missing", "Give the Ident_Number with --ident."},
    {"no_mapping", "Choose parameters with --in, --out or --list, Demand Data with --demand."},
    {"no_parameters", "Choose parameters with --in, --out or --list."},
    {"tag_not_listed", "Look for the tag with dpctl tag --profile NAME."},
    {"max_tsdr", "Make the file with dpctl gsd make --max-tsdr."},
    {"measured", "Run dpctl tune: it says which MaxTsdr this machine needs."},
    {"no_scale", "Run dpctl survey: it makes the rows of a tag table."},
};

void print_hints(const Outcome& outcome, Terminal& terminal)
{
    const Json findings = Json::parse(outcome.facts, nullptr, false).value("findings", Json::array());
    for (const auto& each : kHints)
        if (std::any_of(findings.begin(), findings.end(),
                        [&](const Json& finding) { return finding.value("code", "") == each.code; }))
            fmt::print(terminal.err, "{}\n", each.hint);
}

int print(const Outcome& outcome, const GsdOptions& options, Terminal& terminal)
{
    if (options.json) {
        terminal.out << json_text(Json::parse(configurator::reply_of(outcome), nullptr, false)) << '\n';
        return outcome.exit;
    }
    for (const std::string& line : outcome.lines) fmt::print(terminal.out, "{}\n", line);
    for (const std::string& line : outcome.messages) fmt::print(terminal.err, "{}\n", line);
    for (const std::string& sentence : outcome.refusals)
        fmt::print(terminal.err, "dpctl: {}\n", printable(sentence));
    print_hints(outcome, terminal);
    if (options.output.empty()) terminal.out << outcome.octets;
    return outcome.exit;
}

/// The file that was asked for goes where the command line says.
int write_and_print(Outcome outcome, const GsdOptions& options, Terminal& terminal)
{
    if (outcome.exit == kFine && !options.output.empty())
        if (const auto error = write_file(options.output, outcome.octets, options.force)) {
            outcome.exit = kNo;
            outcome.refusals.push_back(options.output + " is not written: " + error->why + '.');
        }
    return print(outcome, options, terminal);
}

/// `use` of the content of a file, or why it cannot be read.
template <class Use>
Outcome with_file(const std::string& file, const Use& use)
{
    const auto content = read_file(file);
    return content ? use(*content) : refused(file + " cannot be read: " + content.error().why + '.');
}

const toml::TextSource kDisk = io::read_regular_file;

configurator::Files files_of(const GsdOptions& options)
{
    return {kDisk, options.profiles, io::names_in(options.profiles, ".toml")};
}

// ---- make
// ---------------------------------------------------------------------------------------------------

/// Puts what the command line says over what the mapping says. False: refused, `outcome` has the reasons.
class SelectionReader {
public:
    SelectionReader(profile::Mapping& mapping, Outcome& outcome) : into_(mapping), outcome_(outcome) {}

    bool read(const GsdOptions& options)
    {
        profile::Selection& selection = into_.selection;
        if (!options.profile.empty()) into_.profile = options.profile;
        using profile::Direction;
        tags("--in", options.in, Direction::in, selection.in);
        tags("--out", options.out, Direction::out, selection.out);
        tags("--in-out", options.in_out, Direction::in_out, selection.in_out);
        list(options.list, selection);
        if (options.demand) selection.demand = true;
        if (const auto ident = number("--ident", options.ident, 1))
            selection.ident = static_cast<std::uint16_t>(*ident);
        if (const auto bits = number("--max-tsdr", options.max_tsdr, 11)) selection.max_tsdr = *bits;
        if (!options.description.empty()) selection.description = options.description;
        if (!options.model.empty()) selection.model = options.model;
        if (!options.list.empty() && !(options.in.empty() && options.out.empty() && options.in_out.empty()))
            refuse("--list stands instead of --in, --out and --in-out: leave them out, or --list.");
        return outcome_.exit == kFine;
    }

private:
    std::optional<std::uint32_t> number(const char* option, const std::string& text, std::uint32_t min)
    {
        if (text.empty()) return std::nullopt;
        const auto value = number_of(text);
        if (value && *value >= min && *value <= 0xFFFF) return value;
        refuse(
            fmt::format("{} {}: write a number from {} to 65535, decimal or as 0x1649.", option, text, min));
        return std::nullopt;
    }

    void refuse(const std::string& sentence)
    {
        outcome_.refusals.push_back(sentence);
        outcome_.exit = kUsage;
    }

    /// In place of what the mapping has of this direction.
    void tags(const char* option, const std::vector<std::string>& texts, profile::Direction direction,
              std::vector<std::uint16_t>& into)
    {
        if (texts.empty()) return;
        into.clear();
        if (into_.selection.list)
            std::erase_if(*into_.selection.list, [&](const auto& one) { return one.direction == direction; });
        for (const std::string& text : texts)
            if (const auto tag = number(option, text, 1)) into.push_back(static_cast<std::uint16_t>(*tag));
    }

    /// In place of all that the mapping has.
    void list(const std::vector<std::string>& texts, profile::Selection& selection)
    {
        if (texts.empty()) return;
        selection.in = selection.out = selection.in_out = {};
        selection.list.emplace();
        if (texts == std::vector<std::string>{"none"}) return;
        for (const std::string& text : texts) {
            if (const auto parameter = profile::parse_parameter(text))
                selection.list->push_back(*parameter);
            else
                refuse("--list " + text +
                       ": write in:1, out:1 or in-out:1, with the number of the tag for 1; or none alone.");
        }
    }

    profile::Mapping& into_;
    Outcome& outcome_;
};

/// Nothing: `outcome` has the faults.
std::optional<profile::Mapping> mapping_of(const GsdOptions& options, Outcome& outcome)
{
    profile::Mapping mapping;
    if (!options.mapping.empty()) {
        auto loaded = profile::load_mapping(kDisk, options.mapping);
        if (!loaded) {
            for (const toml::Fault& fault : loaded.error()) outcome.messages.push_back(to_string(fault));
            outcome.exit = kNo;
            return std::nullopt;
        }
        mapping = *std::move(loaded);
    }
    if (!SelectionReader{mapping, outcome}.read(options)) return std::nullopt;
    return mapping;
}

Outcome write_types(const GsdOptions& options)
{
    const auto files = gsd::type_files(options.brief ? gsd::TypeName::brief : gsd::TypeName::printed);
    const Path folder{options.output};
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        return refused(options.output + " is not a folder: create it first, or name another.");
    for (const gsd::TypeFile& file : files)
        if (!options.force &&
            std::filesystem::exists(std::filesystem::symlink_status(folder / file.name, error)))
            return refused((folder / file.name).string() +
                           " is there already, so no file is written: choose another folder, or replace "
                           "them with --force.");
    for (const gsd::TypeFile& file : files)
        if (const auto wrong = write_file(folder / file.name, file.content, options.force))
            return refused((folder / file.name).string() + " is not written: " + wrong->why + '.');
    return {};
}

int check_with_station(const GsdOptions& options, Terminal& terminal)
{
    Options daemon = options.daemon;
    daemon.station_is_option = true;
    const auto fetched = fetch_station(daemon, terminal);
    if (!fetched) return fetched.error();
    std::string table = options.table; // the station's own, where it is on this machine
    if (table.empty() && io::read_regular_file(fetched->tag_table)) table = fetched->tag_table;
    const auto judge = [&](const std::string& content) {
        return configurator::check_with_station(files_of(options), content, options.file, options.strict,
                                                fetched->station, table);
    };
    return print(with_file(options.file, judge), options, terminal);
}

} // namespace

int gsd_check(const GsdOptions& options, Terminal& terminal)
{
    if (!options.daemon.station.empty()) return check_with_station(options, terminal);
    const auto judge = [&](const std::string& content) {
        return configurator::check(content, options.file, options.strict);
    };
    return print(with_file(options.file, judge), options, terminal);
}

int gsd_show(const GsdOptions& options, Terminal& terminal)
{
    const auto map = [&](const std::string& content) {
        return configurator::show(files_of(options), content, options.profile, options.table);
    };
    return print(with_file(options.file, map), options, terminal);
}

int gsd_import(const GsdOptions& options, Terminal& terminal)
{
    const auto import = [&](const std::string& content) {
        return configurator::import_file(files_of(options), content, options.profile, options.table);
    };
    return write_and_print(with_file(options.file, import), options, terminal);
}

int gsd_diff(const GsdOptions& options, Terminal& terminal)
{
    const auto compare = [&](const std::string& left) {
        return with_file(options.other, [&](const std::string& right) {
            return configurator::diff(files_of(options), left, right, options.profile, options.table);
        });
    };
    return print(with_file(options.file, compare), options, terminal);
}

int gsd_make(const GsdOptions& options, Terminal& terminal)
{
    Outcome outcome;
    if (const auto mapping = mapping_of(options, outcome))
        outcome = configurator::make(files_of(options), *mapping, options.table, options.output);
    return write_and_print(std::move(outcome), options, terminal);
}

int gsd_configure(const GsdOptions& options, Terminal& terminal)
{
    return print(open_page(options.page), options, terminal);
}

int gsd_types(const GsdOptions& options, Terminal& terminal)
{
    return print(write_types(options), options, terminal);
}

} // namespace dpslave::dpctl
