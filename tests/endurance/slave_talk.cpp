// SPDX-License-Identifier: Apache-2.0
#include "slave_talk.hpp"

#include <algorithm>

namespace dpslave::endurance {
namespace {

constexpr std::uint8_t kDiagSap = 60, kPrmSap = 61, kCfgSap = 62, kMasterSap = 62;
constexpr std::uint8_t kLow = 0x08, kHigh = 0x0A; ///< FC of a reply with data
constexpr std::uint16_t kMostOutput = 10'500;     ///< 105.00, the limit of tag 56

Octets data_reply(std::uint8_t address, const Octets& values)
{
    Octets data(8); // Demand Data, of which none is asked for
    data.insert(data.end(), values.begin(), values.end());
    return ::test::sd2(kMaster, address, kLow, data);
}

} // namespace

std::size_t length_of(std::span<const std::uint8_t> head)
{
    if (head.empty()) return 0;
    switch (head[0]) {
        case 0xE5: return 1;
        case 0x10: return 6;
        case 0xA2: return 14;
        default: return head.size() < 2 ? 0 : head[1] + std::size_t{6};
    }
}

SlaveTalk::SlaveTalk(std::uint8_t address)
    : address_(address),
      inputs_(data_reply(address, {0x03, 0x52, 0x1C, 0x00})),
      no_inputs_(data_reply(address, {0, 0, 0, 0}))
{}

const Octets& SlaveTalk::request()
{
    if (request_.empty()) request_ = next_request();
    return request_;
}

Octets SlaveTalk::next_request()
{
    const std::uint8_t fc = next_fc();
    asks_diag_ = diag_due_ || state_ == State::slave_diag || state_ == State::await_ready;
    if (asks_diag_) return ::test::sd2(address_, kMaster, fc, ::test::Saps{kDiagSap, kMasterSap});
    if (state_ == State::set_prm) // WD 60 s, min T_SDR 11, the ident of the 590, tags 140, 56 and 288
        return ::test::sd2(address_, kMaster, fc, ::test::Saps{kPrmSap, kMasterSap},
                           {0x88, 200, 30, 11, 0x05, 0x33, 0x00, 0x00, 140, 0x00, 56, 0x01, 0x20, 0, 0, 0,
                            0,    0,   0,  0,  0,    0,    0,    0,    0,   0,    0,  0,    0,    0, 0});
    if (state_ == State::chk_cfg)
        return ::test::sd2(address_, kMaster, fc, ::test::Saps{kCfgSap, kMasterSap},
                           {0x73, 0x50, 0x60, 0x50});
    output_ = static_cast<std::uint16_t>((output_ + 1) % (kMostOutput + 1));
    Octets outputs(10); // no Demand Data, one word
    outputs[8] = static_cast<std::uint8_t>(output_ >> 8);
    outputs[9] = static_cast<std::uint8_t>(output_ & 0xFF);
    return ::test::sd2(address_, kMaster, fc, outputs);
}

/// 6D begins a sequence, then 5D and 7D in turn.
std::uint8_t SlaveTalk::next_fc()
{
    fc_ = fc_ == 0 ? 0x6D : fc_ == 0x5D ? 0x7D : 0x5D;
    return fc_;
}

bool SlaveTalk::takes(std::span<const std::uint8_t> reply)
{
    request_.clear();
    if (is_refusal(reply)) { // the slave is not in the state that its master takes it for
        restart();
        return true;
    }
    if (asks_diag_) return takes_diagnosis(reply);
    if (state_ == State::data_exchange) return takes_inputs(reply);
    state_ = state_ == State::set_prm ? State::chk_cfg : State::await_ready;
    return reply.size() == 1 && reply[0] == 0xE5;
}

void SlaveTalk::restart()
{
    request_.clear();
    fc_ = 0;
    diag_due_ = false;
    state_ = State::slave_diag;
}

bool SlaveTalk::takes_diagnosis(std::span<const std::uint8_t> reply)
{
    constexpr std::uint8_t kNotReady = 0x02, kFaults = 0x44, kPrmReq = 0x01, kStatDiag = 0x02;
    const auto heard = ::test::heard({reply.begin(), reply.end()});
    if (!heard || heard->sa != address_ || heard->fc != kLow || heard->ssap != kDiagSap ||
        heard->data.size() < 6)
        return false;
    diag_due_ = false;
    const std::uint8_t first = heard->data[0], second = heard->data[1];
    if (state_ == State::slave_diag) {
        state_ = State::set_prm;
    } else if ((second & kPrmReq) != 0) { // it has left data exchange, or refuses the start-up
        state_ = State::set_prm;
        return (first & kFaults) == 0;
    } else if (state_ == State::await_ready && (first & kNotReady) == 0 && (second & kStatDiag) == 0) {
        state_ = State::data_exchange;
        has_values_ = false;
        ++start_ups_;
    }
    return true;
}

bool SlaveTalk::takes_inputs(std::span<const std::uint8_t> reply)
{
    constexpr std::size_t kFc = 6;
    const auto is = [&](const Octets& wanted) {
        if (reply.size() != wanted.size()) return false;
        if (std::equal(reply.begin(), reply.end(), wanted.begin())) return true;
        if (reply[kFc] != kHigh) return false;
        diag_due_ = true;
        Octets high = wanted;
        high[kFc] = kHigh;
        high[high.size() - 2] = static_cast<std::uint8_t>(high[high.size() - 2] + kHigh - kLow);
        return std::equal(reply.begin(), reply.end(), high.begin());
    };
    if (is(inputs_)) return has_values_ = true;
    return !has_values_ && is(no_inputs_);
}

/// RS or RR without data: SD1 from the slave.
bool SlaveTalk::is_refusal(std::span<const std::uint8_t> reply) const
{
    const auto heard = reply[0] == 0x10 ? ::test::heard({reply.begin(), reply.end()}) : std::nullopt;
    return heard && heard->sa == address_ && ((heard->fc & 0x0F) == 0x03 || (heard->fc & 0x0F) == 0x02);
}

} // namespace dpslave::endurance
