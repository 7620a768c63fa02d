// SPDX-License-Identifier: Apache-2.0
#include "dpctl/commands/commands.hpp"
#include "dpctl/gsd/gsd_outcome.hpp"

#include "dpslave/gsd/type_file.hpp"

#include <filesystem>

namespace dpslave::dpctl {
namespace {

using configurator::Outcome;

struct GsdTypesOptions : OutputOption {
    bool brief = false; ///< type name in 17 characters
};

void set_up(CLI::App& app, GsdTypesOptions& options)
{
    add_output(app, options.output, "Folder to write the five files to")->required()->type_name("DIR");
    app.add_flag(
        "--brief", options.brief,
        "Type name in 17 characters, as in STEP 7 (V5); default: in 21, as the manual has it (V4.0)");
    app.add_flag("--force", options.force, "Replace existing files");
}

Outcome write_types(const GsdTypesOptions& options)
{
    const auto files = gsd::type_files(options.brief ? gsd::TypeName::brief : gsd::TypeName::printed);
    const std::filesystem::path folder{options.output};
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        return refused(options.output + " is not a folder: create it first, or name another.");
    for (const gsd::TypeFile& file : files)
        if (!options.force &&
            std::filesystem::exists(std::filesystem::symlink_status(folder / file.name, error)))
            return refused(
                (folder / file.name).string() +
                " is there already, so no file is written: choose another folder, or replace them with --force.");
    for (const gsd::TypeFile& file : files)
        if (const auto wrong = write_file(folder / file.name, file.content, options.force))
            return refused((folder / file.name).string() + " is not written: " + wrong->why + '.');
    return {};
}

int run(const GsdTypesOptions& options, Session& session)
{
    return print_outcome(write_types(options), session);
}

} // namespace

const Command kGsdTypes{
    "gsd types",          kOffline,    "Writes the type files for COM ET200 in five languages",
    add<GsdTypesOptions>, "",          "",
    "1 a file is faulty", Asks::nobody};

} // namespace dpslave::dpctl
