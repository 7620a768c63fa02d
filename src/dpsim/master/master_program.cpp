// SPDX-License-Identifier: Apache-2.0
#include "console.hpp"
#include "dpsim/common/programs.hpp"
#include "dpsim/common/system.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace dpslave::sim {
namespace {

/// The master on its tty, with commands that are typed or read from a script.
class Session {
public:
    Session(Master& master, int port, int commands, std::string script, bool prompt)
        : master_(master),
          console_(master, monotonic_now()),
          port_(port),
          input_(commands),
          script_(std::move(script)),
          prompt_(prompt)
    {}

    int run(const Signals& signals)
    {
        ask();
        while (!ended() && !readable(signals.fd())) {
            const int typing = console_.busy() ? -1 : input_.fd();
            wait_readable({signals.fd(), port_, typing},
                          std::min(master_.next_deadline(), console_.next_deadline()));
            if (!turn_port()) return kNo;
            if (typing >= 0 && readable(typing)) input_.read();
            while (!console_.busy() && !ended())
                if (!next_command()) break;
        }
        for (const std::string& line : in_words(master_.counters())) print_line(line);
        return console_.exit();
    }

private:
    bool ended() const
    {
        if (console_.quit() || (console_.exit() != kFine && !prompt_)) return true;
        return input_.ended() && !console_.busy() && !more_;
    }

    /// Returns false if the port is closed.
    bool turn_port()
    {
        const auto octets = read_some(port_);
        if (!octets) {
            print_error("the line is gone");
            return false;
        }
        if (!octets->empty()) master_.on_bytes(*octets, monotonic_now());
        master_.on_time(monotonic_now());
        console_.on_time(monotonic_now());
        if (const auto telegram = master_.take_transmit(monotonic_now()))
            write_all(port_, *telegram, std::chrono::milliseconds{100});
        print();
        if (was_busy_ && !console_.busy()) ask();
        was_busy_ = console_.busy();
        return true;
    }

    bool next_command()
    {
        const auto line = input_.take();
        more_ = line.has_value();
        if (!line) return false;
        ++number_;
        if (!prompt_ && !line->empty()) print_line("> " + *line);
        console_.command(*line, script_.empty() ? std::string{} : fmt::format("{}:{}: ", script_, number_),
                         monotonic_now());
        console_.on_time(monotonic_now());
        print();
        was_busy_ = console_.busy();
        if (!was_busy_) ask();
        return true;
    }

    void print()
    {
        for (const std::string& line : console_.take_lines()) print_line(line);
    }
    void ask() const
    {
        if (!prompt_) return;
        fmt::print("dpsim> ");
        std::fflush(stdout);
    }

    Master& master_;
    Console console_;
    int port_;
    LineReader input_;
    std::string script_;
    bool prompt_;
    bool more_ = true;
    bool was_busy_ = false;
    unsigned number_ = 0;
};

} // namespace

int run_master(const MasterOptions& options)
{
    const bool from_file = !options.script.empty() && options.script != "-";
    Fd file;
    if (from_file) {
        file = Fd{::open(options.script.c_str(), O_RDONLY | O_CLOEXEC)};
        if (file.get() < 0) {
            print_error(fmt::format("--script {}: cannot be read", options.script));
            return kNo;
        }
    }
    const Signals signals;
    const MasterSettings& s = options.settings;
    auto port = open_tty(options.port, static_cast<std::uint32_t>(s.baud), Format::bits8_even);
    if (!port) {
        print_error(port.error());
        return kNo;
    }
    be_prompt();
    const bool prompt = options.script.empty() && ::isatty(STDIN_FILENO) == 1;
    const std::string name = from_file ? options.script : prompt ? "" : "standard input";
    print_line(
        fmt::format("master {} at {} bit/s on {}, slave {}, ident 0x{:04X}, Cfg_Data {}, User_Prm_Data {}",
                    s.address, static_cast<std::uint32_t>(s.baud), options.port, s.slave, s.ident, hex(s.cfg),
                    s.user_prm.empty() ? "none" : hex(s.user_prm)));
    Master master{s};
    return Session{master, port->get(), from_file ? file.get() : STDIN_FILENO, name, prompt}.run(signals);
}

} // namespace dpslave::sim
