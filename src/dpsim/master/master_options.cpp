// SPDX-License-Identifier: Apache-2.0
#include "master_options.hpp"

#include "dpsim/common/values.hpp"
#include "other_stations.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::sim {
namespace {

/// "55,56w,288" into User_Prm_Data and, if `cfg` is empty, Cfg_Data. Empty = good.
std::string use_tags(const MasterTexts& t, Octets& prm, Octets& cfg)
{
    const bool option_board = t.family == "option-board";
    Octets ids;
    if (!t.no_demand) ids.push_back(kDemandIdentifier);
    prm.assign(t.family == "technology-box" ? 3 : 0, 0); // the octets of DPV1
    std::string text = t.tags;
    for (char& c : text) c = c == ',' ? ' ' : c;
    for (std::string word : words_of(text)) {
        std::uint8_t id = 0x50;
        if (word.ends_with("rw"))
            id = 0x70;
        else if (word.ends_with('w'))
            id = 0x60;
        word.resize(word.size() - (id == 0x70 ? 2 : id == 0x60 ? 1 : 0));
        const auto tag = number_of(word, 1, 0xFFFF);
        if (!tag) return fmt::format("--tags: '{}' is no tag number", word);
        prm.push_back(high(static_cast<std::uint16_t>(*tag)));
        prm.push_back(low(static_cast<std::uint16_t>(*tag)));
        ids.push_back(id);
    }
    if (option_board && prm.size() > 24)
        return "--tags: 12 tags are the limit of the option board; --prm takes any octets";
    const std::size_t length = option_board && t.prm_length == 0 ? 24 : t.prm_length;
    if (t.prm_length != 0 && prm.size() > length)
        return fmt::format("--prm-length {}: the tags alone make {} octets", length, prm.size());
    prm.resize(std::max(prm.size(), length), 0);
    if (cfg.empty()) cfg = ids;
    return {};
}

} // namespace

std::string complete(MasterSettings& s, const MasterTexts& t)
{
    const auto baud = baud_of(t.baud);
    if (!baud)
        return fmt::format("--baud {}: PROFIBUS has 9600, 19200, 45450, 93750, 187500, 500000 and 1500000",
                           t.baud);
    s.baud = *baud;
    s.address = static_cast<std::uint8_t>(t.address);
    s.slave = static_cast<std::uint8_t>(t.slave);
    if (s.address == s.slave) return "--master and --slave are the same address";
    const auto is_of_others = [&](std::uint8_t address) {
        return address >= kFirstOther && address < kFirstOther + s.others;
    };
    if (is_of_others(s.address) || is_of_others(s.slave))
        return fmt::format("--others {}: they have the addresses {} to {}, as --master or --slave", s.others,
                           kFirstOther, kFirstOther + s.others - 1);
    const bool option_board = t.family == "option-board";
    if (t.ident.empty() && !option_board)
        return "--family " + t.family + " needs --ident: the number in the GSD that the master uses";
    if (!t.ident.empty()) {
        const auto ident = number_of(t.ident, 0, 0xFFFF);
        if (!ident) return fmt::format("--ident {}: a number up to 0xFFFF", t.ident);
        s.ident = static_cast<std::uint16_t>(*ident);
    }
    const auto prm = octets_of(t.prm == "none" ? "" : t.prm), cfg = octets_of(t.cfg);
    if (!prm) return "--prm: " + prm.error();
    if (!cfg) return "--cfg: " + cfg.error();
    if (!t.prm.empty() || !option_board) s.user_prm = *prm;
    Octets ids = *cfg;
    if (!t.tags.empty())
        if (std::string wrong = use_tags(t, s.user_prm, ids); !wrong.empty()) return wrong;
    if (s.user_prm.size() > 237)
        return fmt::format("User_Prm_Data of {} octets, but 237 are the limit", s.user_prm.size());
    if (!ids.empty()) s.cfg = ids;
    if (const auto lengths = cfg_lengths(s.cfg); !lengths) return "--cfg: " + lengths.error();
    s.watchdog = std::chrono::milliseconds{t.no_watchdog ? 0 : t.watchdog_ms};
    s.min_tsdr = static_cast<std::uint8_t>(t.min_tsdr);
    s.group = static_cast<std::uint8_t>(t.group);
    s.sync_freeze = !t.no_sync_freeze && t.family != "controller";
    s.fixed = t.sd3 ? Fixed::when_eight : Fixed::never;
    s.cycle = std::chrono::nanoseconds{static_cast<std::int64_t>(t.cycle_ms * 1e6)};
    s.allowance = std::chrono::milliseconds{t.slot_ms};
    return {};
}

} // namespace dpslave::sim
