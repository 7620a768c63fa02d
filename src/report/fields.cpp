// SPDX-License-Identifier: Apache-2.0
#include "dpslave/report/fields.hpp"

namespace dpslave::report {

std::string take_name(std::string_view& names)
{
    std::string name{names.substr(0, names.find(','))};
    names.remove_prefix(name.size() == names.size() ? name.size() : name.size() + 2);
    return name;
}

void take(const Json& json, bool& value)
{
    if (json.is_boolean()) value = json.get<bool>();
}

void take(const Json& json, std::int64_t& value)
{
    if (json.is_number_integer()) value = json.get<std::int64_t>();
}

void take(const Json& json, double& value)
{
    if (json.is_number()) value = json.get<double>();
}

void take(const Json& json, std::string& value)
{
    value = json.is_string() ? json.get<std::string>() : "?";
}

} // namespace dpslave::report
