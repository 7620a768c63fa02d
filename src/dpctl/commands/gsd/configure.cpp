// SPDX-License-Identifier: Apache-2.0
#include "dpctl/commands/commands.hpp"
#include "dpctl/gsd/gsd_outcome.hpp"
#include "dpctl/gsd/gsd_page.hpp"

namespace dpslave::dpctl {
namespace {

struct GsdConfigureOptions {
    std::string page = DPSLAVE_DATA_FOLDER "/configurator.html"; ///< given by CMake
};

void set_up(CLI::App& app, GsdConfigureOptions& options)
{
    add_text(app, "--page", options.page, "FILE", "The configurator's page, if it is elsewhere");
}

int run(const GsdConfigureOptions& options, Session& session)
{
    return print_outcome(open_page(options.page), session);
}

} // namespace

const Command kGsdConfigure{"gsd configure",
                            kOffline,
                            "Opens the configurator in a browser, or says how to open it on another PC",
                            add<GsdConfigureOptions>,
                            "",
                            "",
                            "1 a file is faulty",
                            Asks::nobody};

} // namespace dpslave::dpctl
