// SPDX-License-Identifier: Apache-2.0
#include "personality_keys.hpp"

#include "needed.hpp"

#include <algorithm>

namespace dpslave::profile {
namespace {

constexpr std::int64_t kMaxUserPrmData = dp::kMaxUserPrm;
/// Words in and out of Demand Data, and the most that 244 octets in each direction have room for.
constexpr std::int64_t kDemandWords = 8, kMaxWords = 244;

std::string hex_octet(std::uint8_t octet)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    return {'0', 'x', digits[octet >> 4], digits[octet & 15]};
}

/// An identifier octet in the general format (wire reference 5, Chk_Cfg).
struct GeneralFormat {
    bool reads;
    bool writes;
    unsigned octets; ///< per direction

    explicit GeneralFormat(std::uint8_t octet)
        : reads((octet & 0x10) != 0),
          writes((octet & 0x20) != 0),
          octets(((octet & 0x0FU) + 1U) * ((octet & 0x40) != 0 ? 2U : 1U))
    {}
};

class PersonalityReader {
public:
    PersonalityReader(input::Document& document, dp::Personality& into)
        : document_(document), personality_(into)
    {}

    void read()
    {
        max_tsdr();
        cfg_data();
        demand_data();
        user_prm_data();
        global_control();
    }

private:
    void max_tsdr()
    {
        input::Table table = needed_table(root_, "max_tsdr");
        bool any = false;
        for (const Baud baud : kBauds) {
            const std::string key = std::to_string(static_cast<std::uint32_t>(baud));
            const auto tbit = table.integer(key, 11, 0xFFFF);
            any = any || table.has(key);
            if (tbit) personality_.max_tsdr[index_of(baud)] = Tbit{static_cast<std::uint32_t>(*tbit)};
        }
        if (table.exists() && !any)
            document_.fault(
                table.place(),
                "[max_tsdr] names no rate: add a line such as 187500 = 60 for each rate that the device supports.");
    }

    void cfg_data()
    {
        input::Table table = needed_table(root_, "cfg_data");
        table.require("identifiers", "identifiers = [0x50, 0x60]");
        for (const std::int64_t value :
             table.integers("identifiers", 0, 0xFF).value_or(std::vector<std::int64_t>{})) {
            const auto octet = static_cast<std::uint8_t>(value);
            const GeneralFormat format{octet};
            if (format.octets != 2 || !(format.reads || format.writes))
                table.refuse(
                    "identifiers",
                    "identifier " + hex_octet(octet) +
                        " is not one word in, out or both: a parameter is one word, as 0x50 and 0x60 have it.");
            else if (identifier_known(octet))
                table.refuse("identifiers",
                             "identifier " + hex_octet(octet) + " is listed twice: remove one.");
            else
                personality_.identifiers.emplace_back(octet, format.reads ? std::uint8_t{1} : std::uint8_t{0},
                                                      format.writes ? std::uint8_t{1} : std::uint8_t{0});
        }
        personality_.max_parameters = 12;
        needed_integer(table, "max_parameters", 1, kMaxParameters, personality_.max_parameters);
        if (const auto words = table.integer("max_words", kDemandWords, kMaxWords)) {
            personality_.max_words = static_cast<std::size_t>(*words);
            if (personality_.max_words < personality_.max_parameters)
                table.refuse(
                    "max_words",
                    "'max_words' is below 'max_parameters': that number of parameters could never be configured.");
        }
        needed_boolean(table, "may_have_no_parameters", personality_.may_have_no_parameters);
    }

    bool identifier_known(std::uint8_t octet) const
    {
        return std::any_of(personality_.identifiers.begin(), personality_.identifiers.end(),
                           [&](const dp::Identifier& known) { return known.form[0] == octet; });
    }

    void demand_data()
    {
        input::Table table = needed_table(root_, "demand_data");
        table.require("form", R"(form = "none")");
        using dp::DemandForm;
        const auto form = table.choice<DemandForm>(
            "form",
            {{"none", DemandForm::none}, {"basic", DemandForm::basic}, {"extended", DemandForm::extended}});
        if (form) personality_.demand = *form;
        const auto identifier = table.integer("identifier", 0, 0xFF);
        const auto base = table.integer("error_base", 0, 1);
        const auto reply = table.choice<dp::ExtendedReply>(
            "extended_reply", {{"table", dp::ExtendedReply::table}, {"example", dp::ExtendedReply::example}});
        if (!form) return;
        if (reply && *form != DemandForm::extended)
            table.refuse("extended_reply",
                         "'extended_reply' has a meaning only with form = \"extended\": remove it.");
        personality_.extended_reply = reply.value_or(dp::ExtendedReply::table);
        if (*form == DemandForm::none) {
            for (const char* key : {"identifier", "error_base"})
                if (table.has(key))
                    table.refuse(key, std::string{"'"} + key +
                                          "' has no meaning with form = \"none\": remove it.");
            return;
        }
        table.require("identifier", "identifier = 0x73");
        if (identifier) {
            const auto octet = static_cast<std::uint8_t>(*identifier);
            const GeneralFormat format{octet};
            if (format.octets != 8 || !format.reads || !format.writes)
                table.refuse("identifier",
                             "identifier " + hex_octet(octet) +
                                 " is not four words in both directions, which Demand Data takes: 0x73 is.");
            personality_.demand_identifier = octet;
        }
        personality_.demand_error_base = static_cast<std::uint16_t>(base.value_or(0));
    }

    void user_prm_data()
    {
        input::Table table = needed_table(root_, "user_prm_data");
        dp::PrmLayout& prm = personality_.prm;
        const bool placed = needed_integer(table, "tags_at", 0, kMaxUserPrmData, prm.tags_at);
        const bool bounded = needed_integer(table, "min_length", 0, kMaxUserPrmData, prm.min_length);
        const bool limited = needed_integer(table, "max_length", 0, kMaxUserPrmData, prm.max_length);
        needed_boolean(table, "may_be_absent", prm.may_be_absent);
        needed_boolean(table, "dpv1_status", prm.dpv1_status);
        needed_integer(table, "max_tag", 1, 0xFFFF, prm.max_tag);
        table.require("tag_list", R"(tag_list = "first_zero_ends")");
        using dp::TagList;
        if (const auto list =
                table.choice<TagList>("tag_list", {{"first_zero_ends", TagList::first_zero_ends},
                                                   {"zeros_at_end", TagList::zeros_at_end},
                                                   {"exact", TagList::exact}}))
            prm.list = *list;
        if (!placed || !bounded || !limited) return;
        if (prm.min_length > prm.max_length)
            table.refuse("min_length", "'min_length' is above 'max_length': no length would be legal.");
        if (prm.dpv1_status && prm.tags_at < 3)
            table.refuse(
                "tags_at",
                "with 'dpv1_status' the first three octets are DPV1_Status: 'tags_at' must be 3 or more.");
        const std::size_t needed = prm.tags_at + 2 * personality_.max_parameters;
        if (prm.max_length < needed)
            table.refuse("max_length", "'max_length' leaves no room for the tags of " +
                                           std::to_string(personality_.max_parameters) +
                                           " parameters: that takes " + std::to_string(needed) + " octets.");
    }

    void global_control()
    {
        input::Table table = needed_table(root_, "global_control");
        needed_boolean(table, "sync", personality_.sync);
        needed_boolean(table, "freeze", personality_.freeze);
        needed_boolean(table, "fail_safe", personality_.fail_safe);
    }

    input::Document& document_;
    input::Table root_ = document_.root();
    dp::Personality& personality_;
};

} // namespace

void read_personality(input::Document& document, dp::Personality& into)
{
    PersonalityReader{document, into}.read();
}

} // namespace dpslave::profile
