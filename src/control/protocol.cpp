// SPDX-License-Identifier: Apache-2.0
#include "dpslave/control/protocol.hpp"

namespace dpslave::control {
namespace {

/// Deeper than kMaxDepth? Counted before the parser runs. Only brackets outside of strings nest.
bool too_deep(std::string_view message)
{
    int depth = 0;
    bool in_string = false, escaped = false;
    for (const char c : message) {
        if (escaped) {
            escaped = false;
        } else if (in_string) {
            if (c == '\\') escaped = true;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxDepth) return true;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return false;
}

Result<Json, Flaw> parse_object(std::string_view message, std::size_t limit)
{
    if (message.size() > limit) return Failure{Flaw::too_long};
    if (too_deep(message)) return Failure{Flaw::too_deep};
    Json json = Json::parse(message.begin(), message.end(), nullptr, false);
    if (json.is_discarded()) return Failure{Flaw::not_json};
    if (!json.is_object()) return Failure{Flaw::not_object};
    return json;
}

/// Takes the flag `name` out of `object`; false when it is there and no boolean. null counts as absent.
bool take_flag(const Json& object, const char* name, bool& flag)
{
    const auto found = object.find(name);
    if (found == object.end() || found->is_null()) return true;
    if (!found->is_boolean()) return false;
    flag = found->get<bool>();
    return true;
}

bool take_parameters(Json& object, Json& parameters)
{
    parameters = Json::object();
    const auto found = object.find("parameters");
    if (found == object.end() || found->is_null()) return true;
    if (!found->is_object()) return false;
    parameters = std::move(*found);
    return true;
}

std::string qualified(std::string_view name)
{
    if (name.find('.') != std::string_view::npos) return std::string{name};
    return std::string{kInterface} + '.' + std::string{name};
}

std::string framed(const Json& message)
{
    std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
    text += '\0';
    return text;
}

} // namespace

std::string_view text(Flaw flaw) noexcept
{
    switch (flaw) {
        case Flaw::too_long: return "message too long";
        case Flaw::too_deep: return "nested too deep";
        case Flaw::not_json: return "no JSON";
        case Flaw::not_object: return "no JSON object";
        case Flaw::no_method: return "no method";
        case Flaw::bad_method: return "method is no qualified name";
        case Flaw::bad_members: return "a member has the wrong type";
        case Flaw::bad_flags: return "oneway together with more";
    }
    return "?";
}

Result<Call, Flaw> parse_call(std::string_view message)
{
    auto object = parse_object(message, kMaxCall);
    if (!object) return Failure{object.error()};

    const auto method = object->find("method");
    if (method == object->end()) return Failure{Flaw::no_method};
    if (!method->is_string()) return Failure{Flaw::bad_method};
    const auto& name = method->get_ref<const std::string&>();
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == name.size()) return Failure{Flaw::bad_method};

    Call call;
    call.interface = name.substr(0, dot);
    call.method = name.substr(dot + 1);
    if (!take_flag(*object, "more", call.more) || !take_flag(*object, "oneway", call.oneway) ||
        !take_flag(*object, "upgrade", call.upgrade) || !take_parameters(*object, call.parameters))
        return Failure{Flaw::bad_members};
    if (call.oneway && call.more) return Failure{Flaw::bad_flags};
    return call;
}

Result<ReplyMessage, Flaw> parse_reply(std::string_view message)
{
    auto object = parse_object(message, kMaxReply);
    if (!object) return Failure{object.error()};

    ReplyMessage reply;
    if (!take_flag(*object, "continues", reply.continues) || !take_parameters(*object, reply.parameters))
        return Failure{Flaw::bad_members};
    if (const auto error = object->find("error"); error != object->end() && !error->is_null()) {
        if (!error->is_string()) return Failure{Flaw::bad_members};
        reply.error = error->get<std::string>();
        if (reply.error.empty()) return Failure{Flaw::bad_members};
    }
    return reply;
}

std::string encode_call(std::string_view method, const Json& parameters, bool more)
{
    Json message = Json::object({{"method", qualified(method)}, {"parameters", parameters}});
    if (more) message["more"] = true;
    return framed(message);
}

std::string encode_reply(const Done& reply, bool continues)
{
    Json message = Json::object({{"parameters", reply.parameters}});
    if (continues) message["continues"] = true;
    return framed(message);
}

std::string encode_error(const Error& error)
{
    return framed(Json::object({{"error", qualified(error.name)}, {"parameters", error.parameters}}));
}

} // namespace dpslave::control
