// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/config.hpp"
#include "dpslave/app/daemon.hpp"
#include "dpslave/app/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/sinks/systemd_sink.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace {

using dpslave::app::ExitStatus;

constexpr const char* kFooter = R"(Exit status:
  0  ended by SIGTERM or SIGINT; with --check: the configuration is good
  1  the configuration was refused: one line per fault on standard error
  2  wrong usage
  3  a device or the control socket could not be opened)";

/// systemd says which stream it has connected to the journal; a variable that was inherited does not count.
bool stderr_is_journal()
{
    const char* stream = std::getenv("JOURNAL_STREAM");
    struct stat there {};
    if (stream == nullptr || ::fstat(STDERR_FILENO, &there) != 0) return false;
    return fmt::format("{}:{}", there.st_dev, there.st_ino) == stream;
}

/// Under systemd straight into the journal, with levels; else to standard error, with the time.
void set_up_log()
{
    std::shared_ptr<spdlog::logger> log;
    if (stderr_is_journal()) {
        log = std::make_shared<spdlog::logger>("dpslaved",
                                               std::make_shared<spdlog::sinks::systemd_sink_mt>("dpslaved"));
    } else {
        log = std::make_shared<spdlog::logger>("dpslaved", std::make_shared<spdlog::sinks::stderr_sink_mt>());
        log->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    }
    log->flush_on(spdlog::level::info);
    spdlog::set_default_logger(std::move(log));
}

int status(ExitStatus status)
{
    return static_cast<int>(status);
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app{"PROFIBUS-DP slave that takes the place of a drive's option board.", "dpslaved"};
    app.footer(kFooter);
    std::string file = "/etc/dpslaved/dpslaved.toml";
    std::string profiles = DPSLAVE_DATA_FOLDER "/profiles"; // given by CMake
    bool check = false;
    app.add_option("--config", file, "Configuration file")->capture_default_str();
    app.add_option("--profiles", profiles, "Folder of the device profiles")->capture_default_str();
    app.add_flag("--check", check, "Only judge the configuration");
    app.set_version_flag("--version", std::string("dpslaved ") + dpslave::app::kVersion);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : status(ExitStatus::usage);
    }

    const auto config = dpslave::app::load_config(file, profiles);
    if (!config) {
        for (const dpslave::profile::Fault& fault : config.error())
            std::fprintf(stderr, "%s\n", to_string(fault).c_str());
        return status(ExitStatus::configuration_refused);
    }
    if (check) {
        for (const dpslave::profile::Fault& warning : config->warnings)
            std::fprintf(stderr, "%s (warning)\n", to_string(warning).c_str());
        return 0;
    }
    set_up_log();
    try {
        return status(dpslave::app::run_daemon(*config, profiles));
    } catch (const std::exception& error) { // no descriptor, no thread or no memory left
        spdlog::critical("ended by a failure of the system: {}", error.what());
        return status(ExitStatus::device_not_opened);
    }
}
