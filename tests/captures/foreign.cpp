// SPDX-License-Identifier: Apache-2.0
#include "foreign.hpp"

#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace captures {

const std::vector<Foreign>& all_foreign()
{
    static const std::vector<Foreign> all = [] {
        struct Family {
            std::string name, profile;
            std::uint16_t ident;
        };
        const std::string refused = "-more-identifiers-than-tags", sync_freeze = "-sync-freeze";
        std::vector<Foreign> made;
        for (const Family& family :
             {Family{"590", "590", 0x0533}, Family{"6053", "605", 0x1649}, Family{"2400f", "2408f", 0x4242}})
            for (const std::string& scenario :
                 {std::string{"-demand-input-output"}, std::string{"-six-words"},
                  std::string{"-only-outputs"}, refused, sync_freeze}) {
                if (scenario == sync_freeze && family.name == "2400f") continue; // controllers have neither
                made.push_back({.name = family.name + scenario,
                                .family = family.name,
                                .profile = family.profile,
                                .ident = family.ident,
                                .before = scenario == sync_freeze ? family.name + refused : std::string{}});
            }
        return made;
    }();
    return all;
}

std::string folder_of_foreign()
{
    return std::string{DPSLAVE_SOURCE_DIR} + "/tests/captures/foreign/";
}

dpslave::pcapng::Capture read_foreign(const std::string& name)
{
    std::ifstream file{folder_of_foreign() + name + ".pcapng", std::ios::binary};
    const std::vector<std::uint8_t> octets{std::istreambuf_iterator<char>{file}, {}};
    auto capture = dpslave::pcapng::read(octets);
    if (!capture) throw std::runtime_error{name + ": " + capture.error()};
    return *std::move(capture);
}

std::string test_name_of(const Foreign& foreign)
{
    std::string name;
    bool is_first = true;
    for (const char c : foreign.name) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) == 0) {
            is_first = true;
            continue;
        }
        name += is_first ? static_cast<char>(std::toupper(letter)) : c;
        is_first = false;
    }
    return name;
}

} // namespace captures
