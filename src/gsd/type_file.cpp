// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/type_file.hpp"

#include <array>
#include <string_view>

namespace dpslave::gsd {
namespace {

struct Field {
    std::string_view text;
    std::size_t width; ///< blanks fill it up; they count for COM ET200
};

/// Appendix B from "vendor" to the ident 0533h in decimal.
constexpr std::array kFields = std::to_array<Field>({
    {"EUROTHERM", 10},
    {"SONSTIGE", 10},
    {"ET200", 10},
    {"DPS/CLASS1", 15},
    {"1331", 5},
});

/// 14 flags: one print of the manual has 14, another 15; all type files with a GSD of their own have 14
///
constexpr std::string_view kFlags = "NJNNNNNNNnnnnn";

/// Min_Slave_Intervall; rates 12M 6M 3M 1.5M - 500 187.5 93.75 19.2 9.6; inputs, outputs, a third length,
/// diagnosis, 7 + 24 octets of Set_Prm (X-12a); then empty lists.
constexpr std::array<std::string_view, 12> kRest{"00020", "0001011111", "032",    "032",   "032", "016",
                                                 "031",   "PV000",      "PSL000", "KV000", "SY",  "DKM000"};

std::string content(TypeName form)
{
    std::string out = "Typbeschreibungsdatei DP-Normslave\r\n";
    const auto line = [&](std::string_view text, std::size_t width) {
        out += text;
        if (text.size() < width) out.append(width - text.size(), ' ');
        out += ";\r\n";
    };
    line("V4.0", 0);
    if (form == TypeName::printed)
        line("EUROTHERM 584/590/620", 21);
    else
        line("EURO 584/590/620", 17);
    for (const Field& field : kFields) line(field.text, field.width);
    for (const char& flag : kFlags) line({&flag, 1}, 0);
    for (const std::string_view text : kRest) line(text, 0);
    return out;
}

} // namespace

std::vector<TypeFile> type_files(TypeName form)
{
    std::vector<TypeFile> files;
    for (const char language : {'E', 'D', 'F', 'S', 'I'})
        files.push_back({std::string{"EU0533T"} + language + ".200", content(form)});
    return files;
}

} // namespace dpslave::gsd
