// SPDX-License-Identifier: Apache-2.0
#include "trace_decode.hpp"

#include "trace_text.hpp"

#include "dpslave/dp/sap.hpp"
#include "dpslave/dp/set_prm.hpp"
#include "dpslave/dp/slave_diag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dpslave::dpctl {
namespace {

using What = trace::Entry::What;

/// Where both of them have the Ident_Number: octets 5 and 6.
constexpr std::size_t kIdentAt = 4;

/// Of a character on the line: start bit, eight bits, parity, stop bit.
constexpr std::int64_t kBitsOfCharacter = 11;

bool says_nothing(const Decoded& part)
{
    return part.lines.empty() && part.octets.empty() && part.faults.empty();
}

} // namespace

std::optional<std::uint8_t> layout_changed_by(const trace::Entry& entry)
{
    if (entry.what != What::telegram) return std::nullopt;
    const auto telegram = telegram_of(entry);
    if (!telegram || !telegram->is_request()) return std::nullopt;
    if (telegram->dsap != dp::sap::kSetPrm && telegram->dsap != dp::sap::kChkCfg) return std::nullopt;
    return static_cast<std::uint8_t>(telegram->da & 0x7FU);
}

std::optional<std::string> how_exact(const trace::Entry& entry)
{
    if (entry.what != What::telegram && entry.what != What::piece) return std::nullopt;
    const auto baud = static_cast<std::int64_t>(entry.baud);
    const std::int64_t uncertainty_ns = entry.uncertainty.count();
    if (uncertainty_ns * baud <= kBitsOfCharacter * 1'000'000'000) return std::nullopt;
    return fmt::format("on the line up to {:.3f} ms earlier", static_cast<double>(uncertainty_ns) / 1e6);
}

void TraceDecoder::set_device(std::uint8_t address, profile::Profile device)
{
    Slave& slave = slaves_.at(address & 0x7FU);
    slave.device = std::make_unique<const profile::Profile>(std::move(device));
    slave.context = DecodeContext{.device = slave.device.get()};
}

void TraceDecoder::set_layout(std::uint8_t address, Bytes prm, Bytes cfg)
{
    DecodeContext& context = slaves_.at(address & 0x7FU).context;
    Decoded aside;
    if (!prm.empty()) decode_set_prm(prm, context, aside);
    if (!cfg.empty()) decode_cfg(cfg, context, true, aside);
}

/// A Set_Prm names the device that the master expects, a diagnosis the one that is there.
void TraceDecoder::learn_ident(const fdl::Telegram& telegram, Slave& slave) const
{
    const bool is_prm = telegram.is_request() && telegram.dsap == dp::sap::kSetPrm;
    const bool is_diagnosis = !telegram.is_request() && telegram.ssap == dp::sap::kSlaveDiag;
    if ((!is_prm && !is_diagnosis) || telegram.data.size() < kIdentAt + 2) return;
    const auto texts = texts_.find(be16(telegram.data, kIdentAt));
    slave.context.texts = texts != texts_.end() ? &texts->second : nullptr;
}

/// What is wrong with it, as far as its head tells.
std::optional<Decoded> TraceDecoder::decode_piece(Bytes octets)
{
    if (octets.empty()) return std::nullopt;
    const auto length = fdl::frame_length(octets);
    const std::size_t whole = length && *length > 0 ? *length : octets.size();
    DecodeContext none;
    Decoded piece = decode_telegram(octets.first(std::min(whole, octets.size())), none);
    piece.lines.clear(); // of octets that are damaged
    piece.octets.clear();
    if (piece.faults.empty()) return std::nullopt; // its line says how it came
    return piece;
}

std::optional<Decoded> TraceDecoder::decode(const trace::Entry& entry)
{
    if (entry.what == What::piece) return decode_piece(entry.octets);
    if (entry.what != What::telegram && entry.what != What::reply) return std::nullopt;
    const auto telegram = telegram_of(entry);
    if (!telegram || !telegram->has_fc()) return std::nullopt;
    Slave& slave = slaves_.at((telegram->is_request() ? telegram->da : telegram->sa) & 0x7FU);
    learn_ident(*telegram, slave);
    Decoded part;
    part.kind = service_name(*telegram);
    part.hex = hex(telegram->data);
    decode_service(*telegram, slave.context, part);
    if (says_nothing(part)) return std::nullopt;
    return part;
}

} // namespace dpslave::dpctl
