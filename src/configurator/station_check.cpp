// SPDX-License-Identifier: Apache-2.0
#include "dpslave/configurator/station_check.hpp"

#include "device.hpp"
#include "facts.hpp"
#include "recognise.hpp"
#include "verdict.hpp"

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/dp/set_prm.hpp"
#include "dpslave/gsd/sent.hpp"
#include "dpslave/refusal/words.hpp"

#include <algorithm>
#include <charconv>

namespace dpslave::configurator {
namespace {

constexpr const char* kLate = ". Make the machine answer sooner, or make the file with a larger MaxTsdr.";

struct StationFinding {
    std::string_view code;
    bool is_error = true;
    std::string text;
    std::optional<std::uint16_t> tag{};
    unsigned line = 0; ///< of the file
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
        rates();
        measured();
        telegrams();
        last_sent();
        return std::move(findings_);
    }
    const std::string& fits_with() const { return fits_; } ///< empty: refused
    const std::string& uses() const { return uses_; }      ///< empty: nothing is known of the plant

private:
    void error(std::string_view code, std::string text, std::optional<std::uint16_t> tag = {},
               unsigned line = 0)
    {
        findings_.push_back({code, true, std::move(text), tag, line});
    }
    void warn(std::string_view code, std::string text, std::optional<std::uint16_t> tag = {})
    {
        findings_.push_back({code, false, std::move(text), tag});
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
                error(
                    "rate",
                    "the bus runs at " + name +
                        " kbit/s, which the file does not offer: add it to the file, or change the rate of the bus.");
            const auto waits = document_.number("MaxTsdr_" + name);
            if (offered && waits && own != station_.rates.end() && *waits < own->second)
                error(
                    "max_tsdr",
                    "MaxTsdr_" + name + " is " + std::to_string(*waits) + " in the file and " +
                        std::to_string(own->second) +
                        " in the station: the master does not wait long enough. Make the file with this MaxTsdr, or lower [bus] max_tsdr.");
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

    /// Judges the telegrams as the slave itself does, with the modules that the plant uses.
    void telegrams()
    {
        used_ = modules_in_use();
        const Judged judged = judge_as(profile_, station_.keys, document_, used_);
        if (judged.verdict.refused) {
            const dp::RefusalDetail& detail = judged.verdict.refused->detail;
            return error(refusal::code(detail.why), refusal_words(judged), {}, judged.verdict.refused->line);
        }
        for (const profile::Note& note : judged.draft.notes) {
            if (!note.at) continue; // of the file alone
            findings_.push_back({note.code, false, note.text, judged.draft.parameters[*note.at].tag});
        }
        fits_ = fits(judged.verdict);
        if (station_.protocol != "ei-ascii" || judged.verdict.tags_are_open)
            return; // Modbus transports 16 bits
        for (std::size_t i = 0; i < judged.verdict.taken.layout.count; ++i)
            scale(judged.verdict.taken.layout.parameters[i].tag);
    }

    /// Returns for a choice the modules of the master's last Chk_Cfg.
    std::optional<std::vector<const gsd::Module*>> modules_in_use()
    {
        const std::vector<std::uint8_t> cfg = octets_of_hex(station_.last_cfg);
        if (cfg.empty() || gsd::plugging_of(document_) != gsd::Plugging::choice) return std::nullopt;
        auto modules = gsd::modules_in(document_, cfg);
        if (!modules)
            warn(
                "last_sent",
                "the last Chk_Cfg of the master, " + station_.last_cfg +
                    ", is not made of the modules of the file. Import the file into the master's project, and choose its modules again.");
        return modules;
    }

    void scale(std::uint16_t number)
    {
        const drive::Tag* tag = profile_.tags.find(number);
        const std::string name = "tag " + std::to_string(number);
        const auto& seen = station_.unscaled;
        if (std::find(seen.begin(), seen.end(), number) != seen.end())
            error(
                "no_scale",
                name +
                    " answers with a number whose decimals are not known, so data exchange does not start: add its row to the tag table.",
                number);
        else if (tag == nullptr)
            warn("no_scale",
                 name + " is in no tag table: if it is a number, data exchange does not start. Add its row.",
                 number);
        else if (!drive::has_scale(*tag))
            warn(
                "no_scale",
                name + " (" + tag->name +
                    ") has no decimals in the tag table: if it is a number, data exchange does not start. Add them.",
                number);
    }

    void last_sent()
    {
        const std::vector<std::uint8_t> prm = octets_of_hex(station_.last_prm),
                                        cfg = octets_of_hex(station_.last_cfg);
        const bool is_choice = gsd::plugging_of(document_) == gsd::Plugging::choice;
        const gsd::Sent own =
            gsd::sent_by_master(document_, used_ ? *used_ : gsd::plugged_modules(document_));
        if (prm.size() >= dp::kPrmHeader) {
            const std::vector<std::uint8_t> user{prm.begin() + dp::kPrmHeader, prm.end()};
            // The tags of a file that leaves them open are those of the master's project.
            const bool is_open = is_choice && has_no_tags(own.user.octets);
            if (!is_open || user.size() != own.user.octets.size())
                compare("Set_Prm", user, own.user.octets, dp::kPrmHeader);
            if (used_) plant_uses(user);
        }
        if (!cfg.empty() && !is_choice) compare("Chk_Cfg", cfg, own.cfg.octets, 0);
    }

    bool has_no_tags(const std::vector<std::uint8_t>& user) const
    {
        const std::size_t at = profile::personality_of(profile_, station_.keys).prm.tags_at;
        return std::all_of(user.begin() + static_cast<std::ptrdiff_t>(std::min(at, user.size())), user.end(),
                           [](std::uint8_t octet) { return octet == 0; });
    }

    /// Says which modules of the file the plant uses, and with which tags.
    void plant_uses(const std::vector<std::uint8_t>& user)
    {
        std::string modules, tags;
        for (const gsd::Module* module : *used_)
            modules += (modules.empty() ? "" : ", ") + utf8_of_latin1(module->name);
        for (std::size_t at = profile::personality_of(profile_, station_.keys).prm.tags_at;
             at + 2 <= user.size(); at += 2)
            if (const std::uint16_t tag = be16(user, at); tag != 0)
                tags += (tags.empty() ? "" : ", ") + std::to_string(tag);
        uses_ =
            "the plant uses the modules " + modules + (tags.empty() ? "." : " with the tags " + tags + '.');
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
    std::optional<std::vector<const gsd::Module*>> used_; ///< of a choice, by the master's last Chk_Cfg
    std::string fits_, uses_;
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
    Outcome outcome;
    const gsd::Document document = gsd::parse(file);
    const gsd::Findings form = form_of(document, path, strict);
    add_findings(outcome, path, form);
    Json findings = findings_of(form);
    outcome.facts = text_of({{"findings", findings}});
    if (!document.has_section) return outcome;
    const auto profile = load(files, station.profile, table, outcome);
    if (!profile) return outcome;

    const std::string name = printable(station.name);
    std::size_t errors = 0;
    StationJudge judge{document, station, *profile};
    const std::vector<StationFinding> found = judge.judge();
    for (const StationFinding& one : found) {
        errors += one.is_error ? 1 : 0;
        const std::string at = one.line > 0 ? ": line " + std::to_string(one.line) : "";
        outcome.lines.push_back(name + at + (one.is_error ? ": error: " : ": warning: ") +
                                printable(one.text));
        findings.push_back({{"code", one.code},
                            {"severity", one.is_error ? "error" : "warning"},
                            {"text", printable(one.text)}});
        if (one.tag) findings.back()["tag"] = *one.tag;
        if (one.line > 0) findings.back()["line"] = one.line;
    }
    if (!judge.uses().empty()) outcome.lines.push_back(name + ": " + printable(judge.uses()));
    if (errors > 0)
        outcome.lines.push_back(name + ": " + counts(errors, found.size() - errors));
    else if (outcome.exit == kFine)
        outcome.lines.push_back(name + ": the file " + printable(utf8_of_latin1(judge.fits_with())) +
                                (found.empty() ? "" : ' ' + counts(0, found.size()) + '.'));
    else
        outcome.lines.push_back(
            name + ": nothing differs from the station, but the file has errors: correct them first");
    if (errors > 0) outcome.exit = kNo;
    outcome.facts = text_of({{"station", name}, {"findings", findings}});
    return outcome;
}

} // namespace dpslave::configurator
