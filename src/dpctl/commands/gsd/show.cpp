// SPDX-License-Identifier: Apache-2.0
#include "dpctl/commands/commands.hpp"
#include "dpctl/gsd/gsd_outcome.hpp"

namespace dpslave::dpctl {
namespace {

struct GsdShowOptions : ProfilesOption {
    std::string file, profile;
    std::vector<std::string> modules; ///< names of a list
    std::string table;                ///< a CSV file
};

void set_up(CLI::App& app, GsdShowOptions& options)
{
    add_text(app, "FILE", options.file, "", "A GSD file")->required();
    add_profile(app, options.profile, "Show the tags with the names of this profile's tag table");
    add_modules(app, options.modules, "Show the map of this list of modules, #3 is the third of the file");
    add_profiles(app, options, "Folder of the device profiles");
    add_own_table(app, options.table);
}

int run(const GsdShowOptions& options, Session& session)
{
    const auto map = [&](const std::string& content) {
        return configurator::show(files_of(options.profiles), content, options.profile, options.table,
                                  options.modules);
    };
    return print_outcome(with_file(options.file, map), session);
}

} // namespace

const Command kGsdShow{
    "gsd show",           kOffline,    "Shows where each value is in the telegrams (I/O map)",
    add<GsdShowOptions>,  "",          "",
    "1 a file is faulty", Asks::nobody};

} // namespace dpslave::dpctl
