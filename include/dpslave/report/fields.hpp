// SPDX-License-Identifier: Apache-2.0
/// From a struct to JSON and back, by the one list of its fields. Reading never throws, so that daemon and
/// dpctl of different releases understand each other: a text that is missing, null or of another type is
/// "?", another field keeps its default, and an unknown key is passed over.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Lists in a struct its fields in the order of the interface. They are at the same time the keys.
#define DPSLAVE_FIELDS(...)                                                                                  \
    static constexpr std::string_view kFields = #__VA_ARGS__;                                                \
    auto with_fields(auto&& use)                                                                             \
    {                                                                                                        \
        return use(__VA_ARGS__);                                                                             \
    }                                                                                                        \
    auto with_fields(auto&& use) const                                                                       \
    {                                                                                                        \
        return use(__VA_ARGS__);                                                                             \
    }

namespace dpslave::report {

using Json = nlohmann::json;

template <class T>
concept HasFields = requires
{
    T::kFields;
};

template <HasFields T>
bool operator==(const T& one, const T& other)
{
    return one.with_fields([&](const auto&... mine) {
        return other.with_fields([&](const auto&... its) { return ((mine == its) && ...); });
    });
}

/// The first of "name, sink, lit", which `names` then is without.
std::string take_name(std::string_view& names);

void take(const Json& json, bool& value);
void take(const Json& json, std::int64_t& value);
void take(const Json& json, double& value);
void take(const Json& json, std::string& value);
template <HasFields T>
void take(const Json& json, T& value);

template <class T>
void take(const Json& json, std::vector<T>& values)
{
    values.clear();
    if (!json.is_array()) return;
    for (const Json& one : json) take(one, values.emplace_back());
}

template <class T>
void take(const Json& json, std::optional<T>& value)
{
    value.reset();
    if (!json.is_null()) take(json, value.emplace());
}

template <HasFields T>
void take(const Json& json, T& value)
{
    static const Json kNothing;
    std::string_view names = T::kFields;
    const auto take_field = [&](auto& field) {
        const auto found = json.find(take_name(names));
        take(found != json.end() ? *found : kNothing, field);
    };
    value.with_fields([&](auto&... each) { (take_field(each), ...); });
}

template <class T>
Json json_of(const T& value)
{
    return value;
}
template <HasFields T>
Json json_of(const T& value);

template <class T>
Json json_of(const std::optional<T>& value)
{
    return value ? json_of(*value) : Json(nullptr);
}

template <class T>
Json json_of(const std::vector<T>& values)
{
    Json json = Json::array();
    for (const T& one : values) json.push_back(json_of(one));
    return json;
}

template <HasFields T>
Json json_of(const T& value)
{
    Json json = Json::object();
    std::string_view names = T::kFields;
    value.with_fields([&](const auto&... each) { ((json[take_name(names)] = json_of(each)), ...); });
    return json;
}

template <HasFields T>
T read(const Json& json)
{
    T value;
    take(json, value);
    return value;
}

} // namespace dpslave::report
