// SPDX-License-Identifier: Apache-2.0
#include "check_parts.hpp"
#include "keywords.hpp"
#include "text.hpp"

#include <algorithm>
#include <array>

namespace dpslave::gsd {
namespace {

/// Every GSD has these, whatever its revision; `example` is the line to add.
struct Needed {
    std::string_view keyword, example;
    bool of_a_slave;
};
constexpr std::array kNeeded = std::to_array<Needed>({
    {"Vendor_Name", "Vendor_Name = \"...\"", false},
    {"Model_Name", "Model_Name = \"...\"", false},
    {"Revision", "Revision = \"...\"", false},
    {"Ident_Number", "Ident_Number = 0x1234, with the number that the slave reports", false},
    {"Protocol_Ident", "Protocol_Ident = 0", false},
    {"Station_Type", "Station_Type = 0", false},
    {"Hardware_Release", "Hardware_Release = \"...\"", false},
    {"Software_Release", "Software_Release = \"...\"", false},
    {"Min_Slave_Intervall", "Min_Slave_Intervall = 20, in units of 0.1 ms", true},
});

void missing(Judge& judge, Weight weight, std::string_view keyword, std::string_view example)
{
    judge.say(0, weight, std::string{keyword} + " is missing: add " + std::string{example} + '.');
}

void check_needed(Judge& judge)
{
    const bool slave = !judge.on("Station_Type");
    for (const Needed& needed : kNeeded)
        if (judge.document.find(needed.keyword) == nullptr && (slave || !needed.of_a_slave))
            missing(judge, Weight::error, needed.keyword, needed.example);
    if (judge.document.find("GSD_Revision") == nullptr)
        missing(judge, Weight::warning, "GSD_Revision",
                "GSD_Revision = 1 or higher; a file without it is of the form before revision 1");
    if (!slave) return;
    if (judge.document.find("Max_Diag_Data_Len") == nullptr)
        missing(judge, judge.revision > 0 ? Weight::error : Weight::warning, "Max_Diag_Data_Len",
                "Max_Diag_Data_Len = 6, or more if the slave sends an extended diagnosis");
    if (judge.document.find("Slave_Family") == nullptr && judge.revision > 0)
        missing(judge, Weight::error, "Slave_Family", "Slave_Family = 0, or the number of a family");
    if (judge.document.find("Fail_Safe") == nullptr)
        missing(judge, Weight::pedantic, "Fail_Safe", "Fail_Safe = 0");
}

void check_rates(Judge& judge)
{
    bool any = false;
    for (const std::string_view rate : kRates) {
        const std::string supp = std::string{rate} + "_supp";
        const std::string tsdr = "MaxTsdr_" + std::string{rate};
        const bool supported = judge.on(supp);
        any = any || supported;
        if (supported && judge.document.find(tsdr) == nullptr)
            judge.say(
                judge.line_of(supp), Weight::error,
                supp + " = 1, but " + tsdr +
                    " is missing: add it, with the bit times after which the slave answers at the latest.");
        if (!supported && judge.document.find(tsdr) != nullptr)
            judge.say(judge.line_of(tsdr), Weight::warning,
                      tsdr + " is here, but " + supp + " is not 1: remove one, or add the other.");
        if (const auto bits = judge.document.number(tsdr); supported && bits && *bits < 11)
            judge.say(judge.line_of(tsdr), Weight::warning,
                      tsdr +
                          " is below 11 bit times, before which no slave may answer: write the true value.");
    }
    if (!any) judge.say(0, Weight::error, "no rate is supported: add 9.6_supp = 1 and the like.");
}

void check_lengths(Judge& judge)
{
    const Document& document = judge.document;
    const auto in = document.number("Max_Input_Len");
    const auto out = document.number("Max_Output_Len");
    if (judge.on("Modular_Station"))
        for (const char* keyword : {"Max_Module", "Max_Input_Len", "Max_Output_Len"})
            if (document.find(keyword) == nullptr)
                judge.say(judge.line_of("Modular_Station"), Weight::error,
                          std::string{keyword} + " is missing, which a modular station needs: add it.");
    if (const auto data = document.number("Max_Data_Len"); data && in && out) {
        if (*data < std::max(*in, *out))
            judge.say(judge.line_of("Max_Data_Len"), Weight::warning,
                      "Max_Data_Len is below Max_Input_Len or Max_Output_Len: it counts both together.");
        if (*data > *in + *out)
            judge.say(judge.line_of("Max_Data_Len"), Weight::warning,
                      "Max_Data_Len is above Max_Input_Len and Max_Output_Len together: write " +
                          std::to_string(*in + *out) + " or less.");
    }
    const auto diag = document.number("Max_Diag_Data_Len");
    for (const Entry& entry : document.keywords) {
        if (!same_any_case(entry.keyword, "Unit_Diag_Bit") || !entry.index || !diag) continue;
        const std::uint64_t needed =
            6 + 1 + std::uint64_t{*entry.index} / 8 + 1; // header of the block before bit 0
        if (needed > *diag)
            judge.say(entry.line, Weight::error,
                      "this bit of the diagnosis lies beyond Max_Diag_Data_Len, which would have to be " +
                          std::to_string(needed) + ": correct one of the two.");
    }
}

void check_old_style(Judge& judge)
{
    const Document& document = judge.document;
    const Entry* data = document.find("User_Prm_Data");
    const Entry* length = document.find("User_Prm_Data_Len");
    if (data != nullptr && length == nullptr)
        judge.say(data->line, Weight::error,
                  "User_Prm_Data without User_Prm_Data_Len: add its length in octets.");
    if (data == nullptr || length == nullptr) return;
    const auto octets = parse_octets(data->value);
    const auto number = parse_number(length->value);
    if (octets && number && octets->size() != *number)
        judge.say(data->line, Weight::error,
                  "User_Prm_Data has " + count_of(octets->size(), "octet") +
                      ", but User_Prm_Data_Len in line " + std::to_string(length->line) + " says " +
                      std::to_string(*number) + ": make them agree.");
    if (document.find("Max_User_Prm_Data_Len") != nullptr)
        judge.say(
            data->line, Weight::warning,
            "User_Prm_Data and Max_User_Prm_Data_Len exclude each other: old tools take the first, new tools the second. Keep one.");
}

} // namespace

void check_device(Judge& judge)
{
    check_needed(judge);
    check_rates(judge);
    if (const Entry* const type = judge.document.find("Station_Type");
        type != nullptr && judge.on("Station_Type"))
        return judge.say(type->line, Weight::warning,
                         "Station_Type = 1: this is the file of a master, and only its form is judged.");
    check_lengths(judge);
    check_old_style(judge);
}

void check_file_name(Judge& judge, std::string_view file_name)
{
    const auto dot = file_name.rfind('.');
    const std::string_view stem = file_name.substr(0, dot);
    const std::string_view extension = dot == std::string_view::npos ? "" : file_name.substr(dot + 1);
    if (extension.size() != 3 || !same_any_case(extension.substr(0, 2), "gs"))
        judge.say(0, Weight::warning,
                  "the file's name " + in_quotes(file_name) +
                      " does not end in .GSD, or in .GSE and the like for one language: rename it.");
    if (stem.size() != 8)
        judge.say(
            0, Weight::warning,
            "the file's name " + in_quotes(file_name) +
                " is not of the form VVVVIIII.GSD (four characters for the vendor, the Ident_Number in four hexadecimal digits): rename it.");
    const auto ident = judge.document.number("Ident_Number");
    if (ident && stem.size() == 8 && !same_any_case(stem.substr(4), hex_word(*ident).substr(2)))
        judge.say(judge.line_of("Ident_Number"), Weight::warning,
                  "the file's name " + in_quotes(file_name) + " does not end in " +
                      hex_word(*ident).substr(2) + ", the Ident_Number: rename it, or correct the number.");
}

} // namespace dpslave::gsd
