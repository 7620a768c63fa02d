// SPDX-License-Identifier: Apache-2.0
#include "dpctl/decode/hex.hpp"

#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/commands/commands.hpp"

namespace dpslave::dpctl {
namespace {

struct HexOptions {
    std::vector<std::string> numbers;
};

void set_up(CLI::App& app, HexOptions& options)
{
    app.add_option("NUMBER", options.numbers,
                   "Decimal (288, -300.00), hexadecimal (0x120, >120, 120h) or a range (0-559)")
        ->required()
        ->type_name("");
}

int run(const HexOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    std::vector<Number16> all, single;
    std::string ranges;
    for (const std::string& argument : options.numbers) {
        const auto numbers = read_numbers(argument);
        if (!numbers) {
            terminal.err << "dpctl: " << numbers.error() << '\n';
            return kUsage;
        }
        all.insert(all.end(), numbers->begin(), numbers->end());
        if (numbers->size() == 1)
            single.push_back(numbers->front());
        else
            ranges += (ranges.empty() ? "" : "\n") + render_range(*numbers, terminal.look());
    }
    session.print(hex_json(all), [&] {
        const std::string table = single.empty() ? "" : render_numbers(single, terminal.look());
        return table + (single.empty() || ranges.empty() ? "" : "\n") + ranges;
    });
    return kFine;
}

} // namespace

const Command kHex{"hex",
                   kOffline,
                   "Shows 16-bit numbers in decimal and hexadecimal, with the octets for User_Prm_Data",
                   add<HexOptions>,
                   kOwnForm,
                   "dpctl hex 288 0x120\n"
                   "dpctl hex -300.00       with two decimals, as it goes over the bus: 8AD0\n"
                   "dpctl hex 0-559         the table of the manuals",
                   "",
                   Asks::nobody};

} // namespace dpslave::dpctl
