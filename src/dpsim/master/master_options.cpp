// SPDX-License-Identifier: Apache-2.0
#include "master_options.hpp"

#include "dpsim/common/values.hpp"
#include "gsd_station.hpp"
#include "other_stations.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::sim {
namespace {

constexpr std::uint16_t kOptionBoardIdent = 0x0533;

/// Returns where the tags are in User_Prm_Data: after the octets of DPV1, or first.
std::size_t tags_at(const MasterTexts& t)
{
    return t.family == "technology-box" ? 3 : 0;
}

/// "55,56w,288-290": each number big-endian into `octets`, its identifier into `ids`. Empty = good.
std::string read_tags(const MasterTexts& t, Octets& octets, Octets& ids)
{
    for (const std::string_view item : comma_items(t.tags))
        for (std::string_view word : blank_words(item)) {
            const std::string typed{word};
            const std::uint8_t id = word.ends_with("rw") ? 0x70 : word.ends_with('w') ? 0x60 : 0x50;
            word.remove_suffix(id == 0x70 ? 2 : id == 0x60 ? 1 : 0);
            const auto dash = word.find('-');
            const auto first = read_number(word.substr(0, dash), 1, 0xFFFF);
            const auto last =
                dash == std::string_view::npos ? first : read_number(word.substr(dash + 1), 1, 0xFFFF);
            if (!first || !last || *last < *first) return fmt::format("--tags: '{}' is no tag number", typed);
            for (std::int64_t tag = *first; tag <= *last; ++tag) {
                octets.push_back(high(static_cast<std::uint16_t>(tag)));
                octets.push_back(low(static_cast<std::uint16_t>(tag)));
                ids.push_back(id);
            }
        }
    return {};
}

/// "55,56w,288" into User_Prm_Data and, if `cfg` is empty, Cfg_Data. Empty = good.
std::string use_tags(const MasterTexts& t, Octets& prm, Octets& cfg)
{
    const bool option_board = t.family == "option-board";
    Octets ids;
    if (!t.no_demand) ids.push_back(kDemandIdentifier);
    prm.assign(tags_at(t), 0);
    if (std::string wrong = read_tags(t, prm, ids); !wrong.empty()) return wrong;
    if (option_board && prm.size() > 24)
        return "--tags: 12 tags are the limit of the option board; --prm takes any octets";
    const std::size_t length = option_board && t.prm_length == 0 ? 24 : t.prm_length;
    if (t.prm_length != 0 && prm.size() > length)
        return fmt::format("--prm-length {}: the tags alone make {} octets", length, prm.size());
    prm.resize(std::max(prm.size(), length), 0);
    if (cfg.empty()) cfg = ids;
    return {};
}

/// User_Prm_Data and Cfg_Data of the options, without a GSD. Empty = good.
std::string use_octets(MasterSettings& s, const MasterTexts& t)
{
    const bool option_board = t.family == "option-board";
    if (t.ident.empty() && !option_board)
        return "--family " + t.family +
               " needs --ident: the number in the GSD that the master uses; or give the file with --gsd";
    s.ident = kOptionBoardIdent;
    if (!t.ident.empty()) {
        const TypedIdent ident = read_ident(t.ident);
        if (!ident.number) return "--ident: " + ident.fault;
        s.ident = *ident.number;
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
    s.sync = s.freeze = !t.no_sync_freeze && t.family != "controller";
    return {};
}

/// Puts the tags over the octets of the file. Nothing else of User_Prm_Data changes. It returns an empty text
/// if all is good.
std::string put_tags(const MasterTexts& t, MasterSettings& s, std::vector<std::string>& notes)
{
    if (t.family == "option-board" && s.ident != kOptionBoardIdent)
        return fmt::format(
            "--tags: the ident 0x{:04X} is none of the option board. Say with --family technology-box or --family controller where the tags are in User_Prm_Data",
            s.ident);
    Octets tags, ids;
    if (std::string wrong = read_tags(t, tags, ids); !wrong.empty()) return wrong;
    if (std::any_of(ids.begin(), ids.end(), [](std::uint8_t id) { return id != 0x50; }))
        return "--tags with --gsd: write the numbers alone, without 'w'. The modules say what is written";
    const std::size_t at = tags_at(t), end = at + tags.size();
    if (end > s.user_prm.size())
        return fmt::format("--tags: {} tags end at octet {} of User_Prm_Data, but the file has {} octets",
                           ids.size(), end, s.user_prm.size());
    const auto place = s.user_prm.begin() + static_cast<std::ptrdiff_t>(at);
    notes.push_back(fmt::format("--tags: octets {} to {} of User_Prm_Data are {}; the file has {}", at,
                                end - 1, hex(tags), hex(Bytes{s.user_prm}.subspan(at, tags.size()))));
    std::copy(tags.begin(), tags.end(), place);
    return {};
}

/// Ident, User_Prm_Data and Cfg_Data out of the file. Empty = good.
std::string use_gsd(MasterSettings& s, const MasterTexts& t, std::vector<std::string>& notes)
{
    const auto file = load_gsd(t.gsd);
    if (!file) return file.error();
    std::vector<std::string> names;
    if (!t.modules.empty())
        for (const std::string_view name : comma_items(t.modules)) names.emplace_back(name);
    const auto station = station_of(*file, names);
    if (!station) return fmt::format("{}: {}", t.gsd, station.error());
    s.sync = s.freeze = !t.no_sync_freeze;
    apply(*station, s);
    std::string modules;
    for (const std::string& name : station->modules)
        modules += (modules.empty() ? "" : ", ") + printable(name);
    notes.push_back(fmt::format("{}: {} {}, {} input and {} output octets, modules: {}", t.gsd,
                                printable(station->vendor), printable(station->model),
                                station->lengths.inputs, station->lengths.outputs, modules));
    return t.tags.empty() ? std::string{} : put_tags(t, s, notes);
}

} // namespace

Result<std::vector<std::string>, std::string> complete(MasterSettings& s, const MasterTexts& t)
{
    const auto baud = baud_of(t.baud);
    if (!baud)
        return Failure{fmt::format(
            "--baud {}: PROFIBUS has 9600, 19200, 45450, 93750, 187500, 500000 and 1500000", t.baud)};
    s.baud = *baud;
    s.address = static_cast<std::uint8_t>(t.address);
    s.slave = static_cast<std::uint8_t>(t.slave);
    if (s.address == s.slave) return Failure{std::string{"--master and --slave are the same address"}};
    const auto is_of_others = [&](std::uint8_t address) {
        return address >= kFirstOther && address < kFirstOther + s.others;
    };
    if (is_of_others(s.address) || is_of_others(s.slave))
        return Failure{fmt::format("--others {}: they have the addresses {} to {}, as --master or --slave",
                                   s.others, kFirstOther, kFirstOther + s.others - 1)};
    std::vector<std::string> notes;
    if (std::string wrong = t.gsd.empty() ? use_octets(s, t) : use_gsd(s, t, notes); !wrong.empty())
        return Failure{std::move(wrong)};
    s.watchdog = t.no_watchdog ? std::chrono::milliseconds{0}
                               : std::chrono::duration_cast<std::chrono::milliseconds>(t.watchdog);
    s.min_tsdr = static_cast<std::uint8_t>(t.min_tsdr);
    s.group = static_cast<std::uint8_t>(t.group);
    s.fixed = t.sd3 ? Fixed::when_eight : Fixed::never;
    s.cycle = t.cycle;
    s.allowance = t.slot;
    return notes;
}

} // namespace dpslave::sim
