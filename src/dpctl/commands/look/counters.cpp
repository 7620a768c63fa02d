// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"

namespace dpslave::dpctl {
namespace {

struct CountersOptions {};

int run(const CountersOptions& /*options*/, Session& session)
{
    return session.show("GetCounters", Json::object(),
                        [&](const Json& reply) { return render_counters(reply, session.terminal().look()); });
}

} // namespace

const Command kCounters{"counters", kLook,
                        "Counts telegrams, line faults and calls, and shows how long the replies took",
                        add<CountersOptions>, "GetCounters"};

} // namespace dpslave::dpctl
