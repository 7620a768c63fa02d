// SPDX-License-Identifier: Apache-2.0
#include "fields.hpp"

namespace dpslave::dpctl {
namespace {

const Json* find(const Json& object, const char* key)
{
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

} // namespace

std::string text(const Json& object, const char* key, std::string_view without)
{
    const Json* found = find(object, key);
    return found != nullptr && found->is_string() ? found->get<std::string>() : std::string{without};
}

bool flag(const Json& object, const char* key)
{
    const Json* found = find(object, key);
    return found != nullptr && found->is_boolean() && found->get<bool>();
}

std::optional<std::int64_t> integer(const Json& object, const char* key)
{
    const Json* found = find(object, key);
    if (found == nullptr || !found->is_number_integer()) return std::nullopt;
    return found->get<std::int64_t>();
}

std::optional<double> real(const Json& object, const char* key)
{
    const Json* found = find(object, key);
    if (found == nullptr || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

std::string number(const Json& object, const char* key, std::string_view without)
{
    return number(integer(object, key), without);
}

std::string number(std::optional<std::int64_t> value, std::string_view without)
{
    return value ? std::to_string(*value) : std::string{without};
}

const Json& list(const Json& object, const char* key)
{
    static const Json nothing = Json::array();
    const Json* found = find(object, key);
    return found != nullptr && found->is_array() ? *found : nothing;
}

const Json& part(const Json& object, const char* key)
{
    static const Json nothing = Json::object();
    const Json* found = find(object, key);
    return found != nullptr && found->is_object() ? *found : nothing;
}

std::string joined(const Json& array, std::string_view between)
{
    std::string result;
    for (const Json& item : array) {
        if (!result.empty()) result += between;
        if (item.is_string()) result += item.get<std::string>();
        if (item.is_number_integer()) result += std::to_string(item.get<std::int64_t>());
    }
    return result;
}

std::string joined(const std::vector<std::string>& texts, std::string_view between)
{
    std::string all;
    for (const std::string& one : texts) {
        if (!all.empty()) all += between;
        all += one;
    }
    return all;
}

} // namespace dpslave::dpctl
