// SPDX-License-Identifier: Apache-2.0
/// What both protocols have in common on a simulated line: drives that answer in the order in which they
/// were asked, at most once, early, late or never; losses, noise, duplicates, an echo. Time passes only here.
#pragma once

#include "simulated_drive.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace dpslave::drive_line {

using Octets = std::vector<std::uint8_t>;

/// How likely a fault is, in parts of 10000 for each question or answer.
struct Faults {
    unsigned late = 0;          ///< the answer comes up to ten timeouts later
    unsigned a_little_late = 0; ///< up to one and a half
    unsigned never = 0;         ///< the drive does what was asked and says nothing
    unsigned question_lost = 0;
    unsigned question_spoilt = 0; ///< a drive that checks it may refuse it, the others do not hear it
    unsigned answer_lost = 0;
    unsigned answer_spoilt = 0;     ///< never so that its checksum is right
    unsigned duplicate = 0;         ///< right behind the original: both are there before the next question
    unsigned noise = 0;             ///< before, in or behind an answer, or instead of it
    unsigned noise_of_the_dead = 0; ///< noise behind a question to a drive that is not there
    unsigned isolated =
        0; ///< a duplicate comes by itself, `isolated_from` to `isolated_to` behind its original
    Time isolated_from = 1ms, isolated_to = 50ms;
    /// Also the isolated duplicates that time cannot refuse: they begin when a question has left.
    bool beyond_time = false;
};

struct LineTiming {
    Time timeout = 200ms;
    Time turnaround = 4ms; ///< of a prompt drive
    Time character = 1'041'667ns;
    Time port_holds = 0ns; ///< octets come this much later than they were on the wire
    bool echo = false;     ///< the transceiver hears itself
    bool wire_time = true; ///< it says that characters take their time on it
};

class SimulatedLine {
public:
    SimulatedLine(LineTiming rules, Chance& chance)
        : rules_(rules), chance_(chance), kinds_(chance), words_(chance)
    {}
    virtual ~SimulatedLine() = default;
    SimulatedLine(const SimulatedLine&) = delete;
    SimulatedLine& operator=(const SimulatedLine&) = delete;

    std::vector<SimulatedDrive> drives;
    Faults faults;
    Instant time{std::chrono::hours{1}};
    /// When the next question was handed to the port, where that was before it leaves; of none: then.
    std::optional<Instant> handed;
    std::function<void(std::size_t drive, SimulatedTag& tag, std::uint16_t word, Instant at)> on_write;
    std::function<void(const std::string&)> on_trace; ///< empty: no trace

    const LineTiming& rules() const { return rules_; }
    NewWords& words() { return words_; }
    /// Everything up to `until` has happened.
    void pass_until(Instant until);
    void dies(std::size_t drive);
    /// With the power gone its outputs hold other words afterwards.
    void returns(std::size_t drive, bool lost_its_settings);
    void denies(SimulatedTag& tag, bool denied);
    void refuses(SimulatedTag& tag, bool refuses);
    Chance& chance() { return chance_; }
    void trace(const std::string& text) const
    {
        if (on_trace) on_trace(text);
    }
    bool traces() const { return static_cast<bool>(on_trace); }
    std::uint64_t questions() const { return questions_; }
    /// Of the question that is carried out: when it was handed to the port. In on_write.
    Instant carried_out_handed() const { return carried_out_handed_; }
    /// What has come and was not read is lost, as when the port is closed.
    virtual void lose_input() = 0;

protected:
    /// Octets on the wire from `begins` on, each for its time.
    struct Speech {
        Instant begins{};
        Octets octets;
        int drive = -1; ///< who speaks; -1: noise
        bool is_broken = false;
        bool is_twice = false;
        bool is_repeat = false; ///< an isolated duplicate
        Instant original_begun{};
    };

    void ask(std::size_t drive, Octets octets, Instant heard);
    void written(std::size_t drive, SimulatedTag& tag, std::uint16_t word, Instant at);
    Instant next_event() const; ///< of drives and speeches
    void happen(Instant at);    ///< the one that is next
    void question_on_the_wire(Instant ends);
    void wire_is_busy_until(Instant at) { wire_free_ = std::max(wire_free_, at); }

    /// Carries a question out and gives the answer; nothing: the drive says nothing to it.
    virtual std::optional<Octets> carry_out(std::size_t drive, const SimulatedDrive::Question& question) = 0;
    /// Can the answer only be of its drive, in time or late?
    virtual bool names_its_drive(const Speech& speech) const = 0;
    /// What came over the wire, from `begins` on.
    virtual void heard(const Speech& speech, Instant begins) = 0;
    virtual Octets spoilt(Octets answer) = 0;
    virtual Octets noise() = 0;
    /// A second source, for what kind a fault is: drawing from it changes no other fault of a seed.
    Chance& kinds() { return kinds_; }

private:
    void say(Speech speech);
    void note_spoken(const Speech& speech, Instant begins);
    bool is_refused_by_time(Instant begins) const;

    LineTiming rules_;
    Chance& chance_;
    Chance kinds_;
    NewWords words_;
    std::vector<Speech> speeches_; ///< those to come, by their beginning
    Instant wire_free_{};
    Instant noise_ended_{};   ///< of what was no whole answer
    Instant question_ends_{}; ///< of the last one: its last octet has left
    std::uint64_t questions_ = 0;
    Instant carried_out_handed_{};
};

} // namespace dpslave::drive_line
