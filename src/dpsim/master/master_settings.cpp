// SPDX-License-Identifier: Apache-2.0
#include "master_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dpslave::sim {
namespace {

constexpr std::array<std::string_view, 7> kStateNames{
    "stopped", "searching", "asking", "parameterising", "configuring", "awaiting-ready", "data-exchange"};

/// The two watchdog factors for at least `wanted`, as near as 10 ms steps allow; the longest there is if it
/// is too long.
std::pair<std::uint8_t, std::uint8_t> watchdog_factors(std::chrono::milliseconds wanted)
{
    const auto steps = std::clamp<std::int64_t>((wanted.count() + 9) / 10, 1, 255 * 255);
    std::pair<std::uint8_t, std::uint8_t> best{std::uint8_t{255}, std::uint8_t{255}};
    std::int64_t best_product = 255 * 255;
    for (std::int64_t a = 1; a <= 255; ++a) {
        const std::int64_t b = (steps + a - 1) / a;
        if (b > 255 || a * b >= best_product) continue;
        best = {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(a)};
        best_product = a * b;
    }
    return best;
}

double microseconds(std::chrono::nanoseconds t)
{
    return std::chrono::duration<double, std::micro>(t).count();
}

} // namespace

std::vector<std::string> in_words(const MasterCounters& c)
{
    std::vector<std::string> lines{
        fmt::format(
            "{} cycles, {} retries, {} requests without answer, {} invalid answers, {} octets that were not asked for",
            c.cycles, c.retries, c.missing, c.invalid, c.unasked_octets),
        fmt::format(
            "{} diagnosis reads, {} answers with diagnosis pending, {} refusals, {} times out of data exchange",
            c.diagnosis_reads, c.diagnosis_pending, c.refused, c.exchanges_lost)};
    if (c.others > 0) lines.push_back(fmt::format("{} exchanges of other stations", c.others));
    if (c.cycles > 0)
        lines.push_back(fmt::format(
            "Data_Exchange, request handed over until answer complete: min {:.0f}, mean {:.0f}, max {:.0f} us",
            microseconds(c.answer_min), microseconds(c.answer_sum) / static_cast<double>(c.cycles),
            microseconds(c.answer_max)));
    return lines;
}

std::string_view text(Service service)
{
    switch (service) {
        case Service::fdl_status: return "FDL status";
        case Service::data_exchange: return "Data_Exchange";
        case Service::raw: return "raw telegram";
        default: return sap_name(sap_of(service));
    }
}

std::uint8_t sap_of(Service service)
{
    switch (service) {
        case Service::slave_diag: return kSapSlaveDiag;
        case Service::set_prm: return kSapSetPrm;
        case Service::chk_cfg: return kSapChkCfg;
        case Service::get_cfg: return kSapGetCfg;
        default: return kSapGlobalControl;
    }
}

std::string_view text(MasterState state)
{
    return kStateNames[static_cast<std::size_t>(state)];
}

std::optional<MasterState> master_state(std::string_view name)
{
    for (std::size_t i = 0; i < kStateNames.size(); ++i)
        if (kStateNames[i] == name) return static_cast<MasterState>(i);
    return std::nullopt;
}

Result<CfgLengths, std::string> cfg_lengths(Bytes cfg)
{
    CfgLengths total;
    for (std::size_t i = 0; i < cfg.size();) {
        const std::uint8_t id = cfg[i++];
        const unsigned kind = id >> 4 & 3U;
        if (kind != 0) {
            const std::size_t octets = ((id & 0x0FU) + 1U) * ((id & 0x40) != 0 ? 2U : 1U);
            if ((kind & 1U) != 0) total.inputs += octets;
            if ((kind & 2U) != 0) total.outputs += octets;
            continue;
        }
        for (const unsigned mask : {0x80U, 0x40U}) { // special format: outputs first, then inputs
            if ((id & mask) == 0) continue;
            if (i >= cfg.size())
                return Failure{fmt::format("identifier {:02X}: its length octet is missing", id)};
            const std::uint8_t length = cfg[i++];
            const std::size_t octets = ((length & 0x3FU) + 1U) * ((length & 0x40) != 0 ? 2U : 1U);
            (mask == 0x80U ? total.outputs : total.inputs) += octets;
        }
        const std::size_t vendor = (id & 0x0F) == 15 ? 0U : id & 0x0FU;
        if (vendor > cfg.size() - i)
            return Failure{fmt::format("identifier {:02X}: {} more octets are announced", id, vendor)};
        i += vendor;
    }
    if (total.inputs > 244 || total.outputs > 244)
        return Failure{
            fmt::format("{} input and {} output octets, but 244 are the limit", total.inputs, total.outputs)};
    return total;
}

Octets set_prm_unit(const MasterSettings& s)
{
    const bool wd = s.watchdog.count() > 0;
    const auto [f1, f2] = watchdog_factors(s.watchdog);
    Octets unit{
        static_cast<std::uint8_t>(0x80 | (s.sync ? 0x20 : 0) | (s.freeze ? 0x10 : 0) | (wd ? 0x08 : 0)),
        wd ? f1 : std::uint8_t{1},
        wd ? f2 : std::uint8_t{1},
        s.min_tsdr,
        high(s.ident),
        low(s.ident),
        s.group};
    const std::size_t fixed = unit.size();
    unit.resize(fixed + s.user_prm.size());
    std::copy(s.user_prm.begin(), s.user_prm.end(), unit.begin() + static_cast<std::ptrdiff_t>(fixed));
    return unit;
}

} // namespace dpslave::sim
