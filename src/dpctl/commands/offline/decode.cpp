// SPDX-License-Identifier: Apache-2.0
#include "dpctl/decode/decode.hpp"

#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/commands/commands.hpp"

#include "dpslave/io/file.hpp"

#include <algorithm>

namespace dpslave::dpctl {
namespace {

struct DecodeOptions : ProfilesOption {
    std::vector<std::string> octets;
    std::string form;    ///< prm, cfg or diag; empty = found out
    std::string profile; ///< empty = not said
};

void set_up(CLI::App& app, DecodeOptions& options)
{
    app.add_option("HEX", options.octets, "Octets: 10 05 02 49 50 16, with or without blanks")
        ->required()
        ->type_name("");
    add_choice(app, "--as", options.form, {"prm", "cfg", "diag"},
               "The octets are those of a Set_Prm, a Chk_Cfg or a Slave_Diag");
    add_profile(app, options.profile,
                "Explain tags, modules and the extended diagnosis as those of this device");
    add_profiles(app, options);
}

int run(const DecodeOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    const auto octets = read_octets(options.octets);
    if (!octets) {
        terminal.err << "dpctl: " << octets.error() << '\n';
        return kUsage;
    }
    std::optional<profile::Profile> device;
    if (!options.profile.empty()) {
        auto loaded = profile::load_profile(io::read_regular_file, options.profiles, options.profile);
        if (!loaded) {
            for (const input::Fault& fault : loaded.error())
                terminal.err << "dpctl: " << to_string(fault) << '\n';
            return kNo;
        }
        device = *std::move(loaded);
    }
    const DecodeContext context{.device = device ? &*device : nullptr, .tags = {}};
    const auto form = form_called(options.form); // another name does not pass the command line
    const auto parts =
        form ? std::vector<Decoded>{decode_as(*form, *octets, context)} : decode_all(*octets, context);
    session.print(decoded_json(parts), [&] { return render_decoded(parts, terminal.look()); });
    const bool sound =
        std::all_of(parts.begin(), parts.end(), [](const Decoded& part) { return part.faults.empty(); });
    return sound ? kFine : kNo;
}

} // namespace

const Command kDecode{"decode",
                      kOffline,
                      "Explains a PROFIBUS telegram or a diagnosis in words",
                      add<DecodeOptions>,
                      kOwnForm,
                      "dpctl decode 68 05 05 68 85 82 6D 3C 3E EE 16\n"
                      "dpctl decode --as prm 88 01 0A 0B 05 33 00    octets as dpctl diag prints them\n"
                      "dpctl decode 00 0C 00 01 16 49 04 01 6A B5 --profile 605",
                      "",
                      Asks::nobody};

} // namespace dpslave::dpctl
