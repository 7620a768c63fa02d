// SPDX-License-Identifier: Apache-2.0
#include "document.hpp"

#include "case.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <string_view>

namespace conformance {
namespace {

constexpr std::string_view kHead = R"(# Conformance

This page is made by a run of the cases in `tests/conformance`. A test compares it with the next run, character by
character. `tools/run conformance` runs all cases. `tools/run conformance --write` writes the page again.

The cases are those that a certification examines, as far as that is public: section 10 of the
[wire reference](profibus-dp.md). They are no certificate. A certificate is given by a test laboratory of PI, for one
device.

- A case is named after its line of that list. `C03_InvertedBits` belongs to C-03. `B2_` stands for group B2 of the
  test specification PI 2.032, where that list has no line of its own.
- *Simulated*: layer 2 and slave with the shipped profile, on a clock that runs as the case says.
- *Pty*: the same case with the real `dpslaved` at 93.75 kbit/s, over a pty, with a simulated drive. It proves the
  protocol. A pty has no bit times and no levels: they need a real UART and a laboratory.
- *Not applicable* is not passed. The second table says why. *Simulated only* is explained in the third table.
- The option board is the profile `590`, the technology box `605`, the controller `2408f`. All three have two inputs
  and four outputs of a word each. The cases use an encoder of their own, never that of the daemon.

)";

struct Group {
    const char* name;
    const char* aspect;
    const char* cases; ///< where it is tried, or why it cannot be
};

/// The contents of PI 2.032 V2.1 and the list of PROCENTEC, as far as they are public (section 10).
constexpr Group kGroups[]{
    {"2.032 B1", "terminators", "not testable here: electrical, it needs the wired device"},
    {"2.032 B1", "compatibility of the bus interface", "not testable here: electrical"},
    {"2.032 B1", "RS-485 circuitry",
     "not testable here: electrical, it depends on the transceiver that is chosen"},
    {"2.032 B1", "impedance and reflections", "not testable here: electrical, it needs a network analyser"},
    {"2.032 B2", "control interval monitoring", "C-13, C-14"},
    {"2.032 B2", "T_SDR",
     "C-01, C-22, C-29. On the wire: `dpctl tune` and `tools/run bench` measure the machine that is used"},
    {"2.032 B2", "addressing", "C-02, C-23, C-28"},
    {"2.032 B2", "Ident_Number, id of the manufacturer",
     "C-09, C-29. PI assigns an Ident_Number: the project uses those of the devices that it replaces"},
    {"2.032 B2", "transmission speeds", "C-24. On the wire: not testable here, a pty has no rate"},
    {"2.032 B2", "mixed networks", "C-02 (`C02_MixedNetwork`)"},
    {"2.032 B2", "combined FMS and DP slaves",
     "not applicable: no device has FMS (FMS_supp = 0, `C29_Functions`)"},
    {"2.032 B2", "consistency",
     "`B2_Consistency`. An identifier with consistency over its whole length is not tried: no device has "
     "one"},
    {"2.032 B2", "Min_Slave_Intervall", "C-27"},
    {"2.032 B2", "GSD check",
     "C-29, and `dpctl gsd check --strict`. The checker of PI is not available here"},
    {"2.032 B2", "data format", "`B2_DataFormat`"},
    {"2.032 B3", "interruption of the bus", "C-25"},
    {"2.032 B3", "supply of the device off and on",
     "C-25. The supply itself: not testable here, it is that of the machine that is used"},
    {"2.032 B3", "master off and on", "C-25"},
    {"PROCENTEC", "state transitions of DP", "C-08 to C-12, C-21"},
    {"PROCENTEC", "state transitions of DP-V1", "not applicable: the devices are DP-V0"},
    {"PROCENTEC", "takeover by a second master, also of class 2", "C-15, C-16"},
    {"PROCENTEC", "parameters with and without watchdog", "C-08, C-13, C-14"},
    {"PROCENTEC", "Sync and Freeze", "C-17, C-18"},
    {"PROCENTEC", "Fail-Safe",
     "`C12_Clear`. Data_Exchange without data is not applicable: no device has Fail_Safe (`C29_Functions`)"},
    {"PROCENTEC", "diagnosis of the user", "C-19, C-20"},
    {"PROCENTEC", "mandatory diagnosis", "C-08 to C-10, C-20"},
    {"PROCENTEC", "interoperability with one and with several masters",
     "C-08, C-15, C-16. With masters of other makers: not testable here"},
    {"PROCENTEC", "duration", "C-26"},
    {"PROCENTEC", "address range", "C-28"},
    {"PROCENTEC", "GSD", "C-29"},
    {"PROCENTEC", "manual", "[coverage of the manuals](manual-coverage.md)"},
};

/// What certification examines in the device and these cases cannot: the rest of section 10 by its line.
struct Limit {
    const char* what;
    const char* why;
};
constexpr Limit kLimits[]{
    {"Start bit, parity and stop bit of each character, over the pty",
     "A pty carries octets. `fdl` and `io` have tests of their own for marked octets."},
    {"Silence between the characters of a reply", "It depends on the UART and on its driver."},
    {"Switching of the transceiver",
     "A pty has none. `tests/system/direction_test.cpp` looks at the driver enable in time."},
    {"24 hours on a real bus",
     "The simulated clock runs 24 hours. A laboratory has to run them on the machine that is used."},
    {"3, 6 and 12 Mbit/s", "No device has them."},
};

/// By suite and name: what the run says.
using Verdicts = std::map<std::string, std::string>;

Verdicts verdicts_of(const std::vector<std::string>& files)
{
    Verdicts found;
    for (const std::string& file : files) {
        std::ifstream in{file};
        const auto all = nlohmann::json::parse(in, nullptr, false);
        if (all.is_discarded()) continue; // its cases have not run
        for (const auto& suite : all.at("testsuites"))
            for (const auto& one : suite.at("testsuite")) {
                const std::string name =
                    suite.at("name").get<std::string>() + '.' + one.at("name").get<std::string>();
                if (one.at("status") == "NOTRUN") continue;
                if (one.contains("failures"))
                    found[name] = "**failed**";
                else
                    found[name] = one.at("result") == "SKIPPED" ? "not applicable" : "passed";
            }
    }
    return found;
}

std::string verdict(const Verdicts& verdicts, const std::string& wire, const Case& one, const Family& family)
{
    const auto found = verdicts.find(wire + family.suite + '.' + one.name);
    if (found != verdicts.end()) return found->second;
    if (wire == "Pty_" && one.why_simulated != nullptr)
        return one.why_not(family) != nullptr ? "not applicable" : "simulated only";
    return "**not run**";
}

/// "C-03" of "C03_InvertedBits", "B2" of "B2_Consistency".
std::string line_of(const Case& one)
{
    const std::string name = one.name;
    return name[0] == 'C' ? "C-" + name.substr(1, 2) : name.substr(0, 2);
}

std::string first_table(const Verdicts& verdicts)
{
    std::string text = "## Cases\n| line | case | what is asked |";
    std::string under = "|---|---|---|";
    for (const Family& family : families()) {
        text += fmt::format(" {}, simulated | pty |", family.name);
        under += "---|---|";
    }
    text += '\n' + under + '\n';
    for (const Case& one : cases()) {
        text += fmt::format("| {} | `{}` | {} |", line_of(one), one.name, one.asks);
        for (const Family& family : families())
            for (const char* const wire : {"Simulated_", "Pty_"})
                text += fmt::format(" {} |", verdict(verdicts, wire, one, family));
        text += '\n';
    }
    return text;
}

std::string not_applicable()
{
    std::string text = "\n## Not applicable, and why\n| case | family | why |\n|---|---|---|\n";
    for (const Case& one : cases()) {
        std::map<std::string, std::string> families_by_reason;
        std::size_t all = 0;
        for (const Family& family : families())
            if (const char* const why = one.why_not(family)) {
                std::string& names = families_by_reason[why];
                names += (names.empty() ? "" : ", ") + std::string{family.name};
                ++all;
            }
        for (const auto& [why, names] : families_by_reason)
            text +=
                fmt::format("| `{}` | {} | {} |\n", one.name, all == families().size() ? "all" : names, why);
    }
    return text;
}

std::string simulated_only()
{
    std::string text = "\n## Simulated only, and why\n| case | why |\n|---|---|\n";
    for (const Case& one : cases())
        if (one.why_simulated != nullptr) text += fmt::format("| `{}` | {} |\n", one.name, one.why_simulated);
    return text;
}

std::string groups()
{
    std::string text =
        "\n## What certification examines, group by group\n"
        "The groups are the contents page of PI 2.032 V2.1 and the list of PROCENTEC. The test cases behind "
        "them are not public.\n\n| group | aspect | where it is tried, or why it is not |\n|---|---|---|\n";
    for (const Group& group : kGroups)
        text += fmt::format("| {} | {} | {} |\n", group.name, group.aspect, group.cases);
    text += "\n## Not testable here, and why\nAll of group B1 is electrical. Beside it:\n\n| what | why "
            "|\n|---|---|\n";
    for (const Limit& limit : kLimits) text += fmt::format("| {} | {} |\n", limit.what, limit.why);
    return text;
}

} // namespace

std::string document(const std::vector<std::string>& results)
{
    const Verdicts verdicts = verdicts_of(results);
    return std::string{kHead} + first_table(verdicts) + not_applicable() + simulated_only() + groups();
}

} // namespace conformance
