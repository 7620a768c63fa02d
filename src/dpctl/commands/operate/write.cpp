// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/explain.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/live/tag_names.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

struct WriteOptions {
    std::string station, tag, value;
    bool yes = false; ///< does not ask
};

/// Empty: `text` is one tag, by number or by name.
std::string one_tag_fault(const std::string& text)
{
    const auto typed = read_tags(text);
    if (!typed) return typed.error();
    const bool is_one = typed->size() == 1 && typed->front().span.first == typed->front().span.last;
    return is_one ? std::string{} : '"' + text + "\": write one tag, by its number or its whole name";
}

void set_up(CLI::App& app, WriteOptions& options)
{
    add_text(app, "TAG", options.tag, "", "Tag of the drive: number (56, 0x38) or whole name", one_tag_fault)
        ->required();
    add_text(app, "VALUE", options.value, "",
             "As the drive shows it: -12.5, 0x00FF for a WORD, a name of an ENUM")
        ->required();
    add_station_option(app, options.station);
    app.add_flag("--yes", options.yes, "Do not ask on a terminal");
}

/// Prints station, number, name and value as they are. A drive that does not say the value may take a new
/// one. The failure is an exit status.
std::optional<int> print_before(const Json& tag, Session& session)
{
    const auto reply = session.call("ReadTag", tag);
    std::ostream& out = session.terminal().out;
    if (reply) {
        out << render_tag(printable_texts(*reply), "is") << std::flush;
        return std::nullopt;
    }
    const auto& refused = reply.error().refused;
    if (!refused || refused->error != "org.dpslaved.Control.DriveRefused")
        return session.print_stopped(reply.error());
    out << "its value is not known: "
        << explain({printable_texts(refused->parameters), refused->error, false}) << std::endl;
    return std::nullopt;
}

int run(const WriteOptions& options, Session& session)
{
    const auto tag = find_whole_tag(options.tag, options.station, session);
    if (!tag) return tag.error();
    Json parameters = station_parameter(options.station);
    parameters["tag"] = *tag;
    if (!session.json()) {
        if (const auto failed = print_before(parameters, session)) return *failed;
        if (!options.yes && !session.agrees(fmt::format("Write {}?", printable(options.value)))) {
            session.terminal().err << "dpctl: nothing was written\n";
            return kNo;
        }
    }
    parameters["value"] = options.value;
    return session.show("WriteTag", parameters,
                        [](const Json& reply) { return render_tag(reply, "is now"); });
}

} // namespace

const Command kWrite{"write",
                     kOperate,
                     "Writes a tag of the drive now (root and the operator group)",
                     add<WriteOptions>,
                     "WriteTag",
                     "dpctl write 56 -12.5 --station unwinder\n"
                     "dpctl write \"speed demand\" 12.5    by its whole name",
                     "1 also if you answered no"};

} // namespace dpslave::dpctl
