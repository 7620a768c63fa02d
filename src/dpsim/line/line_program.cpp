// SPDX-License-Identifier: Apache-2.0
#include "dpsim/common/programs.hpp"
#include "dpsim/common/system.hpp"
#include "dpsim/common/values.hpp"
#include "listener.hpp"
#include "pacer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;

/// The sleep ends so long before an octet is due; the rest is spun (measured: a sleep alone is 100 us late at
/// p99).
constexpr auto kSpin = 100us;
/// The interval at which an idle direction looks whether the program ends.
constexpr auto kRest = 100ms;
/// The limit is what a pty holds; a sender that is faster has to wait, as on a real line.
constexpr std::size_t kMostInFlight = 20'000;

/// Returns whether a UART at the rate `heard` understands what is sent at `sent`: beyond 2 % its last bits
/// are others.
bool is_understood(std::uint32_t sent, std::uint32_t heard)
{
    const std::uint32_t off = sent > heard ? sent - heard : heard - sent;
    return std::uint64_t{off} * 50 <= sent;
}

/// One direction with its own thread: reads at one pty, writes at the other when the octets are due. An end
/// that is set to another rate than the line's own sends and reads garbage, unless `any_rate`.
class Direction {
public:
    /// `log`: for what arrives; an empty name: none.
    Direction(Pty& from, Pty& to, Pacer pacer, bool any_rate, const std::string& log)
        : from_(from), to_(to), pacer_(std::move(pacer)), any_rate_(any_rate), has_log_(!log.empty())
    {
        if (has_log_) log_.open(log, std::ios::binary | std::ios::trunc);
        if (has_log_ && !log_) throw std::runtime_error{log + " cannot be written"};
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
        const bool is_logged = !has_log_ || log_.flush();
        return fmt::format(
            "{} octets passed, {} spoilt, {} lost while cut, {} lost because they were not read, {} sent and {} read at another rate{}",
            pacer_.passed(), pacer_.spoilt(), pacer_.lost(), unread_, sent_wrong_, read_wrong_,
            is_logged ? "" : ", the log cannot be written");
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
            if (const auto octets = read_some(from_.master.get()))
                pacer_.take(as_sent(*octets), monotonic_now());
        const Octets due = as_read(pacer_.due_by(monotonic_now()));
        if (due.empty()) return;
        const std::size_t put = write_all(to_.master.get(), due, 0ms);
        if (has_log_)
            log_.write(reinterpret_cast<const char*>(due.data()), static_cast<std::streamsize>(put));
        if (put < due.size()) { // it is not read there: the oldest are lost, as in a UART that overruns
            discard_unread(to_);
            unread_ += due.size() - put;
        }
    }

    /// Returns what a UART at the rate of the line receives of the octets that are sent.
    Octets as_sent(Octets octets)
    {
        if (any_rate_ || octets.empty()) return octets;
        const std::uint32_t sent_at = rate_of(from_);
        if (is_understood(sent_at, pacer_.baud())) return octets;
        sent_wrong_ += octets.size();
        if (sent_at == 0) return {};
        Listener line{pacer_.bits(), sent_at, pacer_.baud()};
        Octets heard = line.hear(octets);
        const Octets last = line.rest();
        heard.insert(heard.end(), last.begin(), last.end());
        return heard;
    }

    /// Returns what the end that reads receives of the octets on the line.
    Octets as_read(Octets octets)
    {
        if (any_rate_ || octets.empty()) return octets;
        const std::uint32_t read_at = rate_of(to_);
        if (is_understood(pacer_.baud(), read_at)) {
            reader_.reset();
            return octets;
        }
        read_wrong_ += octets.size();
        if (read_at == 0) return {};
        if (!reader_ || reader_->sent_at() != pacer_.baud() || reader_->heard_at() != read_at)
            reader_.emplace(pacer_.bits(), pacer_.baud(), read_at);
        Octets heard = reader_->hear(octets);
        if (pacer_.empty()) {
            const Octets last = reader_->rest();
            heard.insert(heard.end(), last.begin(), last.end());
        }
        return heard;
    }

    Pty& from_;
    Pty& to_;
    std::mutex mutex_;
    Pacer pacer_;
    bool any_rate_;
    bool has_log_;
    std::ofstream log_;              ///< what was written to `to_`
    std::optional<Listener> reader_; ///< an end that reads at another rate
    std::uint64_t unread_ = 0, sent_wrong_ = 0, read_wrong_ = 0;
    std::jthread thread_;
};

/// Returns the answer to a command, empty if it is done; nullopt means quit.
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
    if (words[0] == "baud" && words.size() == 2) {
        const auto baud = read_rate(words[1]);
        if (!baud || *baud < kRatesOfALine.least || *baud > kRatesOfALine.most)
            return "write it as: baud 187.5k (50 bit/s to 12M)";
        return both([&](Pacer& pacer) { pacer.set_baud(*baud); });
    }
    if (words[0] == "delay" && words.size() == 2) {
        const auto time = read_duration(words[1], kDelaysOfALine.least, kDelaysOfALine.most);
        if (!time) return "write it as: delay 100us (10s at most)";
        return both([&](Pacer& pacer) { pacer.set_delay(*time); });
    }
    return "commands: " + std::string{kLineCommands};
}

} // namespace

int run_line(const LineOptions& options)
{
    const Signals signals;
    auto a = open_pty(options.baud), b = open_pty(options.baud);
    if (!a || !b) {
        print_error(a ? b.error() : a.error());
        return kNo;
    }
    const auto link_a = Symlink::make(options.a, a->path);
    const auto link_b = link_a ? Symlink::make(options.b, b->path) : Failure{link_a.error()};
    if (!link_b) {
        print_error(link_b.error());
        return kNo;
    }
    const auto pacer = [&](std::uint64_t seed) {
        Pacer made{options.baud, options.bits, seed};
        made.set_errors(options.errors);
        made.set_delay(options.delay);
        return made;
    };
    std::optional<Direction> ab, ba;
    try {
        ab.emplace(*a, *b, pacer(options.seed), options.any_rate, options.log_b);
        ba.emplace(*b, *a, pacer(options.seed + 1), options.any_rate, options.log_a);
    } catch (const std::runtime_error& error) {
        print_error(error.what());
        return kNo;
    }
    print_line(fmt::format("ready {} {}", options.a, options.b));

    LineReader input{STDIN_FILENO};
    const bool typed = ::isatty(STDIN_FILENO) == 1;
    while (!readable(signals.fd())) {
        wait_readable({signals.fd(), input.fd()}, kNever);
        if (readable(input.fd())) input.read();
        while (const auto line = input.take()) {
            const auto said = command(*line, *ab, *ba);
            if (!said) return kFine;
            if (!said->empty()) print_line(*said);
        }
        if (input.closed() && typed) return kFine;
    }
    return kFine;
}

} // namespace dpslave::sim
