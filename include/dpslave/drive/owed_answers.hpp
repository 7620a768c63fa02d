// SPDX-License-Identifier: Apache-2.0
/// Decides which answer belongs to which question, for both protocols. A question whose answer has not come
/// is owed by its drive, and an answer is accepted only if it can belong to no other one.
/// It is pure: questions and answers come in with their times. docs/internals/drive-answers.md argues the
/// rules.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

namespace dpslave::drive {

/// All that an answer with a checksum shows of its question: in EI-ASCII the mnemonic, in Modbus unit,
/// function and octets. Equal forms cannot be distinguished.
using Form = std::uint32_t;
inline constexpr Form kNoForm = 0; ///< an answer without a checksum, or none of this kind

/// A drive of the line, as its protocol numbers them.
using DriveNumber = std::uint16_t;

struct Question {
    DriveNumber drive = 0;
    Form answer = kNoForm;  ///< EI-ASCII: none of a write, which is answered by a lone ACK or NAK
    Form refusal = kNoForm; ///< of Modbus: the exception
    bool is_write = false;
    Form written = kNoForm; ///< of a write: the form in which a read shows the same tag; of a read none
    std::chrono::nanoseconds wire_time{}; ///< of its longest answer
};

/// Counts everything that came from a drive except answers in time, for diagnosis.
struct AnswerCounts {
    std::uint64_t damaged = 0;      ///< frames with a wrong checksum, a parity error or an invalid format
    std::uint64_t bad_checksum = 0; ///< those of them that were complete but for it; EI-ASCII
    std::uint64_t not_accepted = 0; ///< requests that the drive refused because of their checksum; EI-ASCII:
                                    ///< EE 02
    std::uint64_t late = 0;         ///< answers after their timeout
    std::uint64_t foreign = 0;      ///< frames that answer nothing that was asked
    std::uint64_t came_back = 0;    ///< requests heard again though the line has no echo by its settings
    std::uint64_t early = 0; ///< answers that had begun before the question had left: they belong to none
    std::uint64_t noise = 0; ///< octets before an answer that are no part of it; Modbus: also instead of one
    std::uint32_t late_in_a_row = 0;  ///< late ones since the last answer in time
    std::chrono::nanoseconds delay{}; ///< the longest of them, from the last octet of its question
    /// The time of the last frame with a checksum that can only be of this drive, in time or late; default:
    /// never.
    Instant valid_at{};
    friend bool operator==(const AnswerCounts&, const AnswerCounts&) = default;
};

/// After this number of late answers in a row, and none in time, the drive is always late: timeout_ms is too
/// short for it.
inline constexpr std::uint32_t kAlwaysLate = 3;

/// The timeout_ms that a drive needs which is always late: its delay and a quarter. 0: it is not.
std::chrono::milliseconds needed_timeout(const AnswerCounts& counts);

class OwedAnswers {
public:
    /// An answer names this beside its form. tag (EI-ASCII): the same drive may be asked again while it owes
    /// an answer, no other one. drive (Modbus): no question of an owed form may be asked.
    enum class Names : std::uint8_t { tag, drive };

    enum class Verdict : std::uint8_t {
        answer,          ///< to the question asked last and to no other
        answer_or_older, ///< of this drive and tag, maybe to an older question: right, but no proof of a
                         ///< write
        before_write,    ///< the same, and it may be older than the last write of this tag
        owed,            ///< to an older question
        duplicate,       ///< of a frame since the last question
        foreign,         ///< to none
    };

    /// `settle` says how late an answer may come after the last octet of its question, including the time for
    /// which the port holds octets back; the wire time of all owed answers is added.
    OwedAnswers(Names names, std::chrono::nanoseconds settle) : names_(names), settle_(settle) {}

    /// Returns whether the answer could be assigned to this question; if not, the question must not be asked.
    bool may_ask(const Question& question, Instant now) const;
    /// Ends the debts whose answers can no longer come. Precondition: heard() has everything that came until
    /// `now`. Otherwise an old answer that still waits in the port would end a younger debt.
    void settle(Instant now);
    /// The last octet of `question` leaves at `at`. An answer to it begins at `answers_from` or later; by
    /// default at any time, where nothing takes wire time.
    void asked(const Question& question, Instant at, Instant answers_from = Instant::min());

    /// Rule of time: what began at `begun` at the latest was there before the question asked last had left.
    /// It answers nothing and ends no debt, whatever it looks like.
    bool is_too_early(Instant begun) const { return begun < answers_from_; }

    /// Takes a frame with a valid checksum, and ends the debts that it answers.
    Verdict heard(Form form, Bytes frame, Instant at);
    /// Takes an ACK. Returns true if it belongs to the write asked last, whose debt then ends; else it is
    /// doubtful and ends nothing.
    bool take_ack();
    /// Ends the wait for the question asked last; its answer stays owed.
    void wait_is_over() { waits_ = false; }
    /// A question of which it is not known whether it has left, by `at`: its answer is not waited for, and is
    /// owed.
    void may_answer(const Question& question, Instant at)
    {
        asked(question, at);
        wait_is_over();
    }

    /// Returns, before the next question, whether this drive owes an answer, or one of this form.
    bool owes(DriveNumber drive) const;
    bool owes(DriveNumber drive, Form form) const;
    bool owes_write(DriveNumber drive) const;
    bool is_owed(Form form) const; ///< by any drive, as answer or refusal
    bool empty() const { return owed_.empty(); }
    /// Forgets all owed answers, because the port was just opened.
    void clear();

    void damaged(DriveNumber drive) { ++counts_[drive].damaged; }
    void bad_checksum(DriveNumber drive) { ++counts_[drive].bad_checksum; } ///< beside damaged()
    void not_accepted(DriveNumber drive) { ++counts_[drive].not_accepted; }
    void foreign(DriveNumber drive) { ++counts_[drive].foreign; }
    void count_return(DriveNumber drive) { ++counts_[drive].came_back; }
    void early(DriveNumber drive) { ++counts_[drive].early; }
    void noise(DriveNumber drive) { ++counts_[drive].noise; }
    /// A frame that can only be of this drive, whatever it answers. heard() says so where answers name a tag
    /// that only this drive owes; where they name the drive, it is the caller's to say.
    void valid(DriveNumber drive, Instant at) { counts_[drive].valid_at = at; }
    AnswerCounts counts(DriveNumber drive) const;

private:
    struct Debt {
        Question question;
        Instant asked_at{};
        bool before_write = false; ///< its tag was written after it was asked
    };
    static bool fits(const Debt& debt, Form form);
    bool is_duplicate(Bytes frame);
    void end_debts_of(DriveNumber drive);
    void note_late(const Debt& debt, Instant at);
    void note_valid(Form form, Instant at);
    Instant settles_at(const Debt& debt) const;

    Names names_;
    std::chrono::nanoseconds settle_;
    std::vector<Debt> owed_; ///< in the order in which they were asked; the last one may be under way
    bool waits_ = false;     ///< the last one is under way
    Instant answers_from_ = Instant::min();        ///< to the question asked last
    std::vector<std::vector<std::uint8_t>> heard_; ///< since the last question
    std::map<DriveNumber, AnswerCounts> counts_;
};

} // namespace dpslave::drive
