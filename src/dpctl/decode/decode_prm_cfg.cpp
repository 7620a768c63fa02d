// SPDX-License-Identifier: Apache-2.0
// Set_Prm, Chk_Cfg and Get_Cfg octet by octet (wire reference 4.4, 4.5). With a device its own rules judge
// them.
#include "decode.hpp"
#include "dpctl/cli/words.hpp"

#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/dp/set_prm.hpp"
#include "dpslave/refusal/words.hpp"

#include <fmt/format.h>

#include <array>

namespace dpslave::dpctl {
namespace {

struct BitName {
    std::uint8_t mask;
    std::string_view name;
};
constexpr std::array kStationStatus = std::to_array<BitName>(
    {{0x80, "Lock_Req"}, {0x40, "Unlock_Req"}, {0x20, "Sync_Req"}, {0x10, "Freeze_Req"}, {0x08, "WD_On"}});
constexpr std::array kDpv1Status1 = std::to_array<BitName>({{0x80, "DPV1_Enable"},
                                                            {0x40, "Fail_Safe"},
                                                            {0x20, "Publisher_Enable"},
                                                            {0x04, "WD_Base 1 ms"},
                                                            {0x02, "Dis_Stop_Control"},
                                                            {0x01, "Dis_Start_Control"}});
constexpr std::array kDpv1Status2 = std::to_array<BitName>({{0x80, "Enable_Pull_Plug_Alarm"},
                                                            {0x40, "Enable_Process_Alarm"},
                                                            {0x20, "Enable_Diagnostic_Alarm"},
                                                            {0x10, "Enable_Manufacturer_Specific_Alarm"},
                                                            {0x08, "Enable_Status_Alarm"},
                                                            {0x04, "Enable_Update_Alarm"},
                                                            {0x01, "Chk_Cfg_Mode"}});
constexpr std::array kDpv1Status3 =
    std::to_array<BitName>({{0x80, "PrmCmd"}, {0x10, "IsoM_Req"}, {0x08, "Prm_Structure"}});

template <std::size_t N>
std::string bit_names(std::uint8_t octet, const std::array<BitName, N>& names)
{
    std::string result;
    for (const BitName& bit : names)
        if ((octet & bit.mask) != 0) result += fmt::format("{}{}", result.empty() ? "" : ", ", bit.name);
    return result.empty() ? "no bit set" : result;
}

std::string lock_words(Bytes data)
{
    switch (dp::lock_of(data)) {
        case dp::Lock::neither: return "neither: only min T_SDR is meant";
        case dp::Lock::lock: return "Lock: the slave belongs to this master";
        case dp::Lock::unlock: return "Unlock: the slave is free for other masters";
    }
    return "?";
}

std::string watchdog_words(Bytes data, bool dpv1_status)
{
    if ((data[0] & 0x08) == 0) return "off";
    return age(static_cast<double>(dp::watchdog_of(data, dpv1_status).count()));
}

/// What this octet of User_Prm_Data is to the device; `at` counts from 0.
std::string user_octet(Bytes user, std::size_t at, const profile::Profile* device)
{
    if (device == nullptr) return fmt::format("User_Prm_Data, octet {}", at + 1);
    const dp::PrmLayout& prm = device->personality.prm;
    if (prm.dpv1_status && at < dp::kDpv1Status) {
        if (at == 0) return "DPV1_Status_1: " + bit_names(user[0], kDpv1Status1);
        return at == 1 ? "DPV1_Status_2: " + bit_names(user[1], kDpv1Status2)
                       : "DPV1_Status_3: " + bit_names(user[2], kDpv1Status3);
    }
    if (prm.list == dp::TagList::none || at < prm.tags_at)
        return fmt::format("User_Prm_Data, octet {}", at + 1);
    const std::size_t place = (at - prm.tags_at) / 2;
    if ((at - prm.tags_at) % 2 == 0) return fmt::format("tag of parameter {}, high octet", place + 1);
    const std::uint16_t tag = be16(user, at - 1);
    return fmt::format("tag of parameter {}, low octet: {}", place + 1,
                       tag == 0 ? "0, none" : tag_words(tag, *device));
}

/// Where and why the device would refuse it.
void add_refusal(const dp::RefusalDetail& refusal, const profile::Profile& device, Decoded& into)
{
    into.faults.push_back(
        fmt::format("profile {} would refuse it: {}", device.name, refusal::clause(refusal)));
}

void judge_set_prm(Bytes data, DecodeContext& context, Decoded& into)
{
    if (dp::lock_of(data) != dp::Lock::lock) return;
    context.configuration.reset();
    context.demand.reset();
    dp::Personality personality = context.device->personality;
    if (!context.device->ident) personality.ident = be16(data, 4); // the site's own
    const auto taken = dp::check_set_prm(personality, data);
    if (taken)
        context.tags = std::vector<std::uint16_t>(taken->tags().begin(), taken->tags().end());
    else
        add_refusal(taken.error(), *context.device, into);
}

/// Words of a general identifier or of a length octet: "4 words in and 4 words out, consistent as a whole".
std::string length_words(unsigned units, bool words, bool in, bool out, bool consistent)
{
    const std::string count = plural(units, words ? "word" : "octet");
    std::string text = in && out ? count + " in and " + count + " out" : count + (in ? " in" : " out");
    return text + (consistent ? ", consistent as a whole" : "");
}

/// Walks over Cfg_Data: one identifier after the other, the special ones with the octets that belong to them.
class CfgWalk {
public:
    CfgWalk(Bytes data, const profile::Profile* device, Decoded& into)
        : data_(data), device_(device), into_(into)
    {}

    void walk()
    {
        while (at_ < data_.size()) {
            const std::uint8_t octet = data_[at_];
            if ((octet & 0x30) != 0)
                general(octet);
            else
                special(octet);
        }
        into_.lines.push_back({"lengths", fmt::format("{} octets in, {} octets out", in_, out_)});
        if (in_ > 244 || out_ > 244) into_.faults.push_back("DP allows 244 octets in a direction");
    }

private:
    void add(std::string meaning)
    {
        into_.octets.push_back({at_ + 1, data_[at_], std::move(meaning)});
        ++at_;
    }

    void count(unsigned units, bool words, bool in, bool out)
    {
        const unsigned octets = units * (words ? 2 : 1);
        if (in) in_ += octets;
        if (out) out_ += octets;
    }

    void general(std::uint8_t octet)
    {
        const unsigned units = (octet & 0x0FU) + 1;
        const bool words = (octet & 0x40) != 0, in = (octet & 0x10) != 0, out = (octet & 0x20) != 0;
        count(units, words, in, out);
        std::string meaning = length_words(units, words, in, out, (octet & 0x80) != 0);
        if (device_ != nullptr && octet != 0 && octet == device_->personality.demand_identifier)
            meaning = "Demand Data: " + meaning;
        add(std::move(meaning));
    }

    void special(std::uint8_t octet)
    {
        const unsigned form = octet >> 6, vendor = (octet & 0x0FU) == 15 ? 0 : octet & 0x0FU;
        add(fmt::format("special format{}{}",
                        form == 0   ? ", empty slot: no inputs or outputs"
                        : form == 1 ? ": inputs"
                        : form == 2 ? ": outputs"
                                    : ": outputs and inputs",
                        vendor == 0 ? "" : ", then " + plural(vendor, "vendor octet")));
        if ((form & 2) != 0) length_octet(false);
        if ((form & 1) != 0) length_octet(true);
        for (unsigned i = 0; i < vendor; ++i)
            if (promised()) add("vendor octet");
    }

    void length_octet(bool in)
    {
        if (!promised()) return;
        const std::uint8_t octet = data_[at_];
        const unsigned units = (octet & 0x3FU) + 1;
        const bool words = (octet & 0x40) != 0;
        count(units, words, in, !in);
        add("length: " + length_words(units, words, in, !in, (octet & 0x80) != 0));
    }

    /// False, and reported once: an identifier announces octets that are not there.
    bool promised()
    {
        if (at_ < data_.size()) return true;
        if (!reported_) into_.faults.push_back("an identifier announces octets that are not there");
        reported_ = true;
        return false;
    }

    Bytes data_;
    const profile::Profile* device_;
    Decoded& into_;
    std::size_t at_ = 0;
    unsigned in_ = 0, out_ = 0;
    bool reported_ = false;
};

/// Without a Set_Prm before it only what does not depend on tags can be judged: as many tags as identifiers.
std::vector<std::uint16_t> assumed_tags(Bytes data, const dp::Personality& personality)
{
    const bool demand =
        !data.empty() && personality.demand_identifier != 0 && data[0] == personality.demand_identifier;
    return std::vector<std::uint16_t>(data.size() - (demand ? 1 : 0), 1);
}

} // namespace

void decode_set_prm(Bytes data, DecodeContext& context, Decoded& into)
{
    if (data.size() < dp::kPrmHeader) {
        into.faults.push_back(fmt::format("Set_Prm has at least {} octets, here are {}: slaves discard it",
                                          dp::kPrmHeader, data.size()));
        return;
    }
    const Bytes user = data.subspan(dp::kPrmHeader);
    const bool dpv1_status = context.device != nullptr && context.device->personality.prm.dpv1_status;
    into.lines.push_back({"lock", lock_words(data)});
    into.lines.push_back({"watchdog", watchdog_words(data, dpv1_status)});
    into.octets.push_back({1, data[0], "Station_status: " + bit_names(data[0], kStationStatus)});
    into.octets.push_back({2, data[1], fmt::format("WD_Fact_1: {}", data[1])});
    into.octets.push_back({3, data[2], fmt::format("WD_Fact_2: {}", data[2])});
    into.octets.push_back({4, data[3],
                           data[3] == 0   ? std::string{"min T_SDR: stays as it is"}
                           : data[3] < 11 ? fmt::format("min T_SDR: {}, which counts as 11 T_bit", data[3])
                                          : fmt::format("min T_SDR: {} T_bit", data[3])});
    into.octets.push_back({5, data[4], "Ident_Number, high octet"});
    into.octets.push_back({6, data[5], fmt::format("Ident_Number, low octet: 0x{:04X}", be16(data, 4))});
    const std::string groups = group_list(data[6]);
    into.octets.push_back({7, data[6], "Group_Ident: " + (groups.empty() ? "no group" : "groups " + groups)});
    for (std::size_t i = 0; i < user.size(); ++i)
        into.octets.push_back({dp::kPrmHeader + i + 1, user[i], user_octet(user, i, context.device)});
    if (context.device == nullptr && (data[0] & 0x08) != 0 && (data[1] == 0 || data[2] == 0))
        into.faults.push_back("the watchdog is on with a factor 0");
    if (context.device != nullptr) judge_set_prm(data, context, into);
}

void decode_cfg(Bytes data, DecodeContext& context, bool check, Decoded& into)
{
    if (data.empty()) {
        into.faults.push_back("Cfg_Data is empty");
        return;
    }
    CfgWalk{data, context.device, into}.walk();
    if (!check || context.device == nullptr) return;
    const dp::Personality& personality = context.device->personality;
    const std::vector<std::uint16_t> tags = context.tags ? *context.tags : assumed_tags(data, personality);
    const auto taken = dp::check_chk_cfg(personality, tags, data);
    if (!taken) add_refusal(taken.error(), *context.device, into);
    context.configuration.reset();
    if (taken && context.tags) context.configuration = *taken;
}

} // namespace dpslave::dpctl
