// SPDX-License-Identifier: Apache-2.0
#include "plc.hpp"

#include <algorithm>

namespace dpslave::stalls {
namespace {

constexpr std::uint8_t kMasterSap = 62, kSlaveDiag = 60, kSetPrm = 61, kChkCfg = 62;
constexpr std::size_t kUserPrm = 24, kDemand = 8;
constexpr int kTelegramsInATurn = 4;

void push_word(std::vector<std::uint8_t>& octets, std::uint16_t word)
{
    octets.push_back(static_cast<std::uint8_t>(word >> 8U));
    octets.push_back(static_cast<std::uint8_t>(word & 0xFFU));
}

} // namespace

void Plc::restart()
{
    phase_ = Phase::prm;
    sent_.reset();
    demand_ = {};
    is_held_ = false;
}

void Plc::turn(Instant now)
{
    has_exchanged_ = is_served_ = false;
    for (int i = 0; i < kTelegramsInATurn && telegram(now); ++i) {
    }
}

/// True: another one may follow at once.
bool Plc::telegram(Instant now)
{
    switch (phase_) {
        case Phase::prm: return set_prm(now);
        case Phase::cfg: return chk_cfg(now);
        case Phase::diag: return slave_diag(now);
        case Phase::exchange: exchange(now); return phase_ == Phase::diag;
    }
    return false;
}

/// Returns the octets of the reply, none of a short acknowledge; nothing: there is no station, or the service
/// is not activated.
std::optional<std::vector<std::uint8_t>> Plc::ask(std::optional<std::uint8_t> dsap,
                                                  const std::vector<std::uint8_t>& data, Instant now)
{
    if (station_.slave().state() == dp::State::power_on) return std::nullopt; // not on the bus
    fdl::Indication request{.sa = kAddress, .dsap = dsap, .ssap = {}, .data = data, .at = now};
    if (dsap) request.ssap = kMasterSap;
    fdl::ReplyData reply;
    const fdl::Answer answer = station_.srd(request, reply);
    asks_for_diagnosis_ = answer == fdl::Answer::high;
    if (answer != fdl::Answer::sc && answer != fdl::Answer::low && answer != fdl::Answer::high)
        return std::nullopt;
    const Bytes octets = reply;
    return std::vector<std::uint8_t>{octets.begin(), octets.end()};
}

bool Plc::set_prm(Instant now)
{
    restart();
    std::vector<std::uint8_t> data{0x80, 0, 0, 11, 0x05, 0x33, 0x00}; // Lock_Req, watchdog off
    for (const LayoutEntry& one : parameters_) push_word(data, one.tag);
    data.resize(7 + kUserPrm);
    if (!ask(kSetPrm, data, now)) return false;
    phase_ = Phase::cfg;
    return true;
}

bool Plc::chk_cfg(Instant now)
{
    std::vector<std::uint8_t> data{0x73}; // Demand Data
    for (const LayoutEntry& one : parameters_) data.push_back(one.reads ? 0x50 : 0x60);
    const bool is_there = ask(kChkCfg, data, now).has_value();
    started_at_ = now;
    phase_ = is_there ? Phase::diag : Phase::prm;
    return is_there;
}

bool Plc::slave_diag(Instant now)
{
    constexpr std::uint8_t kFaults = 0x47;             // Prm_Fault, Cfg_Fault, Not_Ready, Non_Exist
    constexpr std::uint8_t kPrmReq = 1, kStatDiag = 2; // of octet 2
    const auto reply = ask(kSlaveDiag, {}, now);
    if (!reply || reply->size() < 6 || ((*reply)[0] & kFaults) != 0 || ((*reply)[1] & kPrmReq) != 0) {
        restart();
        return false;
    }
    if (((*reply)[1] & kStatDiag) != 0) {
        is_held_ = is_held_ || sent_.has_value();
        return false; // it is asked again the next time
    }
    is_held_ = false;
    phase_ = Phase::exchange;
    return true;
}

void Plc::exchange(Instant now)
{
    std::vector<std::uint8_t> data{demand_.begin(), demand_.end()};
    std::vector<std::uint16_t> sent(parameters_.size());
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
        if (!parameters_[i].writes) continue;
        sent[i] = wanted_[i];
        push_word(data, wanted_[i]);
    }
    const auto reply = ask(std::nullopt, data, now);
    if (!reply) return restart();
    sent_ = std::move(sent);
    has_exchanged_ = true;
    if (asks_for_diagnosis_) {
        phase_ = Phase::diag;
        return;
    }
    is_served_ = true;
    std::size_t at = kDemand;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
        if (!parameters_[i].reads || at + 2 > reply->size()) continue;
        inputs_[i] = static_cast<std::uint16_t>((*reply)[at] << 8U | (*reply)[at + 1]);
        at += 2;
    }
}

void Plc::demand(bool is_write, std::uint16_t tag, std::uint16_t word)
{
    const unsigned first = (is_write ? 0x2000U : 0x1000U) | tag;
    demand_ = {static_cast<std::uint8_t>(first >> 8U), static_cast<std::uint8_t>(first & 0xFFU), 0, 0, 0, 0,
               static_cast<std::uint8_t>(word >> 8U),  static_cast<std::uint8_t>(word & 0xFFU)};
}

} // namespace dpslave::stalls
