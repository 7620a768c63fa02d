// SPDX-License-Identifier: Apache-2.0
#include "dpslave/profile/station_keys.hpp"

#include "dpslave/dp/set_prm.hpp"
#include "dpslave/gsd/identifier.hpp"

#include <algorithm>
#include <charconv>

namespace dpslave::profile {
namespace {

/// Returns by how many octets the lengths of User_Prm_Data move.
std::ptrdiff_t moved(const Profile& profile, std::size_t tags_at)
{
    return static_cast<std::ptrdiff_t>(tags_at) -
           static_cast<std::ptrdiff_t>(profile.personality.prm.tags_at);
}

std::string wrong_tags_at(const Profile& profile, std::size_t tags_at)
{
    const dp::PrmLayout& prm = profile.personality.prm;
    if (prm.list == dp::TagList::none)
        return "the device of the profile " + profile.name +
               " takes no tags from the master: remove 'tags_at'.";
    if (prm.dpv1_status && tags_at < dp::kDpv1Status)
        return "the first three octets of User_Prm_Data of the profile " + profile.name +
               " are DPV1_Status: 'tags_at' is 3 or more.";
    const auto longest = static_cast<std::ptrdiff_t>(prm.max_length) + moved(profile, tags_at);
    if (longest > static_cast<std::ptrdiff_t>(dp::kMaxUserPrm))
        return "with this 'tags_at' User_Prm_Data would have up to " + std::to_string(longest) +
               " octets, and Set_Prm has room for " + std::to_string(dp::kMaxUserPrm) +
               ": write a smaller number.";
    return {};
}

std::string wrong_identifier(const Profile& profile, const dp::Identifier& identifier)
{
    constexpr std::uint8_t kDemand = 0x73; ///< A-044, whatever the profile
    const std::uint8_t demand = profile.personality.demand_identifier;
    if (identifier.length > 1) return {};
    if (demand != 0 && identifier.form[0] == demand)
        return hex_octets(identifier.octets()) + " is Demand Data, which the profile " + profile.name +
               " takes in first position without this key: remove it.";
    if (demand == 0 && identifier.form[0] == kDemand)
        return "73 is Demand Data, which the profile " + profile.name + " does not have: remove it.";
    return {};
}

} // namespace

std::string hex_octets(Bytes octets)
{
    std::string text;
    for (const std::uint8_t octet : octets) {
        text += text.empty() ? "" : " ";
        text += "0123456789ABCDEF"[octet >> 4];
        text += "0123456789ABCDEF"[octet & 15];
    }
    return text;
}

std::optional<std::vector<std::uint8_t>> read_hex_octets(std::string_view text)
{
    std::vector<std::uint8_t> octets;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        if (word.empty()) continue;
        std::uint8_t octet = 0;
        const char* const end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, octet, 16);
        if (error != std::errc{} || stop != end || word.size() > 2) return std::nullopt;
        octets.push_back(octet);
    }
    if (octets.empty()) return std::nullopt;
    return octets;
}

Result<dp::Identifier, std::string> identifier_of(Bytes octets)
{
    const std::string name = '"' + hex_octets(octets) + '"';
    const auto no = [&](const std::string& why) { return Failure{name + ' ' + why}; };
    const auto found = gsd::first_identifier(octets);
    if (!found) return no("is cut short: an octet of the special format announces more octets than follow.");
    if (found->length != octets.size())
        return no("has octets after the first identifier: write a text for each identifier.");
    if (found->in + found->out == 0) return no("has no inputs and no outputs: a parameter is a whole word.");
    if (found->manufacturer > 0) return no("has manufacturer's octets, which no parameter has.");
    if (!found->in_words) return no("counts octets: a parameter is a whole word.");
    if (found->in > 0 && found->out > 0 && found->in != found->out)
        return no("has not as many inputs as outputs: a word of both directions is one parameter.");
    return dp::Identifier{octets, static_cast<std::uint8_t>(found->in / 2),
                          static_cast<std::uint8_t>(found->out / 2)};
}

Result<dp::Identifier, std::string> read_identifier(std::string_view text)
{
    const auto octets = read_hex_octets(text);
    if (!octets)
        return Failure{'"' + std::string{text} +
                       "\" is no identifier: write its octets in hexadecimal, as \"52\" or \"C0 40 40\"."};
    return identifier_of(*octets);
}

std::string to_string(const dp::Identifier& identifier)
{
    return hex_octets(identifier.octets());
}

std::vector<WrongKey> wrong_keys(const Profile& profile, const StationKeys& keys)
{
    std::vector<WrongKey> wrong;
    const auto add = [&](std::string_view key, std::string sentence) {
        if (!sentence.empty()) wrong.push_back({key, std::move(sentence)});
    };
    if (keys.tags_at) add("tags_at", wrong_tags_at(profile, *keys.tags_at));
    for (auto one = keys.identifiers.begin(); one != keys.identifiers.end(); ++one) {
        add("identifiers", wrong_identifier(profile, *one));
        if (std::find(keys.identifiers.begin(), one, *one) != one)
            add("identifiers", "the identifier " + to_string(*one) + " is listed twice: remove one.");
    }
    return wrong;
}

dp::Personality personality_of(const Profile& profile, const StationKeys& keys)
{
    dp::Personality personality = profile.personality;
    if (keys.ident) personality.ident = *keys.ident;
    if (!keys.identifiers.empty()) personality.identifiers = keys.identifiers;
    if (!keys.tags_at) return personality;
    const auto by = moved(profile, *keys.tags_at);
    dp::PrmLayout& prm = personality.prm;
    const auto move = [&](std::size_t length) {
        return static_cast<std::size_t>(
            std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(length) + by));
    };
    prm = {.tags_at = *keys.tags_at,
           .min_length = move(prm.min_length),
           .max_length = move(prm.max_length),
           .may_be_absent = prm.may_be_absent,
           .dpv1_status = prm.dpv1_status,
           .max_tag = prm.max_tag,
           .list = prm.list};
    return personality;
}

} // namespace dpslave::profile
