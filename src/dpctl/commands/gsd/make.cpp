// SPDX-License-Identifier: Apache-2.0
#include "dpctl/commands/commands.hpp"
#include "dpctl/gsd/gsd_outcome.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

using configurator::Outcome;

struct GsdMakeOptions : ProfilesOption, OutputOption {
    std::string profile;
    std::string table;                              ///< a CSV file
    std::string mapping;                            ///< a file with a selection
    std::vector<std::string> in, out, in_out, tags; ///< tags
    std::vector<std::string> order;                 ///< "in:1"
    KeyOptions keys;
    bool demand = false;
    std::string max_tsdr, description, model;
};

void add_directions(CLI::App& app, GsdMakeOptions& options)
{
    const auto add_tags = [&](const char* name, std::vector<std::string>& tags, const char* help) {
        add_list(app, name, tags, "LIST", help, Between::commas_and_blanks);
    };
    add_tags("--in", options.in,
             "Inputs: tags that the master reads, in the order of the telegram: 55-57,60");
    add_tags("--out", options.out, "Outputs: tags that the master writes");
    add_tags("--in-out", options.in_out, "Both: tags that it reads and writes, after those");
    add_list(
        app, "--order", options.order, "in:TAG,out:TAG,in-out:TAG,...",
        "Parameters of all directions in the order of the telegram, instead of --in, --out, --in-out; none: no parameter, for Demand Data alone",
        Between::commas_and_blanks);
    add_tags("--tags", options.tags,
             "Tags whose directions the modules of the master's project say, instead of all others");
}

void set_up(CLI::App& app, GsdMakeOptions& options)
{
    add_profile(app, options.profile, "Profile of the device");
    add_profiles(app, options, "Folder of the device profiles");
    add_own_table(app, options.table);
    add_text(
        app, "--mapping", options.mapping, "FILE",
        "A TOML file with profile, list, in, out, in_out, tags, demand, ident, max_tsdr, description, model, tags_at, identifiers, [[module]], [table]; the command line overrides it");
    add_directions(app, options);
    add_keys(app, options.keys);
    app.add_flag("--demand", options.demand, "Put Demand Data before the parameters");
    add_text(app, "--ident", options.keys.ident, "N",
             "Ident_Number: 0x1649; required if the profile has none");
    add_text(
        app, "--max-tsdr", options.max_tsdr, "N",
        "MaxTsdr in bit times, as [bus] max_tsdr of the daemon: if this machine needs more than the profile");
    add_text(app, "--description", options.description, "TEXT",
             "What the file is for, 256 characters at most (Info_Text)");
    add_text(app, "--model", options.model, "TEXT",
             "Name in the master's device list, 32 characters at most");
    add_output(app, options.output, "File to write; default: standard output");
    app.add_flag("--force", options.force, "Replace an existing file");
}

/// Puts what the command line says over what the mapping says. What is refused goes to the outcome.
class SelectionReader {
public:
    SelectionReader(profile::Mapping& mapping, Outcome& outcome) : into_(mapping), outcome_(outcome) {}

    void read(const GsdMakeOptions& options)
    {
        profile::Selection& selection = into_.selection;
        if (!options.profile.empty()) into_.profile = options.profile;
        using profile::Direction;
        tags("--in", options.in, Direction::in, selection.in);
        tags("--out", options.out, Direction::out, selection.out);
        tags("--in-out", options.in_out, Direction::in_out, selection.in_out);
        list(options.order, selection);
        open_tags(options.tags, selection);
        read_keys(options.keys, selection, outcome_);
        if (options.demand) selection.demand = true;
        if (const auto bits = read_limited("--max-tsdr", options.max_tsdr, 11, outcome_))
            selection.max_tsdr = *bits;
        if (!options.description.empty()) selection.description = options.description;
        if (!options.model.empty()) selection.model = options.model;
        if (!options.order.empty() && !(options.in.empty() && options.out.empty() && options.in_out.empty()))
            refuse(outcome_,
                   "--order stands instead of --in, --out and --in-out: leave them out, or --order.");
    }

private:
    /// Numbers and ranges of tags, in their order.
    void read_all(const char* option, const std::vector<std::string>& texts, std::vector<std::uint16_t>& into)
    {
        for (const std::string& text : texts) {
            const auto dash = text.find('-', 1);
            const auto first = read_limited(option, text.substr(0, dash), 1, outcome_);
            const auto last =
                dash == std::string::npos ? first : read_limited(option, text.substr(dash + 1), 1, outcome_);
            if (!first || !last) continue;
            if (*first > *last)
                refuse(outcome_,
                       fmt::format("{} {}: the first tag is above the last one: swap them.", option, text));
            for (auto tag = *first; tag <= *last; ++tag) into.push_back(static_cast<std::uint16_t>(tag));
        }
    }

    /// In place of what the mapping has of this direction.
    void tags(const char* option, const std::vector<std::string>& texts, profile::Direction direction,
              std::vector<std::uint16_t>& into)
    {
        if (texts.empty()) return;
        into.clear();
        if (into_.selection.list)
            std::erase_if(*into_.selection.list, [&](const auto& one) { return one.direction == direction; });
        read_all(option, texts, into);
    }

    /// In place of all that the mapping has.
    void open_tags(const std::vector<std::string>& texts, profile::Selection& selection)
    {
        if (texts.empty()) return;
        selection.in = selection.out = selection.in_out = {};
        selection.list.reset();
        selection.tags.emplace();
        read_all("--tags", texts, *selection.tags);
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
                refuse(
                    outcome_,
                    "--order " + text +
                        ": write in:1, out:1 or in-out:1, with the number of the tag for 1; or none alone.");
        }
    }

    profile::Mapping& into_;
    Outcome& outcome_;
};

int run(const GsdMakeOptions& options, Session& session)
{
    Outcome outcome;
    auto mapping = read_mapping(options.mapping, outcome);
    if (mapping) SelectionReader{*mapping, outcome}.read(options);
    if (outcome.exit == kFine)
        outcome = configurator::make(files_of(options.profiles), *mapping, options.table, options.output);
    return write_and_print(std::move(outcome), options, session);
}

} // namespace

const Command kGsdMake{
    "gsd make",           kOffline,    "Writes the GSD file of a device, as it is or with your own mapping",
    add<GsdMakeOptions>,  "",          "",
    "1 a file is faulty", Asks::nobody};

} // namespace dpslave::dpctl
