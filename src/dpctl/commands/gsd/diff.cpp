// SPDX-License-Identifier: Apache-2.0
#include "dpctl/commands/commands.hpp"
#include "dpctl/gsd/gsd_outcome.hpp"

namespace dpslave::dpctl {
namespace {

struct GsdDiffOptions : ProfilesOption {
    std::string file, other, profile;
    std::string table; ///< a CSV file
};

void set_up(CLI::App& app, GsdDiffOptions& options)
{
    add_text(app, "FILE", options.file, "", "A GSD file")->required();
    add_text(app, "OTHER", options.other, "", "Another GSD file")->required();
    add_profile(app, options.profile, "Show the tags with the names of this profile's tag table");
    add_profiles(app, options, "Folder of the device profiles");
    add_own_table(app, options.table);
}

int run(const GsdDiffOptions& options, Session& session)
{
    const auto compare = [&](const std::string& left) {
        return with_file(options.other, [&](const std::string& right) {
            return configurator::diff(files_of(options.profiles), left, right, options.profile,
                                      options.table);
        });
    };
    return print_outcome(with_file(options.file, compare), session);
}

} // namespace

const Command kGsdDiff{
    "gsd diff",           kOffline,    "Compares two GSD files by their meaning and by their lines",
    add<GsdDiffOptions>,  "",          "",
    "1 a file is faulty", Asks::nobody};

} // namespace dpslave::dpctl
