// SPDX-License-Identifier: Apache-2.0
/// A GSD file: read, checked both ways, mapped. Judged: every remark has its line in the text; identifiers
/// stand in their octets; and a file that gsd::write makes of names, identifiers and parameters from the
/// input is read as these.
#include "input.hpp"

#include "dpslave/gsd/check.hpp"
#include "dpslave/gsd/device.hpp"
#include "dpslave/gsd/identifier.hpp"
#include "dpslave/gsd/io_map.hpp"
#include "dpslave/gsd/sent.hpp"

namespace {

using namespace dpslave;
using fuzz::demand;

void judge_text(std::string_view text)
{
    const gsd::Document document = gsd::parse(text);
    // A lone CR ends a line as well.
    const auto lines =
        static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return c == '\n' || c == '\r'; })) +
        1;
    for (const auto& remark : document.remarks)
        demand(remark.line <= lines && !remark.what.empty(), "a remark has its line in the text");
    for (const auto reading : {gsd::Reading::tolerant, gsd::Reading::strict}) {
        unsigned last = 0;
        for (const auto& finding : gsd::check(document, reading, "EURO0533.GSD")) {
            demand(finding.line <= lines && !finding.what.empty(), "a finding has its line in the text");
            demand(finding.what.find('\n') == std::string::npos, "a finding is one line");
            demand(finding.line >= last, "findings are in the order of the lines");
            last = finding.line;
        }
    }
    for (const auto& module : document.modules) {
        demand(module.line <= lines, "a module has its line in the text");
        const auto sum = gsd::sum_of_identifiers(module.identifiers);
        demand(!sum || sum->length == module.identifiers.size(), "identifiers stand in their octets");
    }
    const gsd::Sent sent = gsd::sent_by_master(document, gsd::plugged_modules(document));
    demand(sent.user.octets.size() <= 237, "User_Prm_Data fits in a Set_Prm");
    for (const gsd::LinedOctets* octets : {&sent.user, &sent.cfg}) {
        demand(octets->octets.size() == octets->lines.size(), "each octet has its line");
        for (const unsigned line : octets->lines) demand(line <= lines, "an octet has its line in the text");
    }
    const gsd::IoMap map = gsd::io_map(document, {});
    for (const auto* values : {&map.inputs, &map.outputs})
        for (const auto& value : *values)
            demand(value.octet + value.octets <= (values == &map.inputs ? map.in_octets : map.out_octets),
                   "a value lies in its telegram");
}

/// A text that a GSD can hold as it is: letters, digits, blanks inside.
std::string name_of(fuzz::Input& input)
{
    std::string name{'x'};
    for (const std::uint8_t octet : input.octets(input.octet() % 30))
        name += "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+"[octet % 64];
    return name;
}

void judge_writing(fuzz::Input& input)
{
    gsd::Device device;
    device.vendor = name_of(input);
    device.model = name_of(input);
    device.revision = device.hardware = device.software = "V1.0";
    device.ident = input.word();
    device.max_tsdr.fill(Tbit{60});
    device.max_module = 8;
    device.max_in = device.max_out = 244;
    device.max_data = 488;
    const auto prm = input.octets(input.octet() % 100);
    device.user_prm_data.assign(prm.begin(), prm.end());
    for (int modules = 1 + input.octet() % 6; modules > 0; --modules)
        device.modules.push_back({std::to_string(modules) + name_of(input), {input.octet()}});
    const std::string text = gsd::write(device);
    demand(text == gsd::write(device), "the same device has the same file");
    const gsd::Document read = gsd::parse(text);
    demand(read.text("Vendor_Name") == device.vendor && read.text("Model_Name") == device.model,
           "names are read as they were written");
    demand(read.number("Ident_Number") == device.ident, "the ident is read as it was written");
    demand(gsd::sent_by_master(read, {}).user.octets == device.user_prm_data,
           "User_Prm_Data is read as it was written");
    demand(read.modules.size() == device.modules.size(), "each module is read");
    for (std::size_t i = 0; i < read.modules.size(); ++i)
        demand(read.modules[i].name == device.modules[i].name &&
                   read.modules[i].identifiers == device.modules[i].identifiers,
               "a module is read as it was written");
    for (std::size_t from = 0, to = 0; from < text.size(); from = to + 1) {
        to = std::min(text.find('\n', from), text.size());
        const bool is_info_text = text.compare(from, 9, "Info_Text") == 0;
        demand(is_info_text || to - from <= gsd::kMaxLine + 1, "lines are short");
    }
    judge_text(text);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size > 0 && data[0] == 0) {
        fuzz::Input input{data + 1, size - 1};
        judge_writing(input);
    } else {
        judge_text(fuzz::text_of(data, size));
    }
    return 0;
}
