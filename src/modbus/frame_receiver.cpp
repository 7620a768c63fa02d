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

FrameReceiver::Found FrameReceiver::feed(std::uint8_t octet)
{
    if (skips_) return Found::nothing;
    octets_.push_back(octet);
    if (has_length() && crc16(octets_) == 0) { // over a frame with its check sum
        frame_.assign(octets_.begin(), octets_.end() - 2);
        octets_.clear();
        return Found::frame;
    }
    return octets_.size() < kLongestFrame ? Found::nothing : fault();
}

FrameReceiver::Found FrameReceiver::fault()
{
    if (skips_) return Found::nothing;
    skips_ = true;
    octets_.clear();
    return Found::broken;
}

FrameReceiver::Found FrameReceiver::silence()
{
    const bool broke_off = !octets_.empty();
    skips_ = false;
    octets_.clear();
    return broke_off ? Found::broken : Found::nothing;
}

} // namespace dpslave::modbus
