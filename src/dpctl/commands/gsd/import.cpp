// SPDX-License-Identifier: Apache-2.0
#include "dpctl/commands/commands.hpp"
#include "dpctl/decode/decode.hpp"
#include "dpctl/gsd/gsd_outcome.hpp"
#include "dpctl/gsd/gsd_station.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/ostream.h>

namespace dpslave::dpctl {
namespace {

using configurator::Outcome;

struct GsdImportOptions : ProfilesOption, OutputOption {
    std::string file;
    std::string profile; ///< empty = found out
    std::string cfg;     ///< octets of Chk_Cfg
    bool lossy = false;
    std::string table;   ///< a CSV file
    std::string station; ///< empty = no daemon is asked
};

void set_up(CLI::App& app, GsdImportOptions& options)
{
    add_text(app, "FILE", options.file, "", "A GSD file")->required();
    add_profile(app, options.profile, "Profile of the device; default: found by what the file says");
    add_text(app, "--cfg", options.cfg, "HEX",
             "Octets of the Chk_Cfg that the plant's master sends: they say the directions of the tags");
    app.add_flag("--lossy", options.lossy,
                 "Also where a master would send or wait for something else with the new file");
    add_profiles(app, options, "Folder of the device profiles");
    add_text(app, "--table", options.table, "FILE",
             "Your own tag table (CSV) with which the GSD file was made; the mapping keeps it");
    add_output(app, options.output, "Mapping file to write; default: standard output");
    app.add_flag("--force", options.force, "Replace an existing file");
    add_station_option(app, options.station,
                       "Take profile and Chk_Cfg from this running station, its name or address");
}

/// Profile and Chk_Cfg of a station that runs, where no option says them. The failure is an exit code.
std::optional<int> take_station(const GsdImportOptions& options, Session& session,
                                configurator::ImportOptions& how)
{
    if (options.station.empty()) return std::nullopt;
    const auto fetched = fetch_station(options.station, session);
    if (!fetched) return fetched.error();
    if (how.profile.empty()) how.profile = fetched->station.profile;
    if (how.cfg.empty())
        how.cfg = profile::read_hex_octets(fetched->station.last_cfg).value_or(std::vector<std::uint8_t>{});
    if (how.cfg.empty())
        fmt::print(session.terminal().err,
                   "dpctl: no master has sent a Chk_Cfg to {}: the directions are not known from it.\n",
                   printable(fetched->station.name));
    return std::nullopt;
}

int run(const GsdImportOptions& options, Session& session)
{
    configurator::ImportOptions how{
        .profile = options.profile, .table = options.table, .lossy = options.lossy};
    if (!options.cfg.empty()) {
        const auto octets = read_octets({options.cfg});
        if (!octets) return print_outcome(refused("--cfg: " + octets.error(), kUsage), session);
        how.cfg = *octets;
    }
    if (const auto exit = take_station(options, session, how)) return *exit;
    const auto import = [&](const std::string& content) {
        return configurator::import_file(files_of(options.profiles), content, how);
    };
    Outcome outcome = with_file(options.file, import);
    const bool has_losses = !Json::parse(outcome.facts, nullptr, false).value("lost", Json::array()).empty();
    const int exit = write_and_print(std::move(outcome), options, session);
    if (exit == kNo && has_losses && !options.lossy && !session.json())
        fmt::print(session.terminal().err, "To take the losses: dpctl gsd import --lossy.\n");
    return exit;
}

} // namespace

const Command kGsdImport{"gsd import",
                         kOffline,
                         "Writes the mapping file that makes this GSD file; names what a mapping cannot hold",
                         add<GsdImportOptions>,
                         "",
                         "",
                         "1 a file is faulty"};

} // namespace dpslave::dpctl
