// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/table.hpp"

#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

Table octet_table(const std::vector<report::DiagOctet>& octets)
{
    Table table({">OCTET", ">OFFSET", "VALUE", "MEANING"});
    for (const report::DiagOctet& o : octets)
        table.add({number(o.octet), number(o.offset), fmt::format("0x{:02X}", o.value), o.meaning});
    return table;
}

std::string refusal_lines(const report::Refusal& refusal, Look look)
{
    const std::string where =
        refusal.octet ? fmt::format(", octet {} (offset {})", *refusal.octet, *refusal.octet - 1) : "";
    std::string out =
        paragraph("  ", fmt::format("{} refused{}: {}", refusal.telegram, where, refusal.what), look.width);
    Block block;
    if (refusal.expected) block.add("expected", *refusal.expected);
    if (refusal.got) block.add("came", *refusal.got);
    block.add("what to do", refusal.advice);
    return out + block.str(4, look);
}

} // namespace

std::string render_diagnosis(const Json& reply, Look look)
{
    std::string out;
    for (const report::Diagnosis& d : report::read<report::GetDiagnosisReply>(reply).stations) {
        const std::string bits = joined(d.bits, ", ");
        out += (out.empty() ? "" : "\n") +
               paragraph(d.name + ": ", bits.empty() ? "no bit set" : bits, look.width);
        out += octet_table(d.octets).str(look, 2);
        if (d.refusal) out += refusal_lines(*d.refusal, look);
        for (const std::string& trouble : d.trouble) out += paragraph("  ", trouble, look.width);
        Block block;
        block.add("Slave_Diag", d.hex);
        block.add("last Set_Prm", d.last_prm);
        block.add("last Chk_Cfg", d.last_cfg);
        out += block.str(2, look);
    }
    if (!out.empty())
        out +=
            '\n' +
            paragraph(
                "",
                "octet: counted from 1, as the PROFIBUS standard does; offset: counted from 0, as PLC programs do",
                look.width);
    return out;
}

} // namespace dpslave::dpctl
