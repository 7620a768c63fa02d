// SPDX-License-Identifier: Apache-2.0
// Which entry of an incident its cause is. The codes are those of report/words and app/incident.
#include "incident.hpp"

#include "dpslave/dp/sap.hpp"

#include <algorithm>
#include <array>

namespace dpslave::dpctl {
namespace {

using drive::Judgement;

/// A request of this kind to the station is the cause.
struct Wanted {
    enum class Service : std::uint8_t { none, set_prm, chk_cfg, exchange, any };
    Service service = Service::none;
    bool only_master = false; ///< from the master that has the station
};

Wanted wanted_of(const report::IncidentPart& what)
{
    using enum Wanted::Service;
    const std::string& why = what.reason;
    if (what.kind == "refused") return {.service = why.starts_with("cfg_") ? chk_cfg : set_prm};
    if (what.kind != "left") return {};
    if (why == "watchdog") return {.service = any, .only_master = true};
    if (why == "output_length") return {.service = exchange, .only_master = true};
    return {.service = why == "cfg_fault" ? chk_cfg : set_prm, .only_master = true};
}

bool is_of(const fdl::Telegram& telegram, Wanted::Service service)
{
    using enum Wanted::Service;
    switch (service) {
        case none: return false;
        case set_prm: return telegram.dsap == dp::sap::kSetPrm;
        case chk_cfg: return telegram.dsap == dp::sap::kChkCfg;
        case exchange:
            return !telegram.dsap && telegram.delimiter != fdl::kSC &&
                   (telegram.function() == fdl::Function::srd_low ||
                    telegram.function() == fdl::Function::srd_high);
        case any: return true;
    }
    return false;
}

/// Answers that count for the reason, as the client of the line counts them.
bool is_refused_for(const LineEntry& entry, const std::string& reason)
{
    constexpr std::array kDamaged{Judgement::bad_checksum, Judgement::bad_character, Judgement::truncated,
                                  Judgement::no_frame};
    if (entry.what != LineEntry::What::answer) return false;
    if (reason == "late") return entry.judgement == Judgement::late;
    if (reason == "foreign") return entry.judgement == Judgement::foreign;
    return std::find(kDamaged.begin(), kDamaged.end(), entry.judgement) != kDamaged.end();
}

Instant moment_of(const report::IncidentHead& head)
{
    return Instant{std::chrono::nanoseconds{head.at_ns}};
}

} // namespace

std::optional<std::size_t> cause_in(const report::IncidentHead& head,
                                    const std::vector<trace::Entry>& telegrams)
{
    const Wanted wanted = wanted_of(head.what);
    const auto station = std::find_if(head.stations.begin(), head.stations.end(),
                                      [&](const auto& one) { return one.name == head.what.station; });
    if (wanted.service == Wanted::Service::none || station == head.stations.end()) return std::nullopt;
    const bool is_of_master = wanted.only_master && station->master;
    for (std::size_t i = telegrams.size(); i-- > 0;) {
        const trace::Entry& entry = telegrams[i];
        if (entry.what != trace::Entry::What::telegram || entry.first > moment_of(head)) continue;
        const auto telegram = telegram_of(entry);
        if (!telegram || !telegram->is_request() || telegram->da != station->address) continue;
        if (is_of_master && telegram->sa != *station->master) continue;
        if (is_of(*telegram, wanted.service)) return i;
    }
    return std::nullopt;
}

std::optional<std::size_t> cause_in(const report::IncidentHead& head, const std::vector<LineEntry>& frames)
{
    const bool is_silence = head.what.kind == "drive" && head.what.reason == "silent";
    if (!is_silence && head.what.kind != "answer") return std::nullopt;
    std::optional<std::size_t> cause;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const LineEntry& entry = frames[i];
        const bool is_one =
            is_silence ? entry.what == LineEntry::What::silence : is_refused_for(entry, head.what.reason);
        if (is_one && entry.first <= moment_of(head) && (!cause || entry.first >= frames[*cause].first))
            cause = i;
    }
    return cause;
}

} // namespace dpslave::dpctl
