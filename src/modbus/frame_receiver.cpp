// SPDX-License-Identifier: Apache-2.0
#include "frame_receiver.hpp"

#include "pdu.hpp"

#include "dpslave/drive/wire_time.hpp"

#include <algorithm>

namespace dpslave::modbus {
namespace {

constexpr std::size_t kAround = 3;   ///< unit and checksum
constexpr std::size_t kShortest = 5; ///< an exception

/// Returns the function that an exception refuses.
constexpr std::uint8_t function_of(std::uint8_t code)
{
    return static_cast<std::uint8_t>(code & ~unsigned{kIsException});
}

/// Returns the length of the answer with this beginning, unit first, with checksum; 0 if there is none.
std::size_t length_of_answer(Bytes octets)
{
    if (octets.size() < 3) return 0;
    const std::uint8_t function = function_of(octets[1]);
    const bool is_read = function == kReadRegisters || function == kReadInputRegisters;
    const bool is_known =
        is_read || function == kWriteRegister || function == kWriteRegisters || function == kLoopback;
    if (!is_known) return 0;
    if (octets[1] != function) return kShortest;
    if (!is_read) return kAround + 5;
    const std::size_t count = octets[2];
    return count == 0 || count % 2 != 0 || count > 2 * kMostRegisters ? 0 : kAround + 2 + count;
}

} // namespace

std::uint16_t crc16(Bytes octets)
{
    std::uint16_t crc = 0xFFFF;
    for (const std::uint8_t octet : octets) {
        crc = static_cast<std::uint16_t>(crc ^ octet);
        for (int bit = 0; bit < 8; ++bit)
            crc = static_cast<std::uint16_t>((crc & 1) != 0 ? crc >> 1 ^ 0xA001 : crc >> 1);
    }
    return crc;
}

void FrameReceiver::sent(std::uint8_t unit, Bytes pdu)
{
    units_.set(unit);
    request_.assign(1, unit);
    request_.insert(request_.end(), pdu.begin(), pdu.end());
    const std::uint16_t crc = crc16(request_);
    request_.push_back(static_cast<std::uint8_t>(crc & 0xFF));
    request_.push_back(static_cast<std::uint8_t>(crc >> 8));
}

/// Is what came as long as an answer with this beginning, or the complete request?
bool FrameReceiver::has_length() const
{
    const std::size_t length = octets_.size();
    if (octets_ == request_) return true;
    if (length < kShortest) return false;
    const std::uint8_t function = octets_[1];
    if ((function & kIsException) != 0) return length == kShortest;
    switch (function) {
        case kReadRegisters:
        case kReadInputRegisters: return length == kAround + 2 + octets_[2];
        case kWriteRegister:
        case kWriteRegisters:
        case kLoopback: return length == kAround + 5;
        default: return false;
    }
}

/// Returns whether unit and function asked are at this place, as far as octets have come.
bool FrameReceiver::is_asked(std::size_t from) const
{
    if (request_.empty() || octets_[from] != request_[0]) return false;
    return from + 1 == octets_.size() || function_of(octets_[from + 1]) == request_[1];
}

/// Does a frame that is waited for begin there and end with what came last?
bool FrameReceiver::is_wanted(std::size_t from) const
{
    const Bytes part = Bytes{octets_}.subspan(from);
    if (!is_asked(from) || part.size() < kShortest) return false;
    const bool is_whole = length_of_answer(part) == part.size() || std::ranges::equal(part, request_);
    return is_whole && crc16(part) == 0 && !is_inside_another(from);
}

/// Returns the length of the request or of the answer of a unit of the line that begins there; 0 if neither
/// does.
std::size_t FrameReceiver::extent(std::size_t from) const
{
    const Bytes part = Bytes{octets_}.subspan(from);
    if (!units_.test(part[0])) return 0;
    const std::size_t common = std::min(part.size(), request_.size());
    const bool is_request =
        std::equal(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(common), request_.begin());
    return std::max(length_of_answer(part), is_request ? request_.size() : 0);
}

bool FrameReceiver::is_inside_another(std::size_t from) const
{
    for (std::size_t at = 0; at < from; ++at)
        if (at + extent(at) >= octets_.size()) return true;
    return false;
}

bool FrameReceiver::answer_has_begun() const
{
    if (request_.empty()) return true; // nothing is known of what is asked
    for (std::size_t at = 0; at < octets_.size(); ++at)
        if (is_asked(at)) return true;
    return false;
}

/// Returns the octets that were fed as noise and a frame after it.
FrameReceiver::Found FrameReceiver::frame_from(std::size_t from)
{
    const auto begin = octets_.begin() + static_cast<std::ptrdiff_t>(from);
    noise_.assign(octets_.begin(), begin);
    piece_.assign(begin, octets_.end());
    frame_.assign(begin, octets_.end() - 2);
    frame_ends_.assign(ends_.begin() + static_cast<std::ptrdiff_t>(from), ends_.end());
    octets_.clear();
    ends_.clear();
    behind_fault_ = 0;
    return Found::frame;
}

FrameReceiver::Found FrameReceiver::broken(drive::Judgement flaw)
{
    flaw_ = flaw;
    piece_.swap(octets_);
    octets_.clear();
    ends_.clear();
    behind_fault_ = 0;
    return Found::broken;
}

Instant FrameReceiver::begun(std::chrono::nanoseconds character) const
{
    drive::FrameBegin begin{character};
    for (const Instant end : frame_ends_) begin.octet(end, 0);
    return begin.latest();
}

FrameReceiver::Found FrameReceiver::feed(std::uint8_t octet, Instant end)
{
    if (skips_) {
        if (rest_.size() < kLongestFrame) rest_.push_back(octet);
        return Found::nothing;
    }
    octets_.push_back(octet);
    ends_.push_back(end);
    if (behind_fault_ == 0 && has_length() && crc16(octets_) == 0) // over a frame with its checksum
        return frame_from(0);
    for (std::size_t from = std::max<std::size_t>(behind_fault_, 1); from < octets_.size(); ++from)
        if (is_wanted(from)) return frame_from(from);
    if (octets_.size() < kLongestFrame) return Found::nothing;
    skips_ = true;
    const bool is_noise = request_.empty() || !answer_has_begun();
    return broken(is_noise ? drive::Judgement::no_frame : drive::Judgement::truncated);
}

FrameReceiver::Found FrameReceiver::fault(Instant end)
{
    if (skips_) return feed(0);
    const bool breaks = answer_has_begun();
    octets_.push_back(0);
    ends_.push_back(end);
    behind_fault_ = octets_.size();
    if (!breaks && octets_.size() < kLongestFrame) return Found::nothing;
    skips_ = true;
    return broken(breaks ? drive::Judgement::bad_character : drive::Judgement::no_frame);
}

FrameReceiver::Found FrameReceiver::silence()
{
    skips_ = false;
    if (!octets_.empty()) {
        if (!answer_has_begun()) return broken(drive::Judgement::no_frame);
        return broken(has_length() ? drive::Judgement::bad_checksum : drive::Judgement::truncated);
    }
    if (rest_.empty()) return Found::nothing;
    piece_.swap(rest_);
    rest_.clear();
    return Found::rest;
}

} // namespace dpslave::modbus
