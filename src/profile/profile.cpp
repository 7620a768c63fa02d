// SPDX-License-Identifier: Apache-2.0
// config/profiles/NAME.toml becomes a Profile, each table of it by its own function.
#include "dpslave/profile/profile.hpp"

#include "dpslave/profile/document.hpp"

#include <algorithm>
#include <system_error>

namespace dpslave::profile {
namespace {

/// Most octets of User_Prm_Data that fit in one Set_Prm (wire reference 5).
constexpr std::int64_t kMaxUserPrmData = 237;

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

class ProfileReader {
public:
    ProfileReader(const std::filesystem::path& folder, const std::string& name)
        : folder_(folder), document_(folder / (name + ".toml"))
    {
        profile_.name = name;
    }

    Result<Profile, Faults> read()
    {
        if (document_.readable()) {
            general();
            addresses();
            max_tsdr();
            cfg_data();
            demand_data();
            user_prm_data();
            behaviour();
        }
        Faults faults = document_.faults();
        if (!profile_.tag_file.empty()) {
            auto tags = load_tags(profile_.tag_file);
            if (tags)
                profile_.tags = *std::move(tags);
            else
                faults.insert(faults.end(), tags.error().begin(), tags.error().end());
        }
        if (!faults.empty()) return Failure{std::move(faults)};
        return std::move(profile_);
    }

private:
    std::string needed_text(Table& table, std::string_view key, std::string_view example)
    {
        table.require(key, example);
        return table.text(key).value_or("");
    }

    /// False if `into` kept what it was.
    template <class T>
    bool needed_integer(Table& table, std::string_view key, std::int64_t min, std::int64_t max, T& into)
    {
        table.require(key, std::string{key} + " = " + std::to_string(into));
        const auto value = table.integer(key, min, max);
        if (value) into = static_cast<T>(*value);
        return value.has_value();
    }

    void needed_boolean(Table& table, std::string_view key, bool& into)
    {
        table.require(key, std::string{key} + (into ? " = true" : " = false"));
        into = table.boolean(key).value_or(into);
    }

    Table needed_table(std::string_view name)
    {
        root_.require(name, "the table [" + std::string{name} + "]; another profile shows its keys");
        return root_.table(name);
    }

    void general()
    {
        profile_.device = needed_text(root_, "device", R"(device = "the device in words")");
        profile_.order_code = needed_text(root_, "order_code", R"(order_code = "the code on the label")");
        profile_.firmware = needed_text(root_, "firmware", R"(firmware = "V4.2 onwards")");
        profile_.manual = needed_text(root_, "manual", R"(manual = "HA389815")");
        if (const auto ident = root_.integer("ident", 1, 0xFFFF)) {
            profile_.ident = static_cast<std::uint16_t>(*ident);
            profile_.personality.ident = *profile_.ident;
        }
        root_.require("protocols", R"(protocols = ["ei-ascii"])");
        if (auto protocols = root_.texts("protocols")) {
            for (const std::string& protocol : *protocols)
                if (protocol != "ei-ascii" && protocol != "modbus-rtu")
                    root_.refuse("protocols",
                                 "protocol \"" + protocol + R"(": write "ei-ascii" or "modbus-rtu".)");
            profile_.protocols = *std::move(protocols);
        }
        if (const auto baud = root_.integer("recommended_baud", 300, 921'600))
            profile_.recommended_baud = static_cast<std::uint32_t>(*baud);
        root_.require("mnemonic_rule", R"(mnemonic_rule = "none")");
        using drive::MnemonicRule;
        if (const auto rule =
                root_.choice<MnemonicRule>("mnemonic_rule", {{"590plus", MnemonicRule::dc_590plus},
                                                             {"ac", MnemonicRule::ac},
                                                             {"none", MnemonicRule::none}}))
            profile_.mnemonics = *rule;
        root_.require("output_loss", R"(output_loss = "zero")");
        using drive::OutputLoss;
        if (const auto loss = root_.choice<OutputLoss>(
                "output_loss", {{"zero", OutputLoss::zero}, {"hold", OutputLoss::hold}}))
            profile_.output_loss = *loss;
        root_.require("leds", R"(leds = "option_board")");
        using led::Language;
        if (const auto language =
                root_.choice<Language>("leds", {{"option_board", Language::option_board},
                                                {"option_board_620", Language::option_board_620}}))
            profile_.leds = *language;
        tag_table();
    }

    void tag_table()
    {
        profile_.tags_only_from_table =
            root_.choice<bool>("unlisted_tags", {{"ask", false}, {"refuse", true}}).value_or(false);
        const std::string file = needed_text(root_, "tag_table", R"(tag_table = "FILE.csv")");
        if (file.empty()) return;
        if (std::filesystem::path{file}.filename() != file || file == "." || file == "..")
            root_.refuse("tag_table",
                         "'tag_table' must be the name of a file in the folder tags beside the folder "
                         "profiles, without a folder of its own.");
        else
            profile_.tag_file = (folder_ / ".." / "tags" / file).lexically_normal();
    }

    void addresses()
    {
        Table table = needed_table("address");
        needed_integer(table, "min", 0, 125, profile_.min_address);
        needed_integer(table, "max", 0, 125, profile_.max_address);
        if (profile_.min_address > profile_.max_address)
            table.refuse("min", "'min' is above 'max': no address would be legal.");
    }

    void max_tsdr()
    {
        Table table = needed_table("max_tsdr");
        bool any = false;
        for (const Baud baud : kBauds) {
            const std::string key = std::to_string(static_cast<std::uint32_t>(baud));
            const auto tbit = table.integer(key, 11, 0xFFFF);
            any = any || table.has(key);
            if (tbit) personality_.max_tsdr[index_of(baud)] = Tbit{static_cast<std::uint32_t>(*tbit)};
        }
        if (table.exists() && !any)
            document_.fault(table.place(),
                            "[max_tsdr] names no rate: add a line such as 187500 = 60 for each "
                            "rate that the device supports.");
    }

    void cfg_data()
    {
        Table table = needed_table("cfg_data");
        table.require("identifiers", "identifiers = [0x50, 0x60]");
        for (const std::int64_t value :
             table.integers("identifiers", 0, 0xFF).value_or(std::vector<std::int64_t>{})) {
            const auto octet = static_cast<std::uint8_t>(value);
            const GeneralFormat format{octet};
            if (format.octets != 2 || !(format.reads || format.writes))
                table.refuse("identifiers",
                             "identifier " + hex_octet(octet) +
                                 " is not one word in, out or both: a parameter is one word, as 0x50 and "
                                 "0x60 have it.");
            else if (identifier_known(octet))
                table.refuse("identifiers", "identifier " + hex_octet(octet) + " stands twice: remove one.");
            else
                personality_.identifiers.push_back({octet, format.reads, format.writes});
        }
        personality_.max_parameters = 12;
        needed_integer(table, "max_parameters", 1, kMaxParameters, personality_.max_parameters);
        needed_boolean(table, "may_have_no_parameters", personality_.may_have_no_parameters);
    }

    bool identifier_known(std::uint8_t octet) const
    {
        return std::any_of(personality_.identifiers.begin(), personality_.identifiers.end(),
                           [&](const dp::Identifier& known) { return known.octet == octet; });
    }

    void demand_data()
    {
        Table table = needed_table("demand_data");
        table.require("form", R"(form = "none")");
        using dp::DemandForm;
        const auto form =
            table.choice<DemandForm>("form", {{"none", DemandForm::none}, {"basic", DemandForm::basic}});
        if (form) personality_.demand = *form;
        const auto identifier = table.integer("identifier", 0, 0xFF);
        const auto base = table.integer("error_base", 0, 1);
        if (!form) return;
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
        Table table = needed_table("user_prm_data");
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

    void behaviour()
    {
        Table table = needed_table("global_control");
        needed_boolean(table, "sync", personality_.sync);
        needed_boolean(table, "freeze", personality_.freeze);
        needed_boolean(table, "fail_safe", personality_.fail_safe);
        Table diag = needed_table("slave_diag");
        needed_integer(diag, "max_length", 6, 244, personality_.max_diag_length);
    }

    std::filesystem::path folder_;
    Document document_;
    Table root_ = document_.root();
    Profile profile_;
    dp::Personality& personality_ = profile_.personality;
};

} // namespace

Result<Profile, Faults> load_profile(const std::filesystem::path& folder, const std::string& name)
{
    return ProfileReader{folder, name}.read();
}

std::vector<std::string> profile_names(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator entry{folder, error}, end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == ".toml") names.push_back(entry->path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace dpslave::profile
