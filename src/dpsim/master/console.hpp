// SPDX-License-Identifier: Apache-2.0
/// The commands of `dpsim master`: one a line, the answer in plain words. It is pure: commands and times go
/// in, orders to a Master and lines come out. The cyclic exchange goes on while a command waits.
#pragma once

#include "demand_run.hpp"

#include "dpslave/arguments/exit_status.hpp"

namespace dpslave::sim {

class Console {
public:
    /// `began`: zero of the times that are printed before events.
    Console(Master& master, Instant began) : master_(master), demand_(master), began_(began) {}

    /// Carries out one line. Precondition: !busy(). `place` begins the sentence of a failure ("line 4: ").
    void command(const std::string& line, const std::string& place, Instant now);
    /// Takes the events of the master after each of its turns, and ends what the running command waits for.
    void on_time(Instant now);

    bool busy() const { return wait_.has_value(); }
    Instant next_deadline() const { return wait_ ? wait_->until : kNever; }
    bool quit() const { return quit_; }
    /// The exit status that the first failure demands.
    int exit() const { return exit_; }
    std::vector<std::string> take_lines();
    static std::vector<std::string> help();

private:
    using Words = std::vector<std::string>;
    enum class For : std::uint8_t { start, answer, time, condition, demand };
    struct Wait {
        For what = For::time;
        Instant until = kNever;
        Condition condition{};
        Service service = Service::slave_diag; ///< whose answer
        std::uint64_t cycles = 0;              ///< how many there had been
    };
    struct Command;
    static const std::vector<Command>& commands();

    void do_start(const Words& words, Instant now);
    void do_wait(const Words& words, Instant now);
    void do_run(const Words& words, Instant now);
    void do_expect(const Words& words, Instant now);
    void do_in(const Words& words, Instant now);
    void do_follow(const Words& words, Instant now);
    void do_out(const Words& words, Instant now);
    void do_demand(const Words& words, Instant now);
    void do_global(const Words& words, Instant now);
    void do_unlock(const Words& words, Instant now);
    void do_service(const Words& words, Instant now);

    void take(const MasterEvent& event, Instant now);
    void take_answer(const Answer& answer);
    void check_wait(Instant now);
    void take(DemandRun::Step step);
    void start_refused(const std::string& why, int exit);
    void ask(Order order, Instant now);
    void say(std::string line) { lines_.push_back(std::move(line)); }
    void say(std::vector<std::string> lines);
    void stamp(Instant now, std::string_view words);
    void fail(std::string_view why, int exit = arguments::kNo);

    Master& master_;
    DemandRun demand_;
    Instant began_;
    std::optional<Wait> wait_;
    std::string line_, place_;
    bool tries_ = false; ///< "try": a failure is printed, but does not count
    bool quit_ = false;
    int exit_ = arguments::kFine;
    bool follows_ = false;
    std::vector<std::optional<std::uint16_t>> followed_; ///< the input words as printed last
    Octets last_reply_;
    std::vector<std::string> lines_;
};

} // namespace dpslave::sim
