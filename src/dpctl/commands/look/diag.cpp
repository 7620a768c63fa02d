// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"

namespace dpslave::dpctl {
namespace {

struct DiagOptions : StationOptions {};

int run(const DiagOptions& options, Session& session)
{
    const auto reply = session.ask_of_stations("GetDiagnosis", options.station);
    if (!reply) return reply.error();
    session.print(*reply, [&] { return render_diagnosis(*reply, session.terminal().look()); });
    return kFine;
}

} // namespace

const Command kDiag{"diag", kLook, "Decodes the diagnosis and explains the last refused telegram",
                    add<DiagOptions>, "GetDiagnosis"};

} // namespace dpslave::dpctl
