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
