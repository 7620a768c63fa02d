// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/tags/render_tags.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

struct TagOptions : ProfilesOption {
    std::vector<std::string> words;
    bool all = false;    ///< also names that say more than the query
    std::string table;   ///< a CSV file; empty = not said
    std::string profile; ///< empty = not said
};

void set_up(CLI::App& app, TagOptions& options)
{
    app.add_option("WHAT", options.words,
                   "A tag number (270, 0x10E), or words of its name; a number belongs to the word before it")
        ->type_name("");
    app.add_flag("--all", options.all, "Also find names that contain more than WHAT");
    auto* table = add_text(app, "--table", options.table, "FILE", "Search only this CSV file");
    add_profile(app, options.profile, "Search only the table of this profile");
    add_profiles(app, options);
    table->excludes("--profile");
}

TagFiles load(const TagOptions& options)
{
    if (!options.table.empty()) return load_table(options.table);
    if (!options.profile.empty()) return load_table_of(options.profiles, options.profile);
    return load_tables(options.profiles);
}

int run(const TagOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    const TagFiles tables = load(options);
    for (const std::string& fault : tables.faults) terminal.err << "dpctl: " << fault << '\n';
    if (tables.files.empty()) {
        if (tables.faults.empty())
            terminal.err << "dpctl: there is no tag table in " << options.profiles << "/../tags\n";
        return kNo;
    }
    if (options.words.empty()) {
        session.print(tables_json(tables.files),
                      [&] { return render_tables(tables.files, terminal.look()); });
        return kFine;
    }
    const TagHits hits = search(tables.files, options.words, options.all);
    if (session.json() || !hits.hits.empty())
        session.print(tags_json(hits), [&] { return render_tags(hits, terminal.look()); });
    if (hits.hits.empty()) {
        terminal.err << fmt::format(
            "dpctl: no table has '{}'; `dpctl tag` lists the tables, and the devices for which none is public\n",
            joined(options.words, " "));
        return kNo;
    }
    return kFine;
}

} // namespace

const Command kTag{"tag",
                   kOffline,
                   "Looks up a parameter of a drive in the tag tables, by number or by words",
                   add<TagOptions>,
                   kOwnForm,
                   "dpctl tag                            the tables that are shipped\n"
                   "dpctl tag 270\n"
                   "dpctl tag autotune\n"
                   "dpctl tag program 1 segment 4 type   the address of a word of a program\n"
                   "dpctl tag speed --profile 590plus",
                   "",
                   Asks::nobody};

} // namespace dpslave::dpctl
