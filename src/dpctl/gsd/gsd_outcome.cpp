// SPDX-License-Identifier: Apache-2.0
#include "gsd_outcome.hpp"

#include "dpslave/base/number.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/io/file.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

using configurator::Outcome;

const input::TextSource kDisk = io::read_regular_file; ///< configurator::Files refers to it

/// What dpctl has for a finding. The page shows the same sentences, so they cannot name it.
constexpr struct {
    std::string_view code, hint;
} kHints[] = {
    {"ident_missing", "Give the Ident_Number with --ident."},
    {"no_mapping", "Choose parameters with --in, --out or --order, Demand Data with --demand."},
    {"no_parameters", "Choose parameters with --in, --out or --order."},
    {"tag_not_listed", "Look for the tag with dpctl tag --profile NAME."},
    {"max_tsdr", "Make the file with dpctl gsd make --max-tsdr."},
    {"measured", "Run dpctl tune: it says which MaxTsdr this machine needs."},
    {"no_scale", "Run dpctl survey: it makes the rows of a tag table."},
};

void print_hints(const Outcome& outcome, std::ostream& err)
{
    const Json findings = Json::parse(outcome.facts, nullptr, false).value("findings", Json::array());
    for (const auto& each : kHints)
        if (std::any_of(findings.begin(), findings.end(),
                        [&](const Json& finding) { return finding.value("code", "") == each.code; }))
            fmt::print(err, "{}\n", each.hint);
}

} // namespace

void add_keys(CLI::App& app, KeyOptions& options)
{
    add_text(app, "--tags-at", options.tags_at, "N",
             "The octet of User_Prm_Data where the tags begin, from 0, as tags_at of the station");
    add_list(app, "--identifiers", options.identifiers, "HEX,...",
             "Identifiers in hexadecimal, as identifiers of the station: 52,60 or \"C0 40 40\"",
             Between::commas);
}

void add_own_table(CLI::App& app, std::string& table)
{
    add_text(app, "--table", table, "FILE", "Your own tag table (CSV); the GSD file gets its names");
}

void add_modules(CLI::App& app, std::vector<std::string>& modules, const char* help)
{
    add_list(app, "--modules", modules, "NAME,...", help, Between::commas);
}

void read_keys(const KeyOptions& options, profile::Selection& selection, Outcome& outcome)
{
    if (!options.ident.empty()) {
        const TypedIdent ident = read_ident(options.ident);
        if (ident.number) selection.ident = ident.number;
        if (!ident.number) refuse(outcome, "--ident: " + ident.fault + '.');
    }
    if (const auto at = read_limited("--tags-at", options.tags_at, 0, outcome)) selection.tags_at = *at;
    if (!options.identifiers.empty()) selection.identifiers.clear();
    for (const std::string& text : options.identifiers)
        if (const auto identifier = profile::read_identifier(text))
            selection.identifiers.push_back(*identifier);
        else
            refuse(outcome, "--identifiers " + identifier.error());
}

std::optional<std::uint32_t> read_limited(const char* option, const std::string& text, std::uint32_t least,
                                          Outcome& outcome)
{
    if (text.empty()) return std::nullopt;
    if (const auto value = read_number(text, least, 0xFFFF)) return static_cast<std::uint32_t>(*value);
    refuse(outcome,
           fmt::format("{} {}: write a number from {} to 65535, decimal or as 0x1649.", option, text, least));
    return std::nullopt;
}

std::optional<profile::Mapping> read_mapping(const std::string& file, Outcome& outcome)
{
    if (file.empty()) return profile::Mapping{};
    auto loaded = profile::load_mapping(kDisk, file);
    if (loaded) return *std::move(loaded);
    for (const input::Fault& fault : loaded.error()) outcome.messages.push_back(to_string(fault));
    outcome.exit = kNo;
    return std::nullopt;
}

Outcome refused(std::string sentence, int exit)
{
    return {.exit = exit, .refusals = {std::move(sentence)}};
}

void refuse(Outcome& outcome, std::string why)
{
    outcome.refusals.push_back(std::move(why));
    outcome.exit = kUsage;
}

configurator::Files files_of(const std::string& profiles)
{
    return {kDisk, profiles, io::names_in(profiles, ".toml")};
}

int print_outcome(const Outcome& outcome, Session& session)
{
    if (session.json()) {
        session.print(Json::parse(configurator::reply_of(outcome), nullptr, false), {});
        return outcome.exit;
    }
    std::ostream &out = session.terminal().out, &err = session.terminal().err;
    for (const std::string& line : outcome.lines) fmt::print(out, "{}\n", line);
    for (const std::string& line : outcome.messages) fmt::print(err, "{}\n", line);
    for (const std::string& sentence : outcome.refusals) fmt::print(err, "dpctl: {}\n", printable(sentence));
    print_hints(outcome, err);
    out << outcome.octets;
    return outcome.exit;
}

int write_and_print(Outcome outcome, const OutputOption& options, Session& session)
{
    if (options.output.empty()) return print_outcome(outcome, session);
    if (outcome.exit == kFine)
        if (const auto error = write_file(options.output, outcome.octets, options.force)) {
            outcome.exit = kNo;
            outcome.refusals.push_back(options.output + " is not written: " + error->why + '.');
        }
    if (!session.json()) outcome.octets.clear();
    return print_outcome(outcome, session);
}

} // namespace dpslave::dpctl
