// SPDX-License-Identifier: Apache-2.0
/// Files and requests that nobody means well.
#pragma once

#include "page.hpp"

#include <random>
#include <string>
#include <vector>

namespace dpslave::test {

inline std::string noise(std::size_t length)
{
    std::mt19937 random{1};
    std::string octets(length, '\0');
    for (char& octet : octets) octet = static_cast<char>(random());
    return octets;
}

inline std::vector<std::string> hostile_files()
{
    return {"", noise(5000), std::string(3, '\0'), std::string{"\xFF\xFE#\0P\0", 6},
            "<script>alert(1)</script>"};
}

/// Every request with every value in place of every key.
inline std::vector<json> hostile_requests()
{
    const std::string file = to_base64(content_of(kSource / "gsd/605/605_1649.GSD"));
    std::vector<json> all;
    for (const json& value : {json(), json(true), json(-1), json(1e300), json("\xC3\xBC"), json::array(),
                              json::object(), json::array({json::array({json::array()})})})
        for (const char* wanted :
             {"tags", "preview", "make", "check", "show", "import", "mapping", "read_mapping", "diff"})
            for (const char* key :
                 {"mapping", "table", "table_name", "file", "other", "name", "profile", "strict"}) {
                all.push_back({{"do", wanted},
                               {"file", file},
                               {"other", file},
                               {"profile", "605"},
                               {"mapping", {{"profile", "605"}}}});
                all.back()[key] = value;
            }
    return all;
}

} // namespace dpslave::test
