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

void ServerImpl::dispatch(Connection& connection, Call& call)
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

Reply ServerImpl::answer(const Connection& connection, Call& call)
{
    if (call.upgrade) return service_error("MethodNotImplemented", "method", full_name(call));
    const bool service = call.interface == kServiceInterface;
    if (!service && call.interface != kInterface)
        return service_error("InterfaceNotFound", "interface", call.interface);

    const Interface& interface = service ? service_interface : own_interface;
    const auto method = interface.methods.find(call.method);
    if (method == interface.methods.end()) return service_error("MethodNotFound", "method", full_name(call));
    const Method* const own = service ? nullptr : &methods.find(call.method)->second;
    if (own != nullptr && own->right != Right::look && !connection.operates) {
        ++counters.not_permitted;
        return Error{"NotPermitted", Json::object({{"group", settings.operator_group_name}})};
    }
    if (own != nullptr && own->right == Right::write && settings.read_only) return Error{"ReadOnly"};
    if (auto wrong = mismatch(interface, method->second.in, call.parameters))
        return service_error("InvalidParameter", "parameter", std::move(*wrong));
    return own == nullptr ? answer_service(call) : answer_own(connection, *own, call);
}

Reply ServerImpl::answer_service(const Call& call) const
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

Reply ServerImpl::answer_own(const Connection& connection, const Method& method, Call& call)
{
    remove_nulls(call.parameters);
    Caller caller = connection.caller;
    caller.more = call.more;
    caller.operates = connection.operates;
    caller.reply_to = ReplyTo{weak_from_this(), ++last_call};
    return method.answer(call.parameters, caller);
}

void ServerImpl::deliver(Connection& connection, const Call& call, const Reply& reply)
{
    if (std::holds_alternative<Error>(reply)) ++counters.errors;
    if (call.oneway) return; // a later reply has no receiver
    if (const auto* done = std::get_if<Done>(&reply)) return send_final(connection, *done);
    if (const auto* error = std::get_if<Error>(&reply)) return send_final(connection, *error);
    const auto* stream = std::get_if<Stream>(&reply);
    if (stream != nullptr && !call.more) return send_final(connection, Done{stream->first});
    connection.waits = stream != nullptr ? Connection::Waits::stream : Connection::Waits::later;
    connection.call = last_call;
    waiting.emplace(last_call, &connection);
    if (stream != nullptr) send(connection, encode_reply({stream->first}, true));
}

void ServerImpl::send_final(Connection& connection, const LastReply& reply)
{
    if (const auto* done = std::get_if<Done>(&reply)) send(connection, encode_reply(*done));
    if (const auto* error = std::get_if<Error>(&reply)) send(connection, encode_error(*error));
}

void ServerImpl::send(Connection& connection, const std::string& message)
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
void ServerImpl::bound_unsent()
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
