// SPDX-License-Identifier: Apache-2.0
#include "installation.hpp"

#include "support/paths.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

namespace dpslave::endurance {
namespace {

namespace fs = std::filesystem;
using dpslave::test::Json;

const fs::path kConfigFolder = test::source_path("config");

/// What was started says all that it has to say, and ends.
Outcome run_patiently(Arguments command)
{
    Process program{std::move(command)};
    const auto status = program.wait(kPatience);
    Outcome outcome{.status = status.value_or(-1), .out = {}, .err = {}};
    for (const std::string& line : program.transcript().lines()) outcome.out += line + "\n";
    return outcome;
}

void must(const ::testing::AssertionResult& result)
{
    if (!result) throw std::runtime_error(result.message());
}

} // namespace

Installation::Installation(Setup setup) : setup_(std::move(setup))
{
    fs::permissions(socket().parent_path(), fs::perms{0755}); // every user reaches the socket
    plug_drive();
    test::write_file(folder_ / "dpslaved.toml", config(false, 1));
    start_daemon();
    must(daemon_->says("station(s) on", kPatience));
}

void Installation::start_daemon()
{
    daemon_ = std::make_unique<Process>(daemon_command(), setup_.environment);
}

Outcome Installation::release() const
{
    Arguments command = daemon_command();
    command.emplace_back("--release");
    return run_patiently(std::move(command));
}

Arguments Installation::daemon_command() const
{
    return {test::program_path("dpslaved"), "--config", folder_ / "dpslaved.toml", "--profiles",
            kConfigFolder / "profiles"};
}

void Installation::plug_drive()
{
    line_ = std::make_unique<Process>(Arguments{test::program_path("dpsim"), "line", "--baud", "38400",
                                                "--bits", "10", "--a", folder_ / "drive-end", "--b",
                                                folder_ / "drive-gateway"});
    must(line_->says("ready", kPatience));
    drive_ = std::make_unique<Process>(Arguments{
        test::program_path("dpsim"), "drive", "--profile", "590", "--port", folder_ / "drive-end", "--baud",
        "38400", "--table", kConfigFolder / "tags/example.csv", "--unit", "00", "01", "02"});
    must(drive_->says("ready", kPatience));
}

void Installation::unplug_drive()
{
    drive_->end();
    line_->end();
}

std::string Installation::config(bool visitor, unsigned refresh_s) const
{
    std::string text = fmt::format(
        "[bus]\nport = \"{}\"\nbaud = 1500000\ndirection = \"none\"\nmax_tsdr = {}\n[realtime]\ncpu = {}\n"
        "[control]\nsocket = \"{}\"\n"
        "[[line]]\nname = \"p3\"\nport = \"{}\"\nprotocol = \"ei-ascii\"\nbaud = 38400\n"
        "wire_time = \"yes\"\n",
        setup_.bus_port, setup_.max_tsdr, setup_.cpu, socket().string(),
        (folder_ / "drive-gateway").string());
    for (unsigned unit = 0; unit < (visitor ? 3U : 2U); ++unit)
        text += fmt::format(
            "[[station]]\nname = \"station{0}\"\naddress = {0}\nprofile = \"590\"\nline = \"p3\"\n"
            "unit = \"0{1}\"\ntags = \"{2}\"\noutput_refresh_s = {3}\nwhen_drive_lost = \"hold\"\n",
            kFirst + unit, unit, (kConfigFolder / "tags/example.csv").string(), refresh_s);
    return text;
}

bool Installation::reload(bool visitor, unsigned refresh_s)
{
    test::write_file(folder_ / "dpslaved.toml", config(visitor, refresh_s));
    return dpctl({"reload"}).status == 0;
}

bool Installation::reload_with_fault()
{
    const std::string good = test::content(folder_ / "dpslaved.toml");
    test::write_file(folder_ / "dpslaved.toml", good + "\nno_key = 1\n");
    const bool refused = dpctl({"reload"}).status == 1;
    test::write_file(folder_ / "dpslaved.toml", good + "\n");
    return refused;
}

Arguments Installation::dpctl_command(const Arguments& arguments) const
{
    Arguments command{test::program_path("dpctl"), "--socket", socket(), "--timeout",
                      std::to_string(kPatience.count())};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

Outcome Installation::dpctl(const Arguments& arguments) const
{
    return run_patiently(dpctl_command(arguments));
}

DaemonCounts Installation::counts() const
{
    std::map<std::string, std::uint64_t> bus;
    DaemonCounts counts;
    const Outcome outcome = dpctl({"--json", "counters"});
    if (outcome.status != 0) throw std::runtime_error("dpctl counters: " + outcome.out);
    const Json all = Json::parse(outcome.out);
    for (const Json& one : all.at("groups").at(0).at("counters")) {
        const auto name = one.at("name").get<std::string>();
        bus[name] = one.at("value").get<std::uint64_t>();
        if (name.starts_with("flaw: ")) counts.flaws += bus[name];
    }
    counts.octets = bus.at("octets");
    counts.telegrams = bus.at("telegrams");
    counts.requests = bus.at("requests");
    counts.answers = bus.at("replies") - bus.at("unsent");
    counts.missed = bus.at("late") + bus.at("overtaken") + bus.at("unsent");
    return counts;
}

std::uint64_t Installation::rss_kib() const
{
    std::ifstream file{fmt::format("/proc/{}/smaps_rollup", daemon_->pid())};
    std::uint64_t value = 0;
    for (std::string word; file >> word;)
        if (word == "Rss:" && file >> value) return value;
    throw std::runtime_error("the daemon's memory cannot be read");
}

} // namespace dpslave::endurance
