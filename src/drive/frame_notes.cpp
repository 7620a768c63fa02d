// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/frame_notes.hpp"

#include <algorithm>
#include <array>

namespace dpslave::drive {

namespace {

struct Words {
    std::string_view name, text;
};
/// The words are in the order of Judgement.
constexpr std::array<Words, kJudgements> kWords{{
    {"taken", "taken"},
    {"refused", "the drive refuses"},
    {"older", "taken; it may answer an older question"},
    {"before_write", "not taken: it may be older than the last write"},
    {"doubtful", "not taken: it may belong to another write"},
    {"late", "late: it answers an older question"},
    {"unclear", "not taken: nothing waits for it"},
    {"duplicate", "not taken: a duplicate"},
    {"foreign", "foreign: it answers nothing that was asked"},
    {"echo", "echo of the question"},
    {"bad_checksum", "not taken: wrong checksum"},
    {"bad_character", "not taken: a bad character"},
    {"truncated", "not taken: it broke off, or its length is wrong"},
    {"no_frame", "no frame"},
    {"early", "not taken: it began before the question had left"},
    {"noise_before", "noise before the frame"},
}};

} // namespace

std::string_view text(Judgement judgement) noexcept
{
    return kWords.at(static_cast<std::size_t>(judgement)).text;
}

std::string_view name(Judgement judgement) noexcept
{
    return kWords.at(static_cast<std::size_t>(judgement)).name;
}

void FrameNotes::emit(TracedFrame::What what, Judgement judgement, Instant begun, Instant at, Bytes octets)
{
    TracedFrame frame;
    frame.what = what;
    frame.protocol = protocol_;
    frame.drive = drive_;
    frame.judgement = judgement;
    frame.begun = begun;
    frame.at = at;
    frame.octets = octets;
    listener_->on_frame(frame);
}

void FrameNotes::sent(std::uint8_t drive, Bytes octets, Instant begun)
{
    if (listener_ == nullptr) return;
    silence();
    drive_ = drive;
    emit(TracedFrame::What::sent, Judgement::taken, begun,
         begun + character_ * static_cast<std::int64_t>(octets.size()), octets);
}

void FrameNotes::received(Bytes octets, Instant read_at)
{
    if (listener_ == nullptr || octets.empty()) return;
    if (octets.size() > kMost - octets_.size()) silence();
    if (octets_.empty()) first_read_ = read_at;
    octets_.append(octets.first(std::min(octets.size(), kMost)));
    last_read_ = read_at;
}

void FrameNotes::judge(Judgement judgement)
{
    until_silence_.reset();
    if (octets_.empty()) return;
    // On a pty octets may come faster than the rate lets them.
    const Instant begun = std::min(first_read_ - character_,
                                   last_read_ - character_ * static_cast<std::int64_t>(octets_.size()));
    emit(TracedFrame::What::heard, judgement, begun, last_read_, octets_);
    octets_.clear();
}

void FrameNotes::silence()
{
    judge(until_silence_.value_or(Judgement::no_frame));
}

void FrameNotes::no_answer(Instant now)
{
    if (listener_ == nullptr) return;
    silence();
    emit(TracedFrame::What::silence, Judgement::no_frame, now, now, {});
}

} // namespace dpslave::drive
