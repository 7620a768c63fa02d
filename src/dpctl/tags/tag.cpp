// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/subcommands.hpp"
#include "dpctl/cli/words.hpp"
#include "render_tags.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

TagFiles load(const Options& options)
{
    if (!options.table.empty()) return load_table(options.table);
    if (!options.profile.empty()) return load_table_of(options.profiles, options.profile);
    return load_tables(options.profiles);
}

std::string as_one(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

} // namespace

int do_tag(const Options& options, Terminal& terminal)
{
    const TagFiles tables = load(options);
    for (const std::string& fault : tables.faults) terminal.err << "dpctl: " << fault << '\n';
    if (tables.files.empty()) {
        if (tables.faults.empty())
            terminal.err << "dpctl: there is no tag table in " << options.profiles << "/../tags\n";
        return kNo;
    }
    if (options.words.empty()) {
        terminal.out << (options.json ? json_text(tables_json(tables.files)) + '\n'
                                      : render_tables(tables.files, terminal.look()));
        return kFine;
    }
    const TagHits hits = search(tables.files, options.words, options.all);
    if (options.json) terminal.out << json_text(tags_json(hits)) << '\n';
    if (hits.hits.empty()) {
        terminal.err << fmt::format(
            "dpctl: no table has '{}'; `dpctl tag` lists the tables, and the devices for "
            "which none is public\n",
            as_one(options.words));
        return kNo;
    }
    if (!options.json) terminal.out << render_tags(hits, terminal.look());
    return kFine;
}

} // namespace dpslave::dpctl
