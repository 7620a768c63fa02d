// SPDX-License-Identifier: Apache-2.0
#include "interface.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace dpslave::control {
namespace {

/// A Varlink int is signed, 64 bit.
bool is_integer(const Json& value)
{
    if (!value.is_number_integer()) return false;
    if (!value.is_number_unsigned()) return true;
    return value.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
}

std::optional<std::string> wrong_when(bool wrong)
{
    if (wrong) return std::string{};
    return std::nullopt;
}

std::string joined(const std::string& field, const std::string& inside)
{
    return inside.empty() || inside.front() == '[' ? field + inside : field + '.' + inside;
}

/// None = fits; else the path below `value` of what does not.
std::optional<std::string> wrong_part(const Interface& interface, const Type& type, const Json& value)
{
    if (type.nullable && value.is_null()) return std::nullopt;
    switch (type.kind) {
        case Type::Kind::boolean: return wrong_when(!value.is_boolean());
        case Type::Kind::integer: return wrong_when(!is_integer(value));
        case Type::Kind::number: return wrong_when(!value.is_number());
        case Type::Kind::string: return wrong_when(!value.is_string());
        case Type::Kind::object: return wrong_when(!value.is_object());
        case Type::Kind::enumeration:
            return wrong_when(!value.is_string() || std::find(type.words.begin(), type.words.end(),
                                                              value.get<std::string>()) == type.words.end());
        case Type::Kind::structure: return mismatch(interface, type.fields, value);
        case Type::Kind::array:
            if (!value.is_array()) return std::string{};
            for (std::size_t i = 0; i < value.size(); ++i)
                if (auto wrong = wrong_part(interface, *type.inner, value[i]))
                    return joined('[' + std::to_string(i) + ']', *wrong);
            return std::nullopt;
        case Type::Kind::map:
            if (!value.is_object()) return std::string{};
            for (const auto& item : value.items())
                if (auto wrong = wrong_part(interface, *type.inner, item.value()))
                    return joined('[' + item.key() + ']', *wrong);
            return std::nullopt;
        case Type::Kind::named: {
            const auto named = interface.types.find(type.name);
            if (named == interface.types.end()) return std::string{};
            return wrong_part(interface, named->second, value);
        }
    }
    return std::string{};
}

} // namespace

std::optional<std::string> mismatch(const Interface& interface, const Struct& fields, const Json& value)
{
    if (!value.is_object()) return std::string{};
    for (const Field& field : fields) {
        const auto found = value.find(field.name);
        if (found == value.end()) {
            if (field.type.nullable) continue;
            return field.name;
        }
        if (const auto wrong = wrong_part(interface, field.type, *found)) return joined(field.name, *wrong);
    }
    for (const auto& item : value.items()) {
        const auto same_name = [&](const Field& field) { return field.name == item.key(); };
        if (std::none_of(fields.begin(), fields.end(), same_name)) return item.key();
    }
    return std::nullopt;
}

std::optional<std::string> reply_mismatch(std::string_view method, const Json& parameters)
{
    static const auto interface = parse_interface(interface_text());
    if (!interface) return interface.error();
    const auto found = interface->methods.find(method);
    if (found == interface->methods.end()) return "no method " + std::string{method};
    return mismatch(*interface, found->second.out, parameters);
}

} // namespace dpslave::control
