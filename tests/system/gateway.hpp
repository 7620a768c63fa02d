// SPDX-License-Identifier: Apache-2.0
/// The whole installation on a table: a bus and a drive line of paced ptys, a simulated drive, the daemon
/// between them, and masters and dpctl as a test needs them. All of them are the real programs.
#pragma once

#include "process.hpp"
#include "support/folder.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dpslave::test {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

/// Without the line break at its end; empty if the file is not there.
std::string content(const std::filesystem::path& file);
/// Makes the folders above it as well.
void write_file(const std::filesystem::path& file, const std::string& text);

/// What a test may choose. Stations have the addresses 5, 6 ... and the units given here.
struct Wiring {
    unsigned bus_baud = 187'500;
    unsigned drive_baud = 38'400; ///< faster than usual: no test waits longer than it must
    std::string bus_port{}; ///< a tty of the test instead of the simulated bus; empty: the simulated bus
    Arguments bus{};        ///< more options of dpsim line for it
    std::string profile = "590";
    std::vector<std::string> units{"00"};
    std::vector<std::string> present{}; ///< of the units, those that are really there; empty: all
    /// Bit times. Nothing: as long as the simulated masters wait, so that a loaded machine is no fault; 0:
    /// what the profile says, as on a real bus.
    std::optional<unsigned> max_tsdr{};
    std::string output_refresh_s = "1.0";
    /// The bus is there whatever the drive does, unless a test is about that.
    std::string when_drive_lost = "hold";
    std::string protocol = "ei-ascii";
    std::string model{}; ///< of the simulated drive; empty: as the profile
    Arguments drive{};   ///< more options of dpsim drive
    std::string table{}; ///< a tag table of the test, for the drive and the daemon; empty: that of the drive
    std::string profiles{};     ///< folder of the profiles; empty: those that are shipped
    std::string line_keys{};    ///< more lines of the drive line
    std::string control_keys{}; ///< more lines of [control]
    std::string direction = "direction = \"none\"\n"; ///< the lines of [bus] for it
    std::string keys{};                               ///< more lines of each station, its tables last
    bool simulated = true;     ///< false: the test brings a drive of its own to drive_end()
    bool lamps = false;        ///< red on GPIO 23, green on the LED class, both in lamp_folder()
    Environment environment{}; ///< of the daemon
    std::string log_to{};      ///< a file for its standard error; empty: its transcript
    bool started = true;       ///< false: the test starts the daemon by itself, or sees it refuse
};

class Gateway {
public:
    explicit Gateway(Wiring wiring = {});
    /// Ends all programs as a service manager does and expects that they end well: sanitizers speak there.
    ~Gateway();
    Gateway(const Gateway&) = delete;
    Gateway& operator=(const Gateway&) = delete;

    Process& bus() { return *bus_; }         ///< dpsim line of the PROFIBUS
    Process& drive_line() { return *line_; } ///< dpsim line between the gateway and the drive
    Process& drive() { return *drive_; }
    const Process& drive() const { return *drive_; }
    Process& daemon() { return *daemon_; }
    void start_daemon(); ///< and waits until it serves
    void unplug_bus();   ///< as a USB adapter that is pulled: the tty vanishes
    void plug_bus();
    void unplug_drive(); ///< the same on the drive's side
    void plug_drive();

    std::filesystem::path drive_end() const { return folder_ / "drive-end"; }
    std::filesystem::path bus_end() const { return folder_ / "bus-plc"; } ///< where the masters are
    std::filesystem::path socket() const { return folder_ / "control.sock"; }
    std::filesystem::path config() const { return folder_ / "dpslaved.toml"; }
    std::filesystem::path folder(const std::string& name) const { return folder_ / name; }
    std::filesystem::path lamp_folder() const { return folder_ / "sys"; }
    unsigned bus_baud() const { return wiring_.bus_baud; }

    std::string config_text() const; ///< as it was written to config()
    Arguments daemon_command(Arguments more = {}) const;
    Outcome run_daemon(Arguments more = {}) const { return run(daemon_command(std::move(more))); }

    /// A file in lamp_folder() that an LED of the LED class called `name` shines into.
    std::filesystem::path make_led(const std::string& name) const;
    bool flashes(const std::filesystem::path& lamp) const; ///< it is lit, and dark, and lit again soon

    Outcome dpctl(Arguments arguments) const;
    Arguments dpctl_command(Arguments arguments) const;
    /// That dpctl status --wait 0 ends with this status soon: what dpctl shows may be a moment old.
    ::testing::AssertionResult exchange_ends_with(int status, const std::string& station = "") const;
    Json json(Arguments arguments) const;      ///< what dpctl --json prints
    Json station(std::size_t index = 0) const; ///< of dpctl status
    Json diagnosis() const;                    ///< of dpctl diag, first station
    Json tec(const std::string& row) const;    ///< value of a row of TEC OPTION, first station
    Json word(unsigned tag) const;             ///< of dpctl io, first station; null if no word has this tag
    /// That a field of this word soon has this value: what dpctl shows may be a moment old.
    ::testing::AssertionResult word_becomes(unsigned tag, const char* field, const Json& value) const;
    std::uint64_t counter(const std::string& group, const std::string& name) const;
    std::uint64_t cycles() const { return counter("unwinder", "data_exchange"); }
    std::uint64_t flaws() const; ///< of the bus, all kinds

    /// How many octets the gateway has put on the bus, as the simulated line counts them.
    std::string spoken_on_the_bus();
    /// What the simulated line counts of its direction "a to b" (to the gateway) or "b to a".
    std::string passed_on_the_bus(const std::string& direction);

private:
    void plug_drive_line();
    void start_drive();

    Wiring wiring_;
    Folder folder_;
    std::unique_ptr<Process> bus_, line_, drive_, daemon_;
};

/// A dpsim master that takes commands.
class Master : public Process {
public:
    /// `settings`: options of dpsim master beside port, rate and slave. The watchdog is a long one unless
    /// they say otherwise.
    Master(const Gateway& gateway, const Arguments& settings, unsigned slave = 5);

    /// Gives a command and waits until it is done; a failure is what the master itself calls one.
    ::testing::AssertionResult does(const std::string& command);
    ::testing::AssertionResult leaves(); ///< "quit", and everything had been as expected

private:
    unsigned commands_ = 0;
};

} // namespace dpslave::test
