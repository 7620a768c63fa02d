// SPDX-License-Identifier: Apache-2.0
#include "answer_judge.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::sim {
namespace {

constexpr std::uint8_t kDl = 0x08, kDh = 0x0A, kSapRdInp = 56;
/// These bits of Slave_Diag (wire reference 5.1) follow from the drive.
constexpr std::uint8_t kExtDiag = 0x08, kStatDiag = 0x02, kOverflow = 0x80;
constexpr std::size_t kStandardDiagnosis = 6;

std::optional<Frame> frame_of(const Octets& octets)
{
    const auto length = frame_length(octets);
    if (!length || *length == 0 || *length != octets.size()) return std::nullopt;
    const auto frame = decode(octets);
    return frame ? std::optional<Frame>{*frame} : std::nullopt;
}

bool has_fc(const Frame& frame)
{
    return frame.kind != FrameKind::short_ack && frame.kind != FrameKind::token;
}

bool is_request(const Frame& frame)
{
    return has_fc(frame) && (frame.fc & 0x40) != 0;
}

/// A reply of Data_Exchange with inputs: no SAP, DL or DH.
bool has_inputs(const Frame& frame)
{
    return has_fc(frame) && !frame.ssap && (frame.fc == kDl || frame.fc == kDh);
}

/// Data unit by 16 bits; an odd octet at the end is a word by itself.
std::uint16_t word_at(const Octets& data, std::size_t at)
{
    const unsigned high = data[at];
    return static_cast<std::uint16_t>(high << 8 | (at + 1 < data.size() ? data[at + 1] : 0U));
}

void clear(std::uint8_t& octet, std::uint8_t bit)
{
    octet = static_cast<std::uint8_t>(octet & ~bit);
}

/// DH without inputs is SD1, DL without inputs is SC (wire reference 4.7).
bool is_dh_without_inputs(const Frame& answer, const Frame& request)
{
    return answer.kind == FrameKind::no_data && answer.fc == kDh && !request.dsap &&
           answer.sa == request.da && answer.da == request.sa;
}

/// The answer without what depends on the drive side, or on when it answered.
Frame masked(Frame frame, const Frame& request, DriveSide drive)
{
    if (is_dh_without_inputs(frame, request)) return {.kind = FrameKind::short_ack};
    frame.kind = frame.kind == FrameKind::fixed ? FrameKind::variable : frame.kind;
    if (has_inputs(frame)) {
        frame.fc = kDl; // whether a diagnosis waits: the first inputs end that of the start-up
        std::fill(frame.data.begin(), frame.data.end(), std::uint8_t{0});
    } else if (frame.ssap == kSapRdInp && drive == DriveSide::unknown) {
        std::fill(frame.data.begin(), frame.data.end(), std::uint8_t{0});
    } else if (frame.ssap == kSapSlaveDiag && frame.data.size() >= kStandardDiagnosis) {
        clear(frame.data[1], kStatDiag);
        if (drive == DriveSide::unknown) {
            clear(frame.data[0], kExtDiag);
            clear(frame.data[2], kOverflow);
            std::fill(frame.data.begin() + kStandardDiagnosis, frame.data.end(), std::uint8_t{0});
        }
    }
    return frame;
}

bool equal(const Frame& a, const Frame& b)
{
    return a.kind == b.kind && a.da == b.da && a.sa == b.sa && a.fc == b.fc && a.dsap == b.dsap &&
           a.ssap == b.ssap && a.data == b.data;
}

std::string first_difference(const Octets& was, const Octets& is)
{
    if (was.size() != is.size()) return fmt::format("it has {} octets, there {}", is.size(), was.size());
    const auto [a, b] = std::mismatch(was.begin(), was.end(), is.begin());
    return fmt::format("octet {} is {:02X}, there {:02X}", a - was.begin() + 1, *b, *a);
}

} // namespace

AnswerJudge::AnswerJudge(const ReplayScript& script, DriveSide drive) : script_(script), drive_(drive)
{
    std::map<std::uint8_t, std::size_t> layout_of; // slave -> its present layout
    for (const ReplayStep& step : script.steps) {
        const auto request = frame_of(step.octets);
        const bool counts = request && is_request(*request);
        const std::uint8_t slave = counts ? request->da : kBroadcast;
        if (layout_of.count(slave) == 0 || (counts && request->dsap == kSapChkCfg)) {
            layout_of[slave] = words_.size();
            words_.emplace_back();
        }
        layout_.push_back(layout_of[slave]);
        const auto answer = step.answer ? frame_of(*step.answer) : std::nullopt;
        if (!answer || !has_inputs(*answer)) continue;
        for (std::size_t at = 0; at < answer->data.size(); at += 2)
            words_[layout_.back()][at].insert(word_at(answer->data, at));
    }
}

std::string AnswerJudge::odd_input(std::size_t step, const Octets& data) const
{
    const Words& words = words_[layout_[step]];
    for (std::size_t at = 0; at < data.size(); at += 2) {
        const auto known = words.find(at);
        if (known == words.end() || known->second.count(word_at(data, at)) == 0)
            return fmt::format("input word {} is {:04X}, which no answer of this configuration has there",
                               at / 2 + 1, word_at(data, at));
    }
    return {};
}

AnswerJudge::Verdict AnswerJudge::judge(std::size_t step, const Octets& heard) const
{
    const Octets& wanted = *script_.steps[step].answer;
    if (wanted == heard) return {.is_same = true};
    const auto request = frame_of(script_.steps[step].octets), was = frame_of(wanted), is = frame_of(heard);
    if (!request || !was || !is || !equal(masked(*was, *request, drive_), masked(*is, *request, drive_)))
        return {.why = first_difference(wanted, heard)};
    if (drive_ == DriveSide::capture && has_inputs(*is))
        if (std::string odd = odd_input(step, is->data); !odd.empty()) return {.why = std::move(odd)};
    return {.is_same = true, .is_masked = true};
}

} // namespace dpslave::sim
