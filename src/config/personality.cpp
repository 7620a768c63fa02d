// SPDX-License-Identifier: Apache-2.0
// [[station]]: what the slave takes from the master, where this station and this bus say otherwise than the
// profile.
#include "parts.hpp"

#include "dpslave/input/wording.hpp"

#include <utility>

namespace dpslave::config {
namespace {

using input::in_quotes;
using input::Table;

class PersonalityReader {
public:
    PersonalityReader(input::Document& document, Table& table, const BusConfig& bus, input::Faults& warnings)
        : document_(document), table_(table), bus_(bus), warnings_(warnings)
    {}

    /// The keys of X-53; those that are wrong are left out.
    profile::StationKeys keys(const profile::Profile* profile)
    {
        profile::StationKeys keys;
        if (const auto ident = table_.integer("ident", 1, 0xFFFF))
            keys.ident = static_cast<std::uint16_t>(*ident);
        if (const auto at = table_.integer("tags_at", 0, dp::kMaxUserPrm - 2))
            keys.tags_at = static_cast<std::size_t>(*at);
        const auto texts = table_.texts("identifiers", 1);
        for (const std::string& text : texts.value_or(std::vector<std::string>{})) {
            const auto identifier = profile::read_identifier(text);
            if (identifier)
                keys.identifiers.push_back(*identifier);
            else
                table_.refuse("identifiers", identifier.error());
        }
        if (profile == nullptr) return keys;
        if (!keys.ident && !table_.has("ident") && !profile->ident)
            document_.fault(
                table_.place(),
                "'ident' is missing in [[station]]: profile " + in_quotes(profile->name) +
                    " has none, because no source states it; add ident = 0x.... with the number of the key Ident_Number in the GSD of the plant's PLC project.");
        for (const profile::WrongKey& wrong : profile::wrong_keys(*profile, keys)) {
            table_.refuse(wrong.key, wrong.sentence);
            wrong.key == "tags_at" ? keys.tags_at.reset() : keys.identifiers.clear();
        }
        return keys;
    }

    void demand(const profile::Profile& profile, dp::Personality& personality)
    {
        Table demand = table_.table("demand");
        using Reply = dp::ExtendedReply;
        const auto error_base = demand.integer("error_base", 0, 1);
        const auto extended =
            demand.choice<Reply>("extended_reply", {{"table", Reply::table}, {"example", Reply::example}});
        if (error_base && personality.demand == dp::DemandForm::none)
            demand.refuse("error_base",
                          "profile " + in_quotes(profile.name) + " has no Demand Data: remove 'error_base'.");
        if (error_base) personality.demand_error_base = static_cast<std::uint16_t>(*error_base);
        if (demand.has("extended_reply") && personality.demand != dp::DemandForm::extended)
            demand.refuse("extended_reply",
                          "profile " + in_quotes(profile.name) +
                              " has no extended commands of Demand Data: remove 'extended_reply'.");
        if (extended) personality.extended_reply = *extended;
    }

    void rates(const profile::Profile& profile, dp::Personality& personality)
    {
        if (bus_.baud && personality.max_tsdr[index_of(*bus_.baud)].count == 0)
            table_.refuse("profile", "profile " + in_quotes(profile.name) +
                                         " does not support the rate of the bus, " +
                                         std::to_string(static_cast<std::uint32_t>(*bus_.baud)) +
                                         " bit/s: its [max_tsdr] does not list it.");
        if (bus_.max_tsdr > 0) set_max_tsdr(personality);
    }

private:
    /// One for all rates; less than the GSD says is legal, and a warning.
    void set_max_tsdr(dp::Personality& personality)
    {
        bool warned = false;
        for (const Baud baud : kBauds) {
            Tbit& each = personality.max_tsdr[index_of(baud)];
            if (each.count == 0) continue;
            const bool is_used = !bus_.baud || *bus_.baud == baud;
            if (is_used && bus_.max_tsdr < each.count && !std::exchange(warned, true))
                warnings_.push_back(
                    {document_.name(), table_.place().line, table_.place().column,
                     "'max_tsdr' in [bus] is below the " + std::to_string(each.count) +
                         " bit times of this station's profile at " +
                         std::to_string(static_cast<std::uint32_t>(baud)) +
                         " bit/s: answers that the master would still accept are suppressed. Name the rate of the bus, or a max_tsdr that suits all rates."});
            each = Tbit{bus_.max_tsdr};
        }
    }

    input::Document& document_;
    Table& table_;
    const BusConfig& bus_;
    input::Faults& warnings_;
};

} // namespace

void read_personality(input::Document& document, Table& table, const BusConfig& bus, bool is_ei_ascii,
                      StationConfig& station, input::Faults& warnings)
{
    PersonalityReader reader{document, table, bus, warnings};
    station.keys = reader.keys(station.profile.get());
    if (!station.profile) return;
    dp::Personality personality = profile::personality_of(*station.profile, station.keys);
    reader.demand(*station.profile, personality);
    reader.rates(*station.profile, personality);
    personality.waits_for_drive = station.loss.when != drive::WhenLost::hold;
    personality.tries_outputs =
        !station.profile->has_tec || is_ei_ascii; // X-48; over EI-ASCII also the scales, X-49
    station.personality = std::make_shared<const dp::Personality>(std::move(personality));
}

} // namespace dpslave::config
