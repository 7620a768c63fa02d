// SPDX-License-Identifier: Apache-2.0
#include "dpctl/commands/commands.hpp"
#include "dpctl/gsd/gsd_outcome.hpp"
#include "dpctl/gsd/gsd_station.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/io/file.hpp"

#include <algorithm>
#include <functional>

namespace dpslave::dpctl {
namespace {

using configurator::Outcome;

struct GsdCheckOptions : ProfilesOption {
    std::vector<std::string> files;
    bool strict = false;
    std::string profile;              ///< empty = found out
    std::vector<std::string> modules; ///< names of a list
    KeyOptions keys;
    std::string mapping; ///< a file with a selection
    std::string table;   ///< a CSV file
    std::string station; ///< empty = the file alone
};

void set_up(CLI::App& app, GsdCheckOptions& options)
{
    app.add_option("FILE", options.files, "GSD files")->required()->type_name("");
    app.add_flag(
        "--strict", options.strict,
        "Every deviation from the standard is an error, also those that many public files have and masters accept");
    add_profile(app, options.profile,
                "Judge what a station of this profile takes; default: found by what the file says");
    add_modules(app, options.modules,
                "Judge this list of modules, #3 is the third of the file; default: any list");
    add_keys(app, options.keys);
    add_text(app, "--mapping", options.mapping, "FILE",
             "Profile and keys of the station are those of this mapping file");
    add_text(app, "--ident", options.keys.ident, "N", "Ident_Number of the station: 0x1649");
    add_text(app, "--table", options.table, "FILE",
             "With --station: the station's tag table (CSV), if it is not here");
    add_profiles(app, options, "Folder of the device profiles");
    add_station_option(
        app, options.station,
        "Check the file against this running station too, its name or address: before commissioning");
}

/// How each file is judged; the failure is an exit code whose reasons are printed already.
using Judge = std::function<Outcome(const std::string& file, const std::string& content)>;

Result<Judge, int> judge_with_station(const GsdCheckOptions& options, Session& session)
{
    const auto fetched = fetch_station(options.station, session);
    if (!fetched) return Failure{fetched.error()};
    std::string table = options.table; // the station's own, where it is on this machine
    if (table.empty() && io::read_regular_file(fetched->tag_table)) table = fetched->tag_table;
    return Judge{
        [&options, table, station = fetched->station](const std::string& file, const std::string& content) {
            return configurator::check_with_station(files_of(options.profiles), content, file, options.strict,
                                                    station, table);
        }};
}

/// One line of JSON for each file.
int print_check(const Outcome& outcome, const std::string& file, Session& session)
{
    if (!session.json()) return print_outcome(outcome, session);
    Json line = Json::object();
    if (!file.empty()) line["file"] = printable(file);
    line.update(Json::parse(configurator::reply_of(outcome), nullptr, false));
    session.print_line(line);
    return outcome.exit;
}

Result<Judge, int> judge_alone(const GsdCheckOptions& options, Session& session)
{
    Outcome outcome;
    auto mapping = read_mapping(options.mapping, outcome);
    if (mapping) read_keys(options.keys, mapping->selection, outcome);
    if (outcome.exit != kFine) return Failure{print_check(outcome, {}, session)};
    configurator::CheckOptions how{.strict = options.strict,
                                   .profile = options.profile.empty() ? mapping->profile : options.profile,
                                   .keys = mapping->selection.keys(),
                                   .modules = options.modules};
    return Judge{[&options, how](const std::string& file, const std::string& content) {
        return configurator::check(files_of(options.profiles), content, file, how);
    }};
}

int run(const GsdCheckOptions& options, Session& session)
{
    const auto judge =
        options.station.empty() ? judge_alone(options, session) : judge_with_station(options, session);
    if (!judge) return judge.error();
    int exit = kFine;
    for (const std::string& file : options.files) {
        const Outcome outcome =
            with_file(file, [&](const std::string& content) { return (*judge)(file, content); });
        exit = std::max(exit, print_check(outcome, file, session));
    }
    return exit;
}

} // namespace

const Command kGsdCheck{
    "gsd check",
    kOffline,
    "Checks whether a station takes this file, and its form; errors and warnings with their lines",
    add<GsdCheckOptions>,
    "",
    "",
    "1 a file is faulty"};

} // namespace dpslave::dpctl
