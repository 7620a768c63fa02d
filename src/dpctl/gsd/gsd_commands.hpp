// SPDX-License-Identifier: Apache-2.0
/// What the subcommands of `dpctl gsd` do. Each returns the exit code.
#pragma once

#include "dpctl/cli/terminal.hpp"

#include <string>
#include <vector>

namespace dpslave::dpctl {

/// As the command line says it; empty = not said.
struct GsdOptions {
    std::string file; ///< to check or to show
    bool strict = false;

    std::string profile, profiles = DPSLAVE_DATA_FOLDER "/profiles"; ///< given by CMake
    std::string table;                                               ///< a CSV file
    std::string mapping;                                             ///< a file with a selection
    std::vector<std::string> in, out, in_out;                        ///< tags
    bool demand = false;
    std::string ident, max_tsdr, description, model;

    std::string output; ///< a file, or with `types` a folder
    bool force = false;
    bool brief = false; ///< type name in 17 characters
};

int gsd_check(const GsdOptions&, Terminal&);
int gsd_show(const GsdOptions&, Terminal&);
int gsd_make(const GsdOptions&, Terminal&);
int gsd_types(const GsdOptions&, Terminal&);

} // namespace dpslave::dpctl
