// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"

namespace dpslave::dpctl {
namespace {

struct BusOptions {};

int run(const BusOptions& /*options*/, Session& session)
{
    return session.show("GetBus", Json::object(), [&](const Json& reply) {
        return render_bus(report::read<report::GetBusReply>(reply), session.terminal().look());
    });
}

} // namespace

const Command kBus{
    "bus",           kLook,    "Shows who is on the bus: masters, slaves, cycles, retries, load",
    add<BusOptions>, "GetBus", "dpctl bus            also addresses that a master asks and nobody answers"};

} // namespace dpslave::dpctl
