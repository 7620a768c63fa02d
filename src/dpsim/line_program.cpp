// SPDX-License-Identifier: Apache-2.0
#include "dpsim/edge.hpp"
#include "dpsim/pacer.hpp"
#include "dpsim/programs.hpp"
#include "dpsim/values.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <mutex>
#include <thread>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;

/// The sleep ends so long before an octet is due; the rest is spun (measured: a sleep alone is 100 us late at
/// p99).
constexpr auto kSpin = 100us;
/// How often a resting direction looks whether the program ends.
constexpr auto kRest = 100ms;
/// As much as a pty holds; a sender that is faster has to wait, as on a real line.
constexpr std::size_t kMostInFlight = 20'000;

/// One direction with its own thread: reads at one pty, writes at the other when the octets are due.
class Direction {
public:
    Direction(Pty& from, Pty& to, Pacer pacer) : from_(from), to_(to), pacer_(std::move(pacer))
    {
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }

    template <class Change>
    void change(Change&& how)
    {
        const std::lock_guard lock(mutex_);
        how(pacer_);
    }
    std::string stats()
    {
        const std::lock_guard lock(mutex_);
        return fmt::format("{} octets passed, {} spoilt, {} lost while cut, {} lost because nobody read",
                           pacer_.passed(), pacer_.spoilt(), pacer_.lost(), unread_);
    }

private:
    void run(const std::stop_token& stop)
    {
        be_prompt();
        while (!stop.stop_requested()) {
            const Instant due = next_due();
            if (due == kNever) {
                wait_readable({from_.master.get()}, monotonic_now() + kRest);
            } else {
                if (due - monotonic_now() > kSpin)
                    sleep_until(std::min(due - kSpin, monotonic_now() + kRest));
                while (due - monotonic_now() <= kSpin && monotonic_now() < due) {
                }
            }
            turn();
        }
    }

    Instant next_due()
    {
        const std::lock_guard lock(mutex_);
        return pacer_.next_due();
    }

    void turn()
    {
        const std::lock_guard lock(mutex_);
        if (pacer_.in_flight() < kMostInFlight)
            if (const auto octets = read_some(from_.master.get())) pacer_.take(*octets, monotonic_now());
        const Octets due = pacer_.due_by(monotonic_now());
        if (due.empty()) return;
        std::size_t put = write_all(to_.master.get(), due, 0ms);
        if (put < due.size()) { // nobody reads there: what is old is worthless, as in a UART that overruns
            discard_unread(to_);
            unread_ += due.size() - put;
        }
    }

    Pty& from_;
    Pty& to_;
    std::mutex mutex_;
    Pacer pacer_;
    std::uint64_t unread_ = 0;
    std::jthread thread_;
};

const std::string kHelp = "cut | restore | errors P | delay US | stats | quit";

/// What is to be said; empty = done. Nothing: quit.
std::optional<std::string> command(const std::string& line, Direction& ab, Direction& ba)
{
    const auto words = words_of(line);
    if (words.empty()) return "";
    const auto both = [&](const auto& how) {
        ab.change(how);
        ba.change(how);
        return std::string{};
    };
    if (words[0] == "cut" || words[0] == "restore")
        return both([&](Pacer& p) { p.set_cut(words[0] == "cut"); });
    if (words[0] == "stats") return "a to b: " + ab.stats() + "\nb to a: " + ba.stats();
    if (words[0] == "quit") return std::nullopt;
    if (words[0] == "errors" && words.size() == 2) {
        char* end = nullptr;
        const double p = std::strtod(words[1].c_str(), &end);
        if (*end != '\0' || !(p >= 0 && p <= 1)) return "errors: a probability per bit, 0 to 1";
        return both([&](Pacer& pacer) { pacer.set_errors(p); });
    }
    if (words[0] == "delay" && words.size() == 2) {
        const auto us = number_of(words[1]);
        if (!us || *us < 0 || *us > 10'000'000) return "delay: microseconds, 0 to 10000000";
        return both([&](Pacer& pacer) { pacer.set_delay(std::chrono::microseconds{*us}); });
    }
    return "commands: " + kHelp;
}

} // namespace

int run_line(const LineOptions& options)
{
    const Signals signals;
    auto a = open_pty(options.baud), b = open_pty(options.baud);
    if (!a || !b) {
        print_error(a ? b.error() : a.error());
        return kNoPort;
    }
    auto link_a = Symlink::make(options.a, a->path);
    if (!link_a) {
        print_error(link_a.error());
        return kNoPort;
    }
    auto link_b = Symlink::make(options.b, b->path);
    if (!link_b) {
        print_error(link_b.error());
        return kNoPort;
    }
    const auto pacer = [&](std::uint64_t seed) {
        Pacer made{options.baud, options.bits, seed};
        made.set_errors(options.errors);
        made.set_delay(std::chrono::microseconds{options.delay_us});
        return made;
    };
    Direction ab{*a, *b, pacer(options.seed)}, ba{*b, *a, pacer(options.seed + 1)};
    print_line(fmt::format("ready {} {}", options.a, options.b));

    LineReader input{STDIN_FILENO};
    const bool typed = ::isatty(STDIN_FILENO) == 1;
    while (!readable(signals.fd())) {
        wait_readable({signals.fd(), input.fd()}, kNever);
        if (readable(input.fd())) input.read();
        while (const auto line = input.take()) {
            const auto said = command(*line, ab, ba);
            if (!said) return kFine;
            if (!said->empty()) print_line(*said);
        }
        if (input.closed() && typed) return kFine;
    }
    return kFine;
}

} // namespace dpslave::sim
