// SPDX-License-Identifier: Apache-2.0
#include "gsd_device_facts.hpp"

#include "gsd_command.hpp"

#include <algorithm>

namespace dpslave::profile {
namespace {

class FactsMaker {
public:
    FactsMaker(const Profile& profile, const Selection& selection, const std::string& description,
               gsd::Device& device, Notes& notes)
        : profile_(profile),
          personality_(profile.personality),
          facts_(profile.gsd),
          wanted_(selection),
          description_(description),
          device_(device),
          notes_(notes)
    {}

    void make()
    {
        identity();
        rates();
        behaviour();
    }

private:
    void identity()
    {
        device_.vendor = notes_.text_of("vendor", facts_.vendor, gsd::kMaxText);
        notes_.field = "model";
        device_.model = notes_.text_of("model", wanted_.model.value_or(facts_.model), gsd::kMaxText);
        notes_.field = {};
        device_.revision = notes_.text_of("revision", facts_.revision, gsd::kMaxText);
        device_.hardware = notes_.text_of("hardware release", facts_.hardware, gsd::kMaxText);
        device_.software = notes_.text_of("software release", facts_.software, gsd::kMaxText);
        notes_.field = "description";
        device_.description =
            notes_.text_of("description", wanted_.description.value_or(description_), gsd::kMaxDescription);
        notes_.field = "ident";
        const auto ident = wanted_.ident ? wanted_.ident : profile_.ident;
        if (!ident)
            notes_.refuse(
                "ident_missing",
                "the profile " + profile_.name +
                    " has no Ident_Number, because no source states it: give that of your device. It is in the GSD file that came with the device, in the present project of the master, and in octets 5 and 6 of the device's diagnosis. Write the same into the station (ident = 0x...).");
        else if (*ident == 0)
            notes_.refuse("ident_missing",
                          "the Ident_Number 0 belongs to no device: give that of your device.");
        else if (profile_.ident && *ident != *profile_.ident)
            notes_.warn("ident_differs", "the Ident_Number is not that of the profile " + profile_.name +
                                             ", " + hex_of(*profile_.ident) +
                                             ": write ident = " + hex_of(*ident) +
                                             " into the station, else it refuses the master.");
        notes_.field = {};
        device_.ident = ident.value_or(0);
    }

    void rates()
    {
        const std::uint32_t own = wanted_.max_tsdr.value_or(0);
        bool larger = false;
        for (const Baud baud : kBauds) {
            const Tbit bits = personality_.max_tsdr[index_of(baud)];
            if (bits.count == 0 || baud == Baud::k45_45)
                continue; // only ever fixed by hand, so no tool offers it
            device_.max_tsdr[index_of(baud)] = std::max(bits, Tbit{own});
            larger = larger || own > bits.count;
        }
        notes_.field = "max_tsdr";
        if (own > 0xFFFF)
            notes_.refuse("max_tsdr_too_high",
                          "MaxTsdr is " + std::to_string(own) + ": a GSD has room for 65535 bit times.");
        if (wanted_.max_tsdr && !larger)
            notes_.refuse("max_tsdr_no_effect",
                          "MaxTsdr " + std::to_string(own) +
                              " is at no rate larger than that of the profile " + profile_.name +
                              ": leave it out, or give what [bus] max_tsdr of the daemon says.");
        if (own > 1000)
            notes_.warn(
                "max_tsdr_long",
                "MaxTsdr is above 1000 bit times: many masters do not wait that long; check that yours does.");
        notes_.field = {};
    }

    void behaviour()
    {
        device_.family = facts_.family;
        device_.repeater = facts_.repeater;
        device_.freeze = personality_.freeze;
        device_.sync = personality_.sync;
        device_.fail_safe = personality_.fail_safe;
        device_.min_slave_interval = facts_.min_slave_interval;
        device_.max_diag_length = static_cast<std::uint8_t>(personality_.max_diag_length);
    }

    const Profile& profile_;
    const dp::Personality& personality_;
    const GsdFacts& facts_;
    const Selection& wanted_;
    const std::string& description_;
    gsd::Device& device_;
    Notes& notes_;
};

} // namespace

std::string Notes::text_of(std::string_view what, const std::string& text, std::size_t longest)
{
    std::string out = gsd::latin1(text);
    if (out.size() > longest)
        refuse("text_too_long", "the " + std::string{what} + " has " + std::to_string(out.size()) +
                                    " characters: a GSD has room for " + std::to_string(longest) + '.');
    if (out.find('?') != std::string::npos && text.find('?') == std::string::npos)
        warn("character_lost",
             "a character of the " + std::string{what} +
                 " is none of ISO 8859-1, the character set of a GSD, and becomes a question mark.");
    return out;
}

void add_facts(const Profile& profile, const Selection& selection, const std::string& description,
               gsd::Device& device, Notes& notes)
{
    FactsMaker{profile, selection, description, device, notes}.make();
}

} // namespace dpslave::profile
