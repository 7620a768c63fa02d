// SPDX-License-Identifier: Apache-2.0
/// What the subcommands of `dpctl gsd` do. Each returns the exit code.
#pragma once

#include "dpctl/cli/subcommands.hpp"

#include <string>
#include <vector>

namespace dpslave::dpctl {

/// As the command line says it; empty = not said.
struct GsdOptions {
    bool json = false;
    std::string file;  ///< to check, to show, to import, to compare
    std::string other; ///< to compare with
    bool strict = false;
    Options daemon; ///< `check --station`: which one, and the socket

    std::string profile, profiles = DPSLAVE_DATA_FOLDER "/profiles"; ///< given by CMake
    std::string table;                                               ///< a CSV file
    std::string mapping;                                             ///< a file with a selection
    std::vector<std::string> in, out, in_out;                        ///< tags
    std::vector<std::string> list;                                   ///< "in:1"
    bool demand = false;
    std::string ident, max_tsdr, description, model;

    std::string output; ///< a file, or with `types` a folder
    bool force = false;
    std::string page = DPSLAVE_DATA_FOLDER "/configurator.html"; ///< `configure`
    bool brief = false;                                          ///< type name in 17 characters
};

int gsd_check(const GsdOptions&, Terminal&);
int gsd_show(const GsdOptions&, Terminal&);
int gsd_import(const GsdOptions&, Terminal&);
int gsd_diff(const GsdOptions&, Terminal&);
int gsd_make(const GsdOptions&, Terminal&);
int gsd_configure(const GsdOptions&, Terminal&);
int gsd_types(const GsdOptions&, Terminal&);

} // namespace dpslave::dpctl
