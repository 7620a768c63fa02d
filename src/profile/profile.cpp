// SPDX-License-Identifier: Apache-2.0
// config/profiles/NAME.toml becomes a Profile, each table of it by its own function.
#include "dpslave/profile/profile.hpp"

#include "gsd_facts.hpp"
#include "needed.hpp"
#include "personality_keys.hpp"

#include "dpslave/input/document.hpp"

namespace dpslave::profile {
namespace {

/// Octets of Slave_Diag before the device-related block, and of that block's header (wire reference 5).
constexpr std::size_t kDiagHeader = 6, kBlockHeader = 1;

class ProfileReader {
public:
    ProfileReader(const input::TextSource& source, const std::string& folder, const std::string& name)
        : source_(source), folder_(folder), document_(source, folder + '/' + name + ".toml")
    {
        profile_.name = name;
    }

    Result<Profile, input::Faults> read()
    {
        if (document_.readable()) {
            general();
            addresses();
            read_personality(document_, personality_);
            tec();
            slave_diag();
            drive_side();
            input::Table gsd = needed_table(root_, "gsd");
            profile_.gsd = read_gsd_facts(gsd, profile_);
        }
        input::Faults faults = document_.faults();
        if (!profile_.tag_file.empty()) {
            auto tags = load_tags(source_, profile_.tag_file);
            if (tags && profile_.selectable_resolution) {
                std::vector<drive::Tag> rows = tags->all();
                drive::mark_counts(rows);
                profile_.tags = drive::TagTable{std::move(rows)};
            } else if (tags)
                profile_.tags = *std::move(tags);
            else
                faults.insert(faults.end(), tags.error().begin(), tags.error().end());
        }
        if (!faults.empty()) return Failure{std::move(faults)};
        return std::move(profile_);
    }

private:
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
        const auto rule = root_.choice<MnemonicRule>("mnemonic_rule", {{"590plus", MnemonicRule::dc_590plus},
                                                                       {"ac", MnemonicRule::ac},
                                                                       {"pno", MnemonicRule::pno},
                                                                       {"none", MnemonicRule::none}});
        if (rule) profile_.mnemonics = *rule;
        mnemonic_source(rule == MnemonicRule::none);
        profile_.option_software = root_.text("option_software").value_or("");
        tag_table();
    }

    /// A rule that is not given is assumed.
    void mnemonic_source(bool is_none)
    {
        const bool has_rule = profile_.mnemonics != drive::MnemonicRule::none;
        for (const char* const key : {"mnemonic_source", "mnemonic_assumed"})
            if (is_none && root_.has(key))
                root_.refuse(key, "'" + std::string{key} +
                                      "' has a meaning only where mnemonic_rule is not \"none\": remove it.");
        profile_.mnemonic_source = root_.text("mnemonic_source").value_or("");
        profile_.mnemonics_assumed =
            root_.boolean("mnemonic_assumed").value_or(has_rule && profile_.mnemonic_source.empty());
    }

    void tag_table()
    {
        profile_.tags_only_from_table =
            root_.choice<bool>("unlisted_tags", {{"ask", false}, {"refuse", true}}).value_or(false);
        const std::string file = needed_text(root_, "tag_table", R"(tag_table = "FILE.csv")");
        if (file.empty()) return;
        if (!is_name_of_a_file(file))
            root_.refuse(
                "tag_table",
                "'tag_table' must be the name of a file in the folder tags beside the folder profiles, without a folder of its own.");
        else
            profile_.tag_file = input::beside(folder_, "tags/" + file);
    }

    void addresses()
    {
        input::Table table = needed_table(root_, "address");
        needed_integer(table, "min", 0, 125, profile_.min_address);
        needed_integer(table, "max", 0, 125, profile_.max_address);
        if (profile_.min_address > profile_.max_address)
            table.refuse("min", "'min' is above 'max': no address would be legal.");
    }

    void tec()
    {
        input::Table table = root_.table("tec");
        profile_.has_tec = table.exists();
        if (!profile_.has_tec) return;
        lamp(table, "health", profile_.health);
        lamp(table, "run", profile_.run);
        lamp(table, "trip_tag", profile_.trip.bit);
        profile_.trip.is_code = profile_.trip.bit.tag == 0;
    }

    static void lamp(input::Table& table, std::string_view key, MirroredLamp& into)
    {
        const auto text = table.text(key);
        if (!text) return;
        if (const auto lamp = parse_lamp(*text))
            into = *lamp;
        else
            table.refuse(
                key,
                "'" + std::string{key} +
                    "' is not a bit of a tag: write \"272.3\" for bit 3 of tag 272, \"!272.3\" if it is lit while the bit is 0, or \"12\" for any bit.");
    }

    void slave_diag()
    {
        input::Table table = needed_table(root_, "slave_diag");
        const bool bounded = needed_integer(table, "max_length", 6, 244, personality_.max_diag_length);
        const auto form = table.choice<DiagForm>("form", {{"none", DiagForm::none},
                                                          {"trip_code", DiagForm::trip_code},
                                                          {"tripped", DiagForm::tripped},
                                                          {"status_word", DiagForm::status_word}});
        const auto tag = table.integer("status_tag", 1, 0xFFFF);
        const auto mask = table.integer("fault_mask", 0, 0xFFFF);
        if (table.has("form") && !form) return;
        profile_.diagnosis = form.value_or(DiagForm::none);
        profile_.status_tag = static_cast<std::uint16_t>(tag.value_or(0));
        profile_.fault_mask = static_cast<std::uint16_t>(mask.value_or(0));
        for (const char* key : {"status_tag", "fault_mask"}) status_word_key(table, key);
        switch (profile_.diagnosis) {
            case DiagForm::none: return;
            case DiagForm::trip_code:
            case DiagForm::tripped: personality_.diag_octets = 3; break;
            case DiagForm::status_word: personality_.diag_octets = 2; break;
        }
        if (profile_.diagnosis != DiagForm::status_word && !profile_.has_tec)
            table.refuse(
                "form",
                "this form carries EXT DIAGNOSTIC of a TEC OPTION function block: add the table [tec], or write another form.");
        const std::size_t needed = kDiagHeader + kBlockHeader + personality_.diag_octets;
        if (bounded && personality_.max_diag_length < needed)
            table.refuse("max_length", "'max_length' leaves no room for the extended diagnosis: that takes " +
                                           std::to_string(needed) + " octets.");
    }

    void status_word_key(input::Table& table, std::string_view key)
    {
        if (profile_.diagnosis == DiagForm::status_word)
            table.require(key, std::string{key} +
                                   " = ...: the tag of the status word, and its bits that are faults");
        else if (table.has(key))
            table.refuse(key, "'" + std::string{key} +
                                  "' has a meaning only with form = \"status_word\": remove it.");
    }

    void drive_side()
    {
        denied_tags();
        output_loss();
        lamps();
        resolution();
        for (const std::int64_t tag :
             root_.integers("never_written", 1, 0xFFFF).value_or(std::vector<std::int64_t>{}))
            profile_.never_written.push_back(static_cast<std::uint16_t>(tag));
        profile_.has_function_4 = root_.boolean("function_4").value_or(false);
        profile_.has_function_8 = root_.boolean("function_8").value_or(false);
    }

    void resolution()
    {
        profile_.selectable_resolution = root_.boolean("selectable_resolution").value_or(false);
        const auto tag_of = [this](std::string_view key) {
            const auto tag = root_.integer(key, 1, 0xFFFF);
            if (tag && !profile_.selectable_resolution && !root_.has("selectable_resolution"))
                root_.refuse(key, "'" + std::string{key} +
                                      "' has a meaning only with selectable_resolution = true: remove it.");
            return static_cast<std::uint16_t>(tag.value_or(0));
        };
        profile_.resolution_tag = tag_of("resolution_tag");
        profile_.display_decimals_tag = tag_of("display_decimals_tag");
    }

    void denied_tags()
    {
        using drive::DeniedHold;
        const auto said = root_.choice<DeniedHold>(
            "denied_tags", {{"refuse", DeniedHold::where_one}, {"zero", DeniedHold::where_all}});
        const bool has_tec = root_.has("tec");
        if (said && has_tec)
            root_.refuse(
                "denied_tags",
                "a technology box exchanges data also with a tag that its drive denies: remove 'denied_tags', or the table [tec].");
        profile_.denied_holds = has_tec ? DeniedHold::never : said.value_or(DeniedHold::where_one);
    }

    void output_loss()
    {
        const bool is_given = root_.has("output_loss");
        if (is_given && root_.has("tec")) {
            root_.refuse(
                "output_loss",
                "with a TEC OPTION function block RIDE THROUGH alone decides what happens to the outputs: remove 'output_loss', or the table [tec].");
            return;
        }
        if (root_.has("tec")) return;
        root_.require("output_loss", R"(output_loss = "zero")");
        if (const auto loss = root_.choice<drive::ZeroAfter>(
                "output_loss", {{"zero", std::chrono::nanoseconds{0}}, {"hold", std::nullopt}}))
            profile_.zero_after = *loss;
    }

    void lamps()
    {
        root_.require("leds", R"(leds = "option_board")");
        using led::Language;
        const auto language =
            root_.choice<Language>("leds", {{"option_board", Language::option_board},
                                            {"option_board_620", Language::option_board_620},
                                            {"technology_box", Language::technology_box},
                                            {"controller", Language::controller}});
        if (!language) return;
        profile_.leds = *language;
        if (*language == Language::technology_box && !root_.has("tec"))
            root_.refuse(
                "leds",
                "the lamps of a technology box show what its TEC OPTION function block says: add the table [tec], or write another language.");
    }

    const input::TextSource& source_;
    std::string folder_;
    input::Document document_;
    input::Table root_ = document_.root();
    Profile profile_;
    dp::Personality& personality_ = profile_.personality;
};

} // namespace

Result<Profile, input::Faults> load_profile(const input::TextSource& source, const std::string& folder,
                                            const std::string& name)
{
    return ProfileReader{source, folder, name}.read();
}

} // namespace dpslave::profile
