// SPDX-License-Identifier: Apache-2.0
#include "frame_receiver.hpp"

#include "pdu.hpp"

#include <algorithm>

namespace dpslave::modbus {
namespace {

constexpr std::size_t kAround = 3; ///< unit and check sum

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
    request_.assign(1, unit);
    request_.insert(request_.end(), pdu.begin(), pdu.end());
    const std::uint16_t crc = crc16(request_);
    request_.push_back(static_cast<std::uint8_t>(crc & 0xFF));
    request_.push_back(static_cast<std::uint8_t>(crc >> 8));
}

/// Is what came as long as an answer with this beginning, or the whole request?
bool FrameReceiver::has_length() const
{
    const std::size_t length = octets_.size();
    if (octets_ == request_) return true;
    if (length < 5) return false;
    const std::uint8_t function = octets_[1];
    if ((function & kIsException) != 0) return length == kAround + 2;
    switch (function) {
        case kReadRegisters:
        case kReadInputRegisters: return length == kAround + 2 + octets_[2];
        case kWriteRegister:
        case kWriteRegisters:
        case kLoopback: return length == kAround + 5;
        default: return false;
    }
}

/// Gives what was fed as a piece.
FrameReceiver::Found FrameReceiver::found(Found what)
{
    piece_.swap(octets_);
    octets_.clear();
    return what;
}

FrameReceiver::Found FrameReceiver::broken(drive::Judgement flaw)
{
    flaw_ = flaw;
    return found(Found::broken);
}

FrameReceiver::Found FrameReceiver::feed(std::uint8_t octet)
{
    if (skips_) {
        if (rest_.size() < kLongestFrame) rest_.push_back(octet);
        return Found::nothing;
    }
    octets_.push_back(octet);
    if (has_length() && crc16(octets_) == 0) { // over a frame with its check sum
        frame_.assign(octets_.begin(), octets_.end() - 2);
        return found(Found::frame);
    }
    if (octets_.size() < kLongestFrame) return Found::nothing;
    skips_ = true;
    return broken(drive::Judgement::no_frame);
}

FrameReceiver::Found FrameReceiver::fault()
{
    if (skips_) return feed(0);
    skips_ = true;
    octets_.push_back(0);
    return broken(drive::Judgement::bad_character);
}

FrameReceiver::Found FrameReceiver::silence()
{
    skips_ = false;
    if (!octets_.empty())
        return broken(has_length() ? drive::Judgement::bad_checksum : drive::Judgement::truncated);
    if (rest_.empty()) return Found::nothing;
    octets_.swap(rest_);
    return found(Found::rest);
}

} // namespace dpslave::modbus
