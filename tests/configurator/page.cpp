// SPDX-License-Identifier: Apache-2.0
#include "page.hpp"

#include "support/paths.hpp"

#include "dpslave/io/file.hpp"

#include <gtest/gtest.h>

#include <bitset>

namespace dpslave::test {
namespace {

const std::string kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

} // namespace

Result<std::string, Unreadable> shipped(const std::string& name)
{
    const std::string root = source_path();
    if (name == "index.txt") {
        std::string index = "mappings/gain-scheduling.toml\n";
        for (const std::string& profile : io::names_in(root + "/config/profiles", ".toml"))
            index += "profiles/" + profile + ".toml\n";
        return index;
    }
    return io::read_regular_file(root + (name.starts_with("mappings/") ? "/gsd/" : "/config/") + name);
}

json ask(const json& request)
{
    return ask_text(request.dump());
}

json ask_text(const std::string& request)
{
    return json::parse(configurator::call(request, shipped));
}

std::string to_base64(const std::string& octets)
{
    std::string bits;
    for (const char c : octets) bits += std::bitset<8>(static_cast<unsigned char>(c)).to_string();
    const std::size_t padding = (6 - bits.size() % 6) % 6;
    bits.append(padding, '0');
    std::string out;
    for (std::size_t at = 0; at < bits.size(); at += 6)
        out += kAlphabet[std::bitset<6>(bits, at, 6).to_ulong()];
    return out + std::string(padding / 2, '=');
}

std::string from_base64(const std::string& text)
{
    std::string bits;
    for (const char c : text)
        if (c != '=') bits += std::bitset<6>(kAlphabet.find(c)).to_string();
    std::string out;
    for (std::size_t at = 0; at + 8 <= bits.size(); at += 8)
        out += static_cast<char>(std::bitset<8>(bits, at, 8).to_ulong());
    return out;
}

std::string texts(const json& reply, const char* key)
{
    std::string all;
    for (const json& one : reply.at(key)) all += one.get<std::string>() + '\n';
    return all;
}

std::string made_file(const json& mapping)
{
    const json reply = ask({{"do", "make"}, {"mapping", mapping}});
    EXPECT_EQ(reply["exit"], 0) << mapping << texts(reply, "refusals");
    return from_base64(reply.value("octets", ""));
}

} // namespace dpslave::test
