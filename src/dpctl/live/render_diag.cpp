// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/table.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

Table octet_table(const Json& octets)
{
    Table table({">OCTET", ">OFFSET", "VALUE", "MEANING"});
    for (const Json& o : octets)
        table.add({number(o, "octet"), number(o, "offset"),
                   fmt::format("0x{:02X}", integer(o, "value").value_or(0)), text(o, "meaning")});
    return table;
}

std::string refusal_lines(const Json& refusal, Look look)
{
    const auto octet = integer(refusal, "octet");
    const std::string where = octet ? fmt::format(", octet {} (offset {})", *octet, *octet - 1) : "";
    std::string out = paragraph(
        "  ", fmt::format("{} refused{}: {}", text(refusal, "telegram"), where, text(refusal, "what")),
        look.width);
    Block block;
    if (const std::string expected = text(refusal, "expected", ""); !expected.empty())
        block.add("expected", expected);
    if (const std::string got = text(refusal, "got", ""); !got.empty()) block.add("came", got);
    block.add("what to do", text(refusal, "advice"));
    return out + block.str(4, look);
}

} // namespace

std::string render_diagnosis(const Json& reply, Look look)
{
    std::string out;
    for (const Json& d : list(reply, "stations")) {
        const std::string bits = joined(list(d, "bits"), ", ");
        out += (out.empty() ? "" : "\n") +
               paragraph(text(d, "name") + ": ", bits.empty() ? "no bit set" : bits, look.width);
        out += octet_table(list(d, "octets")).str(look, 2);
        if (const Json& refusal = part(d, "refusal"); !refusal.empty()) out += refusal_lines(refusal, look);
        for (const Json& trouble : list(d, "trouble"))
            if (trouble.is_string()) out += paragraph("  ", trouble.get<std::string>(), look.width);
        Block block;
        block.add("Slave_Diag", text(d, "hex"));
        block.add("last Set_Prm", text(d, "last_prm"));
        block.add("last Chk_Cfg", text(d, "last_cfg"));
        out += block.str(2, look);
    }
    if (!out.empty())
        out += '\n' + paragraph("",
                                "octet: counted from 1, as the PROFIBUS standard does; offset: counted from "
                                "0, as PLC programs do",
                                look.width);
    return out;
}

} // namespace dpslave::dpctl
