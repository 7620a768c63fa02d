// SPDX-License-Identifier: Apache-2.0
#include "dpslave/configurator/station_check.hpp"

#include "device.hpp"
#include "facts.hpp"
#include "import.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>
#include <charconv>

namespace dpslave::configurator {
namespace {

constexpr std::size_t kPrmHeader = 7; ///< octets of Set_Prm before User_Prm_Data (wire reference 4.4)

constexpr const char* kLate = ". Make the machine answer sooner, or make the file with a larger MaxTsdr.";

struct StationFinding {
    std::string_view code;
    bool is_error = true;
    std::string text;
    std::optional<std::uint16_t> tag{};
};

/// "88 01 0A" as octets; what is no octet ends it.
std::vector<std::uint8_t> octets_of_hex(std::string_view text)
{
    std::vector<std::uint8_t> octets;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        std::uint8_t octet = 0;
        if (std::from_chars(word.data(), word.data() + word.size(), octet, 16).ec != std::errc{}) break;
        octets.push_back(octet);
        text.remove_prefix(std::min(text.size(), word.size() + 1));
    }
    return octets;
}

class StationJudge {
public:
    StationJudge(const gsd::Document& document, const RunningStation& station,
                 const profile::Profile& profile)
        : document_(document), station_(station), profile_(profile)
    {}

    std::vector<StationFinding> judge()
    {
        ident();
        rates();
        measured();
        parameters();
        last_sent();
        return std::move(findings_);
    }

private:
    void error(std::string_view code, std::string text, std::optional<std::uint16_t> tag = {})
    {
        findings_.push_back({code, true, std::move(text), tag});
    }
    void warn(std::string_view code, std::string text, std::optional<std::uint16_t> tag = {})
    {
        findings_.push_back({code, false, std::move(text), tag});
    }

    void ident()
    {
        const std::uint32_t own = document_.number("Ident_Number").value_or(0);
        if (own == station_.ident) return;
        error("ident",
              "the file has the Ident_Number " + hex_of(own) + ", the station has " + hex_of(station_.ident) +
                  ": the station refuses the master. Take the file of this device, or write ident = " +
                  hex_of(own) + " into the station.");
    }

    void rates()
    {
        for (const Baud baud : kBauds) {
            const std::string name{text(baud)};
            const auto rate = static_cast<std::uint32_t>(baud);
            const auto own = std::find_if(station_.rates.begin(), station_.rates.end(),
                                          [&](const auto& each) { return each.first == rate; });
            const bool offered = document_.number(name + "_supp").value_or(0) == 1;
            if (offered && own == station_.rates.end())
                warn("rate", "the file offers " + name + " kbit/s, which the station does not have.");
            if (!offered && rate == station_.baud)
                error("rate", "the bus runs at " + name +
                                  " kbit/s, which the file does not offer: add it to the file, or change the "
                                  "rate of the bus.");
            const auto waits = document_.number("MaxTsdr_" + name);
            if (offered && waits && own != station_.rates.end() && *waits < own->second)
                error("max_tsdr", "MaxTsdr_" + name + " is " + std::to_string(*waits) + " in the file and " +
                                      std::to_string(own->second) +
                                      " in the station: the master does not wait long enough. Make the file "
                                      "with this MaxTsdr, or lower [bus] max_tsdr.");
        }
    }

    void measured()
    {
        const auto baud = baud_of(station_.baud);
        if (!baud || !station_.usual_reply) return;
        const std::string keyword = "MaxTsdr_" + std::string{text(*baud)};
        const auto waits = document_.number(keyword);
        if (!waits) return;
        if (*station_.usual_reply > *waits)
            error("measured", "replies take up to " + std::to_string(*station_.usual_reply) +
                                  " bit times, and " + keyword + " of the file is " + std::to_string(*waits) +
                                  kLate);
        else if (station_.slowest_reply.value_or(0) > *waits)
            warn("measured", "a single reply took " + std::to_string(*station_.slowest_reply) +
                                 " bit times, more than " + keyword + " of the file, " +
                                 std::to_string(*waits) + kLate);
    }

    void parameters()
    {
        const auto mapping = mapping_of_file(document_, profile_);
        if (!mapping) {
            for (const std::string& sentence : mapping.error()) error("mapping", sentence);
            return;
        }
        const profile::Draft draft = profile::draft_of(profile_, mapping->selection);
        for (const profile::Note& note : draft.notes) {
            if (!note.at && note.code.starts_with("ident")) continue; // judged by the station's own
            const auto tag = note.at ? std::optional{draft.parameters[*note.at].tag} : std::nullopt;
            findings_.push_back({note.code, note.refuses, note.text, tag});
        }
        if (station_.protocol != "ei-ascii") return; // Modbus transports 16 bits
        for (const profile::Parameter& parameter : draft.parameters) scale(parameter.tag);
    }

    void scale(std::uint16_t number)
    {
        const drive::Tag* tag = profile_.tags.find(number);
        const std::string name = "tag " + std::to_string(number);
        const auto& seen = station_.unscaled;
        if (std::find(seen.begin(), seen.end(), number) != seen.end())
            error("no_scale",
                  name +
                      " answers with a number whose decimals are not known, so data exchange does not start: "
                      "add its row to the tag table.",
                  number);
        else if (tag == nullptr)
            warn("no_scale",
                 name + " is in no tag table: if it is a number, data exchange does not start. Add "
                        "its row.",
                 number);
        else if (!drive::has_scale(*tag))
            warn("no_scale",
                 name + " (" + tag->name +
                     ") has no decimals in the tag table: if it is a number, data exchange does "
                     "not start. Add them.",
                 number);
    }

    void last_sent()
    {
        const std::vector<std::uint8_t> prm = octets_of_hex(station_.last_prm),
                                        cfg = octets_of_hex(station_.last_cfg);
        // Without a fixed order of modules the tags and the modules are those of the master's tool.
        if (document_.plugged().empty()) return;
        if (prm.size() >= kPrmHeader)
            compare("Set_Prm", {prm.begin() + kPrmHeader, prm.end()}, document_.user_prm_data(), kPrmHeader);
        if (!cfg.empty()) compare("Chk_Cfg", cfg, identifiers_of(document_), 0);
    }

    void compare(const std::string& telegram, const std::vector<std::uint8_t>& sent,
                 const std::vector<std::uint8_t>& own, std::size_t before)
    {
        const auto [a, b] = std::mismatch(sent.begin(), sent.end(), own.begin(), own.end());
        if (a == sent.end() && b == own.end()) return;
        const auto octet = static_cast<std::size_t>(a - sent.begin()) + before + 1;
        const std::string there =
            a == sent.end() ? "the master's ends there" : "the master sent " + hex_of_octet(*a);
        const std::string here =
            b == own.end() ? "the file's ends there" : "the file has " + hex_of_octet(*b);
        warn("last_sent", "the last " + telegram +
                              " of the master is another than that of the file: in octet " +
                              std::to_string(octet) + " " + there + ", " + here +
                              ". Import the file into the master's project, and download the project.");
    }

    static std::string hex_of_octet(std::uint8_t octet) { return hex_of(octet).erase(2, 2); }

    const gsd::Document& document_;
    const RunningStation& station_;
    const profile::Profile& profile_;
    std::vector<StationFinding> findings_;
};

std::string counts(std::size_t errors, std::size_t warnings)
{
    return std::to_string(errors) + (errors == 1 ? " error, " : " errors, ") + std::to_string(warnings) +
           (warnings == 1 ? " warning" : " warnings");
}

} // namespace

Outcome check_with_station(const Files& files, std::string_view file, const std::string& path, bool strict,
                           const RunningStation& station, const std::string& table)
{
    Outcome outcome = check(file, path, strict);
    const gsd::Document document = gsd::parse(file);
    if (!document.has_section) return outcome;
    const auto profile = load(files, station.profile, table, outcome);
    if (!profile) return outcome;

    Json findings = Json::parse(outcome.facts, nullptr, false)["findings"];
    std::size_t errors = 0;
    const std::vector<StationFinding> found = StationJudge{document, station, *profile}.judge();
    for (const StationFinding& one : found) {
        errors += one.is_error ? 1 : 0;
        outcome.lines.push_back(printable(station.name) + (one.is_error ? ": error: " : ": warning: ") +
                                printable(one.text));
        findings.push_back({{"code", one.code},
                            {"severity", one.is_error ? "error" : "warning"},
                            {"text", printable(one.text)}});
        if (one.tag) findings.back()["tag"] = *one.tag;
    }
    outcome.lines.push_back(printable(station.name) + ": " +
                            (!found.empty()          ? counts(errors, found.size() - errors)
                             : outcome.exit == kFine ? "the file fits the station"
                                                     : "nothing differs from the station, but the file has "
                                                       "errors: correct them first"));
    if (errors > 0) outcome.exit = kNo;
    outcome.facts = text_of({{"station", printable(station.name)}, {"findings", findings}});
    return outcome;
}

} // namespace dpslave::configurator
