// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/owed_answers.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

/// Frames since the last question that are compared: a line that never stops sending is not remembered for
/// ever.
constexpr std::size_t kMostHeard = 16;

} // namespace

std::chrono::milliseconds needed_timeout(const AnswerCounts& counts)
{
    if (counts.late_in_a_row < kAlwaysLate) return {};
    return std::chrono::ceil<std::chrono::milliseconds>(counts.delay * 5 / 4);
}

bool OwedAnswers::fits(const Debt& debt, Form form)
{
    return form != kNoForm && (debt.question.answer == form || debt.question.refusal == form);
}

/// Each debt has its own time, from the last octet of its own question.
Instant OwedAnswers::settles_at(const Debt& debt) const
{
    std::chrono::nanoseconds wire_time{};
    for (const Debt& other : owed_) wire_time += other.question.wire_time;
    return debt.asked_at + settle_ + wire_time;
}

void OwedAnswers::settle(Instant now)
{
    if (owed_.empty()) return;
    std::vector<Debt> left;
    for (const Debt& debt : owed_)
        if (now < settles_at(debt)) left.push_back(debt);
    owed_ = std::move(left);
}

bool OwedAnswers::may_ask(const Question& question, Instant now) const
{
    return std::none_of(owed_.begin(), owed_.end(), [&](const Debt& debt) {
        const bool alike = fits(debt, question.answer) && now < settles_at(debt);
        return alike && (names_ == Names::drive || debt.question.drive != question.drive);
    });
}

void OwedAnswers::asked(const Question& question, Instant at, Instant answers_from)
{
    answers_from_ = answers_from;
    for (Debt& debt : owed_)
        if (debt.question.drive == question.drive && fits(debt, question.written)) debt.before_write = true;
    owed_.push_back({question, at, false});
    waits_ = true;
    heard_.clear();
}

bool OwedAnswers::is_duplicate(Bytes frame)
{
    const auto same = [&](const auto& one) { return std::ranges::equal(one, frame); };
    if (std::any_of(heard_.begin(), heard_.end(), same)) return true;
    if (heard_.size() < kMostHeard) heard_.emplace_back(frame.begin(), frame.end());
    return false;
}

/// It has answered the question asked last, and answers in the order in which it was asked: whatever else it
/// was asked is answered, or never will be.
void OwedAnswers::end_debts_of(DriveNumber drive)
{
    owed_.erase(std::remove_if(owed_.begin(), owed_.end(),
                               [drive](const Debt& debt) { return debt.question.drive == drive; }),
                owed_.end());
    counts_[drive].late_in_a_row = 0;
}

void OwedAnswers::note_late(const Debt& debt, Instant at)
{
    AnswerCounts& counts = counts_[debt.question.drive];
    const auto delay = at - debt.asked_at;
    counts.delay = counts.late_in_a_row == 0 ? delay : std::max(counts.delay, delay);
    ++counts.late;
    ++counts.late_in_a_row;
}

/// A sign of life of the drive that owes it. If several drives owe this form, any of them may have sent it.
void OwedAnswers::note_valid(Form form, Instant at)
{
    const Debt* only = nullptr;
    for (const Debt& debt : owed_) {
        if (!fits(debt, form)) continue;
        if (only != nullptr && only->question.drive != debt.question.drive) return;
        only = &debt;
    }
    if (only != nullptr) valid(only->question.drive, at);
}

OwedAnswers::Verdict OwedAnswers::heard(Form form, Bytes frame, Instant at)
{
    if (names_ == Names::tag) note_valid(form, at);
    if (is_duplicate(frame)) return Verdict::duplicate;
    const auto oldest =
        std::find_if(owed_.begin(), owed_.end(), [form](const Debt& debt) { return fits(debt, form); });
    if (oldest == owed_.end()) return Verdict::foreign;
    const auto asked_last = owed_.end() - 1;
    if (!waits_ || !fits(*asked_last, form)) {
        note_late(*oldest, at);
        owed_.erase(oldest);
        return Verdict::owed;
    }
    if (oldest == asked_last) { // no owed answer looks like it
        waits_ = false;
        end_debts_of(asked_last->question.drive);
        return Verdict::answer;
    }
    const bool of_others = std::any_of(oldest, asked_last, [&](const Debt& debt) {
        return fits(debt, form) && debt.question.drive != asked_last->question.drive;
    });
    const bool before_write = std::any_of(
        oldest, asked_last, [&](const Debt& debt) { return fits(debt, form) && debt.before_write; });
    const bool right = names_ == Names::tag && !of_others;
    if (right)
        waits_ = false; // one answer stays owed
    else
        note_late(*oldest, at);
    owed_.erase(oldest);
    if (!right) return Verdict::owed;
    return before_write ? Verdict::before_write : Verdict::answer_or_older;
}

bool OwedAnswers::take_ack()
{
    const auto writes =
        std::count_if(owed_.begin(), owed_.end(), [](const Debt& debt) { return debt.question.is_write; });
    if (!waits_ || writes != 1 || !owed_.back().question.is_write) return false;
    counts_[owed_.back().question.drive].late_in_a_row = 0;
    owed_.pop_back();
    waits_ = false;
    return true;
}

bool OwedAnswers::owes(DriveNumber drive) const
{
    return std::any_of(owed_.begin(), owed_.end(),
                       [drive](const Debt& debt) { return debt.question.drive == drive; });
}

bool OwedAnswers::owes(DriveNumber drive, Form form) const
{
    return std::any_of(owed_.begin(), owed_.end(),
                       [&](const Debt& debt) { return debt.question.drive == drive && fits(debt, form); });
}

bool OwedAnswers::owes_write(DriveNumber drive) const
{
    return std::any_of(owed_.begin(), owed_.end(), [drive](const Debt& debt) {
        return debt.question.drive == drive && debt.question.is_write;
    });
}

bool OwedAnswers::is_owed(Form form) const
{
    return std::any_of(owed_.begin(), owed_.end(), [form](const Debt& debt) { return fits(debt, form); });
}

void OwedAnswers::clear()
{
    owed_.clear();
    heard_.clear();
    waits_ = false;
    answers_from_ = Instant::min();
}

AnswerCounts OwedAnswers::counts(DriveNumber drive) const
{
    const auto found = counts_.find(drive);
    return found == counts_.end() ? AnswerCounts{} : found->second;
}

} // namespace dpslave::drive
