// SPDX-License-Identifier: Apache-2.0
#include "simulated_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dpslave::drive_line {

/// The drive has heard the last octet of a question.
void SimulatedLine::ask(std::size_t index, Octets octets, Instant heard)
{
    SimulatedDrive& drive = drives[index];
    ++questions_;
    if (!drive.alive && chance_.happens(faults.noise_of_the_dead))
        say({heard + chance_.between(rules_.turnaround, rules_.timeout), noise(), -1, true, false});
    if (!drive.alive) return;
    if (chance_.happens(faults.question_lost)) return trace("  the question is lost");
    SimulatedDrive::Question question;
    question.octets = std::move(octets);
    question.handed = handed.value_or(time);
    question.is_spoilt = chance_.happens(faults.question_spoilt);
    Time delay = chance_.between(rules_.turnaround, rules_.turnaround * 2);
    if (chance_.happens(faults.late))
        delay = chance_.between(rules_.timeout / 2, rules_.timeout * 10);
    else if (chance_.happens(faults.a_little_late))
        delay = chance_.between(rules_.timeout * 3 / 4, rules_.timeout * 3 / 2);
    question.answered = heard + delay;
    question.carried_out = heard + chance_.between(0ns, delay);
    question.answer_is_lost = chance_.happens(faults.never) || chance_.happens(faults.answer_lost);
    const bool is_sparing =
        drive.answers_every != 0ns && heard + delay < drive.spoke_at + drive.answers_every;
    question.answer_is_lost = question.answer_is_lost || is_sparing;
    // one after the other, and none later than ten timeouts
    const Instant after_last = drive.last_answered + chance_.between(0ns, rules_.turnaround);
    const Instant latest = std::max(drive.last_answered, heard + rules_.timeout * 10);
    question.answered = drive.last_answered = std::min(std::max(question.answered, after_last), latest);
    question.carried_out = drive.last_carried_out = std::max(question.carried_out, drive.last_carried_out);
    drive.questions.push_back(std::move(question));
}

/// It begins before a question, or before the question that is under way has left: by the times at which its
/// octets can be read.
bool SimulatedLine::is_refused_by_time(Instant begins) const
{
    return begins + rules_.port_holds + rules_.character < question_ends_;
}

void SimulatedLine::say(Speech speech)
{
    const auto at =
        std::upper_bound(speeches_.begin(), speeches_.end(), speech.begins,
                         [](Instant begins, const Speech& other) { return begins < other.begins; });
    speeches_.insert(at, std::move(speech));
}

Instant SimulatedLine::next_event() const
{
    Instant at = speeches_.empty() ? kNever : std::max(speeches_.front().begins, wire_free_);
    for (const SimulatedDrive& drive : drives)
        if (!drive.questions.empty()) at = std::min(at, drive.questions.front().carried_out);
    return at;
}

void SimulatedLine::happen(Instant at)
{
    for (std::size_t i = 0; i < drives.size(); ++i) {
        SimulatedDrive& drive = drives[i];
        if (drive.questions.empty() || drive.questions.front().carried_out > at) continue;
        const SimulatedDrive::Question question = std::move(drive.questions.front());
        drive.questions.pop_front();
        drive.live_until(question.carried_out, words_, chance_);
        carried_out_handed_ = question.handed;
        auto answer = carry_out(i, question);
        if (chance_.happens(faults.noise)) say({question.answered, noise(), -1, true, false});
        if (!answer || question.answer_is_lost) {
            if (answer) trace(fmt::format("  an answer of drive {} gets lost", i));
            return;
        }
        const bool is_spoilt = chance_.happens(faults.answer_spoilt);
        const bool twice = !is_spoilt && chance_.happens(faults.duplicate);
        if (is_spoilt) answer = spoilt(std::move(*answer));
        const int who = static_cast<int>(i);
        say({question.answered, std::move(*answer), who, is_spoilt, twice});
        return;
    }
    if (speeches_.empty()) return;
    const Speech speech = std::move(speeches_.front());
    speeches_.erase(speeches_.begin());
    const Instant begins = std::max(speech.begins, wire_free_);
    const bool is_before_a_question = speech.is_repeat && question_ends_ < speech.original_begun;
    if (speech.is_repeat && !is_before_a_question && !faults.beyond_time && !is_refused_by_time(begins))
        return;
    const std::size_t characters = speech.octets.size() * (speech.is_twice ? 2 : 1);
    wire_free_ = begins + rules_.character * static_cast<std::int64_t>(characters);
    heard(speech, begins);
    note_spoken(speech, begins);
    const bool is_whole = speech.drive >= 0 && !speech.is_broken && !speech.is_twice && !speech.is_repeat;
    if (!is_whole || faults.isolated == 0 || !kinds_.happens(faults.isolated)) return;
    Speech again = speech;
    again.is_repeat = true;
    again.original_begun = begins;
    again.begins = wire_free_ + kinds_.between(faults.isolated_from, faults.isolated_to);
    say(std::move(again));
}

/// What began before a question had left names no drive for certain, nor what is not parted from noise or
/// from a lone EOT, ACK or NAK.
void SimulatedLine::note_spoken(const Speech& speech, Instant begins)
{
    // longer than the pauses by which the clients part frames
    const Time pause = 25ms + 40 * rules_.character + 2 * rules_.port_holds;
    const bool is_whole = speech.drive >= 0 && !speech.is_broken;
    const bool is_named = is_whole && begins > noise_ended_ + pause && names_its_drive(speech);
    if (!is_named) noise_ended_ = wire_free_; // what comes close behind it is not parted from it
    if (!is_whole) return;
    SimulatedDrive& drive = drives[static_cast<std::size_t>(speech.drive)];
    drive.spoke_at = wire_free_ + rules_.port_holds;
    if (!is_named || speech.is_repeat || is_refused_by_time(begins)) return;
    drive.named_before = drive.named_at;
    drive.named_at = drive.spoke_at;
}

/// An answer that is still under way then is disturbed by it.
void SimulatedLine::question_on_the_wire(Instant ends)
{
    question_ends_ = ends;
    for (SimulatedDrive& drive : drives) {
        if (drive.named_at <= time) continue;
        drive.named_at = drive.named_before <= time ? drive.named_before : Instant{}; // both may be under way
        noise_ended_ = wire_free_;
    }
}

void SimulatedLine::pass_until(Instant until)
{
    for (Instant at = next_event(); at <= until; at = next_event()) happen(at);
    time = std::max(time, until);
}

void SimulatedLine::dies(std::size_t index)
{
    pass_until(time);
    drives[index].alive = false;
    drives[index].questions.clear();
    drives[index].last_answered = drives[index].last_carried_out = time;
    std::erase_if(speeches_,
                  [index](const Speech& speech) { return speech.drive == static_cast<int>(index); });
    trace(fmt::format("drive {} dies", index));
}

void SimulatedLine::returns(std::size_t index, bool lost_its_settings)
{
    SimulatedDrive& drive = drives[index];
    trace(fmt::format("drive {} is back", index));
    drive.live_until(time, words_, chance_);
    if (!drive.alive) drive.ee = 0x00C0;
    drive.alive = true;
    if (!lost_its_settings) return;
    for (SimulatedTag& tag : drive.tags)
        if (tag.use != TagUse::input) {
            tag.becomes(words_.take(), time);
            tag.disturbed_at = time;
        }
}

void SimulatedLine::refuses(SimulatedTag& tag, bool refuses)
{
    if (traces()) trace(fmt::format("tag {} {}", tag.number, refuses ? "refuses writes" : "takes writes"));
    tag.refuses = refuses;
    tag.disturbed_at = time;
}

void SimulatedLine::denies(SimulatedTag& tag, bool denied)
{
    if (tag.now().denied == denied) return;
    trace(fmt::format("tag {} is {}", tag.number, denied ? "denied from now on" : "there again"));
    tag.history.push_back({time, tag.now().word, denied});
    tag.disturbed_at = time;
}

void SimulatedLine::written(std::size_t drive, SimulatedTag& tag, std::uint16_t word, Instant at)
{
    if (traces()) trace(fmt::format("  drive {} holds {:04X} in tag {}", drive, word, tag.number));
    if (tag.now().word != word) tag.becomes(word, at);
    if (on_write) on_write(drive, tag, word, at);
}

} // namespace dpslave::drive_line
