// SPDX-License-Identifier: Apache-2.0
// From a call to its reply: which interface, which method, is it permitted, are the parameters right, what
// does the handler say.
#include "server_impl.hpp"

#include <algorithm>
#include <exception>
#include <iterator>

namespace dpslave::control {
namespace {

/// A handler sees a nullable parameter only when it has a value.
void remove_nulls(Json& parameters)
{
    for (auto it = parameters.begin(); it != parameters.end();)
        it = it->is_null() ? parameters.erase(it) : std::next(it);
}

Error service_error(std::string_view name, std::string_view field, std::string value)
{
    return {std::string{kServiceInterface} + '.' + std::string{name},
            Json::object({{std::string{field}, std::move(value)}})};
}

std::string full_name(const Call& call)
{
    return call.interface + '.' + call.method;
}

} // namespace

void Server::Impl::dispatch(Connection& connection, Call& call)
{
    ++counters.calls;
    Reply reply;
    try {
        reply = answer(connection, call);
    } catch (
        const std::exception&) { // a fault of the program ends this connection, not the exchange on the bus
        ++counters.handler_failures;
        return connection.kill();
    }
    deliver(connection, call, reply);
}

Reply Server::Impl::answer(const Connection& connection, Call& call)
{
    if (call.upgrade) return service_error("MethodNotImplemented", "method", full_name(call));
    const bool service = call.interface == kServiceInterface;
    if (!service && call.interface != kInterface)
        return service_error("InterfaceNotFound", "interface", call.interface);

    const Interface& interface = service ? service_interface : own_interface;
    const auto method = interface.methods.find(call.method);
    if (method == interface.methods.end()) return service_error("MethodNotFound", "method", full_name(call));
    if (const auto entry =
            std::find_if(kMethods.begin(), kMethods.end(),
                         [&](const MethodEntry& m) { return !service && m.name == call.method; });
        entry != kMethods.end() && entry->right == Right::operate && !connection.operates) {
        ++counters.not_permitted;
        return Error{"NotPermitted", Json::object({{"group", settings.operator_group_name}})};
    }
    if (auto wrong = mismatch(interface, method->second.in, call.parameters))
        return service_error("InvalidParameter", "parameter", std::move(*wrong));
    return service ? answer_service(call) : answer_own(connection, call);
}

Reply Server::Impl::answer_service(const Call& call) const
{
    if (call.method == "GetInfo")
        return Done{Json::object({{"vendor", "dpslaved"},
                                  {"product", "dpslaved"},
                                  {"version", settings.version},
                                  {"url", settings.url},
                                  {"interfaces", Json::array({kServiceInterface, kInterface})}})};
    const auto& wanted = call.parameters.at("interface").get_ref<const std::string&>();
    if (wanted == kInterface) return Done{Json::object({{"description", interface_text()}})};
    if (wanted == kServiceInterface) return Done{Json::object({{"description", service_interface_text()}})};
    return service_error("InterfaceNotFound", "interface", wanted);
}

Reply Server::Impl::answer_own(const Connection& connection, Call& call)
{
    remove_nulls(call.parameters);
    Caller caller = connection.caller;
    caller.more = call.more;
    caller.operates = connection.operates;
    return handlers.find(call.method)->second(call.parameters, caller);
}

void Server::Impl::deliver(Connection& connection, const Call& call, const Reply& reply)
{
    if (std::holds_alternative<Error>(reply)) ++counters.errors;
    if (call.oneway) return; // a later reply has no receiver
    if (const auto* later = std::get_if<Later>(&reply)) {
        if (!laters.emplace(later->token, &connection).second) return send_final(connection, Error{"Busy"});
        connection.waits = Connection::Waits::later;
        connection.number = later->token;
        return;
    }
    const auto* stream = std::get_if<Stream>(&reply);
    if (stream == nullptr) return send_final(connection, reply);
    if (!call.more) return send_final(connection, Done{stream->first});
    if (!streams.emplace(stream->stream, &connection).second) return send_final(connection, Error{"Busy"});
    connection.waits = Connection::Waits::stream;
    connection.number = stream->stream;
    send(connection, encode_reply({stream->first}, true));
}

void Server::Impl::send_final(Connection& connection, const Reply& reply)
{
    if (const auto* done = std::get_if<Done>(&reply)) send(connection, encode_reply(*done));
    if (const auto* error = std::get_if<Error>(&reply)) send(connection, encode_error(*error));
}

void Server::Impl::send(Connection& connection, const std::string& message)
{
    if (message.size() > kMaxReply + 1) { // no client takes it
        ++counters.handler_failures;
        connection.kill();
    } else if (!connection.send(message, settings.max_unsent)) {
        ++counters.too_slow;
        connection.kill();
    } else {
        bound_unsent();
    }
}

/// Bounds what waits for all callers together: the connection for which most waits is ended.
void Server::Impl::bound_unsent()
{
    for (;;) {
        std::size_t all = 0;
        Connection* most = nullptr;
        for (const auto& [id, one] : connections) {
            all += one->unsent();
            if (most == nullptr || one->unsent() > most->unsent()) most = one.get();
        }
        if (most == nullptr || all <= settings.max_unsent_of_all) return;
        ++counters.too_slow;
        most->cut();
    }
}

} // namespace dpslave::control
