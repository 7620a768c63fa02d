// SPDX-License-Identifier: Apache-2.0
#include "gateway.hpp"

#include "support/paths.hpp"

#include <fmt/format.h>
#include <grp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace dpslave::test {
namespace {

namespace fs = std::filesystem;

std::string station_name(std::size_t index)
{
    constexpr std::array kNames{"unwinder", "rewinder", "dancer", "printer", "cutter", "stacker"};
    return index < kNames.size() ? kNames.at(index) : fmt::format("drive{:02}", index);
}

const fs::path kConfigFolder = source_path("config");

/// The simulated masters wait 20 ms beyond the slot time; the daemon may take three quarters of that.
unsigned patient_max_tsdr(unsigned baud)
{
    return std::max(60U, baud * 15 / 1000);
}

/// A group that this user is in, so that the tests may operate as any user.
std::string own_group()
{
    const group* const found = ::getgrgid(::getegid());
    return found != nullptr ? found->gr_name : "root";
}

void must(const ::testing::AssertionResult& result)
{
    if (!result) throw std::runtime_error(result.message());
}

std::unique_ptr<Process> paced_line(unsigned baud, const char* bits, const fs::path& a, const fs::path& b,
                                    const Arguments& more = {})
{
    Arguments command{
        program_path("dpsim"), "line", "--baud", std::to_string(baud), "--bits", bits, "--a", a, "--b", b};
    command.insert(command.end(), more.begin(), more.end());
    auto process = std::make_unique<Process>(std::move(command));
    must(process->says("ready"));
    return process;
}

} // namespace

std::string content(const fs::path& file)
{
    std::ifstream in{file};
    std::ostringstream text;
    text << in.rdbuf();
    std::string all = text.str();
    if (!all.empty() && all.back() == '\n') all.pop_back();
    return all;
}

void write_file(const fs::path& file, const std::string& text)
{
    fs::create_directories(file.parent_path());
    std::ofstream out{file};
    out << text;
    if (!out.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

Gateway::Gateway(Wiring wiring) : wiring_(std::move(wiring))
{
    plug_bus();
    plug_drive_line();
    if (!wiring_.table.empty()) write_file(folder_ / "tags.csv", wiring_.table);
    if (wiring_.simulated) start_drive();
    if (wiring_.lamps) {
        write_file(lamp_folder() / "class/gpio/gpio23/direction", "in\n");
        write_file(lamp_folder() / "class/gpio/gpio23/value", "0\n");
        make_led("green");
    }
    write_file(config(), config_text());
    if (wiring_.started) start_daemon();
}

void Gateway::start_drive()
{
    const bool is_instrument = wiring_.protocol == "modbus-rtu";
    Arguments drive{program_path("dpsim"),
                    "drive",
                    "--profile",
                    wiring_.model.empty() ? wiring_.profile : wiring_.model,
                    "--port",
                    drive_end(),
                    "--baud",
                    std::to_string(wiring_.drive_baud),
                    "--log",
                    "--table"};
    if (!wiring_.table.empty())
        drive.push_back(folder_ / "tags.csv");
    else
        drive.push_back(kConfigFolder / (is_instrument ? "tags/2400.csv" : "tags/example.csv"));
    drive.insert(drive.end(), wiring_.drive.begin(), wiring_.drive.end());
    drive.push_back("--unit");
    const auto& present = wiring_.present.empty() ? wiring_.units : wiring_.present;
    drive.insert(drive.end(), present.begin(), present.end());
    drive_ = std::make_unique<Process>(std::move(drive));
    must(drive_->says("ready"));
}

std::filesystem::path Gateway::make_led(const std::string& name) const
{
    const fs::path led = lamp_folder() / "class/leds" / name;
    write_file(led / "brightness", "0\n");
    write_file(led / "max_brightness", "1\n");
    write_file(led / "trigger", "none\n");
    return led / "brightness";
}

bool Gateway::flashes(const fs::path& lamp) const
{
    for (const char* const value : {"1", "0", "1"})
        if (!eventually([&] { return content(lamp) == value; })) return false;
    return true;
}

Gateway::~Gateway()
{
    for (Process* const one : {daemon_.get(), drive_.get(), line_.get(), bus_.get()}) {
        if (one == nullptr) continue;
        EXPECT_EQ(one->end(), 0);
    }
}

std::string Gateway::config_text() const
{
    std::string text = fmt::format(
        "[bus]\n"
        "port = \"{}\"\n"
        "baud = {}\n"
        "{}"
        "max_tsdr = {}\n"
        "[leds]\n"
        "sysfs = \"{}\"\n"
        "[control]\n"
        "socket = \"{}\"\n"
        "operator_group = \"{}\"\n"
        "{}"
        "[[line]]\n"
        "name = \"p3\"\n"
        "port = \"{}\"\n"
        "protocol = \"{}\"\n"
        "baud = {}\n"
        "wire_time = \"yes\"\n",
        wiring_.bus_port.empty() ? (folder_ / "bus-gateway").string() : wiring_.bus_port, wiring_.bus_baud,
        wiring_.direction, wiring_.max_tsdr.value_or(patient_max_tsdr(wiring_.bus_baud)),
        lamp_folder().string(), socket().string(), own_group(), wiring_.control_keys,
        (folder_ / "drive-gateway").string(), wiring_.protocol, wiring_.drive_baud);
    text += wiring_.line_keys;
    for (std::size_t i = 0; i < wiring_.units.size(); ++i) {
        text += fmt::format("[[station]]\n"
                            "name = \"{}\"\n"
                            "address = {}\n"
                            "profile = \"{}\"\n"
                            "line = \"p3\"\n"
                            "unit = \"{}\"\n"
                            "output_refresh_s = {}\n"
                            "when_drive_lost = \"{}\"\n",
                            station_name(i), 5 + i, wiring_.profile, wiring_.units[i],
                            wiring_.output_refresh_s, wiring_.when_drive_lost);
        if (!wiring_.table.empty())
            text += "tags = \"tags.csv\"\n";
        else if (wiring_.protocol == "ei-ascii")
            text += fmt::format("tags = \"{}\"\n",
                                (kConfigFolder / "tags/example.csv").string()); // as the drive has
        text += wiring_.keys;
    }
    if (wiring_.lamps) text += "[station.leds]\nred = \"gpio:23\"\ngreen = \"led:green\"\n";
    return text;
}

Arguments Gateway::daemon_command(Arguments more) const
{
    const fs::path profiles =
        wiring_.profiles.empty() ? kConfigFolder / "profiles" : fs::path{wiring_.profiles};
    Arguments command{program_path("dpslaved"), "--config", config(), "--profiles", profiles};
    command.insert(command.end(), more.begin(), more.end());
    return command;
}

void Gateway::start_daemon()
{
    Arguments command = daemon_command();
    if (!wiring_.log_to.empty())
        command.insert(command.begin(), {"/bin/sh", "-c", R"(exec "$@" 2>"$0")", wiring_.log_to});
    daemon_ = std::make_unique<Process>(std::move(command), wiring_.environment);
    if (wiring_.log_to.empty())
        must(daemon_->says("station(s) on")); // all is open; a call is answered now
    else
        must(eventually([&] { return dpctl({"status", "--quiet"}).status != 3; }));
}

void Gateway::plug_bus()
{
    if (wiring_.bus_port.empty())
        bus_ = paced_line(wiring_.bus_baud, "11", bus_end(), folder_ / "bus-gateway", wiring_.bus);
}

void Gateway::unplug_bus()
{
    bus_->end();
}

void Gateway::plug_drive_line()
{
    line_ = paced_line(wiring_.drive_baud, "10", drive_end(), folder_ / "drive-gateway");
}

void Gateway::plug_drive()
{
    plug_drive_line();
    start_drive();
}

void Gateway::unplug_drive()
{
    drive_->end();
    line_->end();
}

Arguments Gateway::dpctl_command(Arguments arguments) const
{
    // Wide enough for each sentence to be one line.
    Arguments command{"/usr/bin/env", "COLUMNS=1000", program_path("dpctl"),         "--socket",
                      socket(),       "--timeout",    std::to_string(kLimit.count())};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

Outcome Gateway::dpctl(Arguments arguments) const
{
    return run(dpctl_command(std::move(arguments)));
}

::testing::AssertionResult Gateway::exchange_ends_with(int status, const std::string& station) const
{
    Arguments question{"status", "--wait", "0", "--quiet"};
    if (!station.empty()) question.push_back(station);
    return eventually([&] { return dpctl(question).status == status; });
}

Json Gateway::json(Arguments arguments) const
{
    arguments.insert(arguments.begin(), "--json");
    return Json::parse(dpctl(std::move(arguments)).out);
}

Json Gateway::station(std::size_t index) const
{
    return json({"status"}).at("stations").at(index);
}

Json Gateway::diagnosis() const
{
    return json({"diag"}).at("stations").at(0);
}

Json Gateway::tec(const std::string& row) const
{
    const Json reply = json({"show"});
    for (const Json& one : reply.at("stations").at(0).at("tec").at("rows"))
        if (one.at("name") == row) return one.at("value");
    return {};
}

Json Gateway::word(unsigned tag) const
{
    const Json all = json({"io"}).at("stations").at(0).at("words");
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Json& one) { return one.at("tag") == tag; });
    return found != all.end() ? *found : Json{};
}

::testing::AssertionResult Gateway::word_becomes(unsigned tag, const char* field, const Json& value) const
{
    return eventually([&] {
        const Json now = word(tag);
        return now.is_object() && now.at(field) == value;
    });
}

std::uint64_t Gateway::counter(const std::string& group, const std::string& name) const
{
    const Json all = json({"counters"});
    for (const Json& one : all.at("groups"))
        for (const Json& c : one.at("counters"))
            if (one.at("name") == group && c.at("name") == name) return c.at("value").get<std::uint64_t>();
    throw std::runtime_error("there is no counter " + name + " of " + group);
}

std::uint64_t Gateway::flaws() const
{
    std::uint64_t sum = 0;
    const Json all = json({"counters"});
    for (const Json& c : all.at("groups").at(0).at("counters"))
        if (c.at("name").get<std::string>().starts_with("flaw: ")) sum += c.at("value").get<std::uint64_t>();
    return sum;
}

std::string Gateway::spoken_on_the_bus()
{
    const std::string line = passed_on_the_bus("b to a");
    return line.substr(0, line.find(" passed"));
}

std::string Gateway::passed_on_the_bus(const std::string& direction)
{
    const std::size_t before = bus_->transcript().size();
    bus_->send_line("stats");
    // Both lines: the next one is not to find the second one of this answer.
    if (!bus_->transcript().await("b to a: ", before, kLimit)) return "the line gives no answer";
    const auto found = bus_->transcript().await(direction + ": ", before, kLimit);
    return bus_->transcript().lines(found.value_or(before)).front();
}

// ---- the master

namespace {

Arguments master_command(const Gateway& gateway, const Arguments& settings, unsigned slave)
{
    Arguments command{program_path("dpsim"),
                      "master",
                      "--port",
                      gateway.bus_end(),
                      "--baud",
                      std::to_string(gateway.bus_baud()),
                      "--slave",
                      std::to_string(slave)};
    // A machine that stops the daemon for a moment is no fault: without these the station is lost in 40 ms.
    constexpr std::array<std::array<const char*, 2>, 3> kPatience{
        {{"--watchdog", "5s"}, {"--slot", "100ms"}, {"--retries", "15"}}};
    for (const auto& [option, value] : kPatience) {
        const auto says_it = [&](const std::string& word) {
            return word.find(option + 2) != std::string::npos;
        };
        if (std::none_of(settings.begin(), settings.end(), says_it))
            command.insert(command.end(), {option, value});
    }
    command.insert(command.end(), settings.begin(), settings.end());
    return command;
}

} // namespace

Master::Master(const Gateway& gateway, const Arguments& settings, unsigned slave)
    : Process(master_command(gateway, settings, slave))
{}

/// Behind each command goes a comment, which the master repeats when it comes to it.
::testing::AssertionResult Master::does(const std::string& command)
{
    const std::string done = fmt::format("# done {}", ++commands_);
    send_line(command);
    send_line(done);
    return says("> " + done, 2 * kLimit);
}

::testing::AssertionResult Master::leaves()
{
    send_line("quit");
    const auto status = wait();
    if (status == 0) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "the master ends with status " << status.value_or(-1);
}

} // namespace dpslave::test
