// SPDX-License-Identifier: Apache-2.0
#include "gsd_commands.hpp"

#include "dpctl/tags/tag_search.hpp"
#include "gsd_files.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/configurator/configurator.hpp"
#include "dpslave/gsd/check.hpp"
#include "dpslave/gsd/identifier.hpp"
#include "dpslave/gsd/io_map.hpp"
#include "dpslave/gsd/type_file.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/profile/gsd_device.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
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
    return outcome.exit;
}

/// "FILE:12: warning: sentence", as compilers do.
void print(std::ostream& out, const std::string& file, const gsd::Finding& finding)
{
    const std::string place = finding.line > 0 ? fmt::format("{}:{}", file, finding.line) : file;
    fmt::print(out, "{}: {}: {}\n", place, finding.severity == gsd::Severity::error ? "error" : "warning",
               printable(finding.what));
}

std::string summary(const gsd::Findings& findings)
{
    std::size_t errors = 0;
    for (const gsd::Finding& finding : findings) errors += finding.severity == gsd::Severity::error ? 1 : 0;
    const std::size_t warnings = findings.size() - errors;
    if (findings.empty()) return "no errors and no warnings";
    return fmt::format("{} error{}, {} warning{}", errors, errors == 1 ? "" : "s", warnings,
                       warnings == 1 ? "" : "s");
}

bool any_error(const gsd::Findings& findings)
{
    for (const gsd::Finding& finding : findings)
        if (finding.severity == gsd::Severity::error) return true;
    return false;
}

std::optional<profile::Profile> load(const std::string& folder, const std::string& name, Terminal& terminal)
{
    if (name.empty() || name.find('/') != std::string::npos) {
        refused(terminal, name.empty() ? "--profile is missing: name the device that the file is for."
                                       : "--profile is a name such as 590; the folder goes to --profiles.");
        return std::nullopt;
    }
    auto profile = profile::load_profile(io::read_regular_file, folder, name);
    if (profile) return *std::move(profile);
    for (const toml::Fault& fault : profile.error()) fmt::print(terminal.err, "{}\n", to_string(fault));
    const auto names = io::names_in(folder, ".toml");
    if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end())
        fmt::print(terminal.err, "dpctl: the profiles there: {}\n", fmt::join(names, ", "));
    return std::nullopt;
}

/// The names of a tag table of the user; nothing, and it was said why, if it cannot be read.
std::optional<drive::TagTable> own_table(const std::string& file, Terminal& terminal)
{
    TagFiles tables = load_table(file);
    for (const std::string& fault : tables.faults) fmt::print(terminal.err, "dpctl: {}\n", fault);
    if (tables.files.empty() || !tables.faults.empty()) return std::nullopt;
    return std::move(tables.files.front().tags);
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

void print_advice(const gsd::Document& document, Terminal& terminal)
{
    for (const std::string& advice : gsd::io_map(document, {}).advice)
        fmt::print(terminal.err, "warning: {}\n", printable(advice));
}

// ---- show
// ---------------------------------------------------------------------------------------------------

void print_direction(std::ostream& out, const char* title, const std::vector<gsd::IoValue>& values,
                     std::size_t octets)
{
    fmt::print(out, "\n{}: {} octets, {} words\n", title, octets, octets / 2);
    if (values.empty()) return;
    std::size_t behind = 0; // octets of Demand Data
    for (const gsd::IoValue& value : values) behind += value.is_demand ? value.octets : 0;
    fmt::print(out, "  {:<9} {:<7} {:<6} {}\n", "octets", "word", "tag", "value");
    for (const gsd::IoValue& value : values) {
        const std::size_t last = value.octet + value.octets - 1;
        const std::string place =
            last == value.octet ? std::to_string(last) : fmt::format("{}-{}", value.octet, last);
        // As dpctl io and dpsim count: from 1, behind Demand Data, whose registers count by themselves.
        const std::size_t first = (value.octet - (value.is_demand ? 0 : behind)) / 2 + 1;
        const std::size_t end = (last - (value.is_demand ? 0 : behind)) / 2 + 1;
        const std::string word = (value.is_demand ? "D" : "") +
                                 (first == end ? std::to_string(first) : fmt::format("{}-{}", first, end));
        fmt::print(out, "  {:<9} {:<7} {:<6} {}\n", place, word, value.tag ? std::to_string(*value.tag) : "-",
                   printable(value.what));
    }
}

void print_modules(std::ostream& out, const gsd::Document& document)
{
    fmt::print(out, "\nThe master's tool combines these modules, {} at most; their order gives the map:\n",
               document.number("Max_Module").value_or(0));
    for (const gsd::Module& module : document.modules) {
        const auto sum = gsd::sum_of_identifiers(module.identifiers);
        fmt::print(out, "  {:<32} {:>3} octets in {:>3} out\n", printable(module.name), sum ? sum->in : 0,
                   sum ? sum->out : 0);
    }
}

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
    const gsd::Document document = gsd::parse(*content);
    const gsd::Findings findings = gsd::check(document, gsd::Reading::tolerant);
    if (any_error(findings))
        fmt::print(terminal.err, "warning: the file has {}: see dpctl gsd check.\n", summary(findings));
    if (!document.has_section) return kNo;

    gsd::MapHints hints;
    if (!options.profile.empty()) {
        const auto profile = load(options.profiles, options.profile, terminal);
        if (!profile) return kNo;
        hints.tags_at = profile->personality.prm.tags_at;
        hints.demand_identifier = profile->personality.demand_identifier;
        hints.extended_tags = profile->personality.demand == dp::DemandForm::extended;
        for (const drive::Tag& tag : profile->tags.all()) hints.names.emplace(tag.number, tag.name);
    }
    if (!options.table.empty()) {
        const auto table = own_table(options.table, terminal);
        if (!table) return kNo;
        for (const drive::Tag& tag : table->all()) hints.names[tag.number] = tag.name;
    }
    const gsd::IoMap map = gsd::io_map(document, hints);
    fmt::print(terminal.out, "{}, {}, Ident_Number 0x{:04X}\n", printable(document.text("Vendor_Name")),
               printable(document.text("Model_Name")), document.number("Ident_Number").value_or(0));
    if (const std::string text = document.text("Info_Text"); !text.empty())
        fmt::print(terminal.out, "{}\n", printable(text));
    if (map.fixed) {
        print_direction(terminal.out, "Inputs, from the slave to the master", map.inputs, map.in_octets);
        print_direction(terminal.out, "Outputs, from the master to the slave", map.outputs, map.out_octets);
        fmt::print(terminal.out, "\noctets: places in the Data_Exchange telegram, counted from 0\n"
                                 "word: counted from 1 after Demand Data, as dpctl io and dpsim do; D1 to "
                                 "D4 are Demand Data\n");
    } else {
        print_modules(terminal.out, document);
    }
    for (const std::string& advice : map.advice) fmt::print(terminal.err, "warning: {}\n", printable(advice));
    return kFine;
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
    auto profile = load(options.profiles, mapping.profile, terminal);
    if (!profile) return mapping.profile.empty() ? kUsage : kNo;
    if (!options.table.empty()) {
        auto table = own_table(options.table, terminal);
        if (!table) return kNo;
        profile->tags = *std::move(table);
    }

    const auto made = profile::device_of(*profile, mapping.selection);
    if (!made) {
        for (const std::string& sentence : made.error()) refused(terminal, sentence);
        return kNo;
    }
    const std::string content = gsd::write(made->device);
    const gsd::Document document = gsd::parse(content);
    for (const std::string& warning : made->warnings)
        fmt::print(terminal.err, "warning: {}\n", printable(warning));
    print_advice(document, terminal);
    if (options.output.empty()) {
        terminal.out << content;
        return kFine;
    }
    const std::string name = Path{options.output}.filename().string();
    for (const gsd::Finding& finding : gsd::check(document, gsd::Reading::tolerant, name))
        print(terminal.err, options.output, finding);
    if (const auto error = write_file(options.output, content, options.force))
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
