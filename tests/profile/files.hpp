// SPDX-License-Identifier: Apache-2.0
/// Files of a test, and the sentence of a fault in one line.
#pragma once

#include "support/folder.hpp"

#include "dpslave/input/fault.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::test {

inline std::string content_of(const std::filesystem::path& file)
{
    std::ostringstream out;
    out << std::ifstream{file, std::ios::binary}.rdbuf();
    return out.str();
}

/// "3:7: what": the fault without its file.
inline std::string short_form(const input::Fault& fault)
{
    return std::to_string(fault.line) + ":" + std::to_string(fault.column) + ": " + fault.what;
}

inline std::vector<std::string> short_forms(const input::Faults& faults)
{
    std::vector<std::string> out;
    for (const input::Fault& fault : faults) out.push_back(short_form(fault));
    return out;
}

/// A name for a case of a list: letters, digits and single underscores, so that ctest can show it.
inline std::string case_name(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (plain)
            out += c;
        else if (!out.empty() && out.back() != '_')
            out += '_';
    }
    return out;
}

/// `text` with the first `from` replaced; a test that names text which is not there is itself wrong.
inline std::string with(std::string text, std::string_view from, std::string_view to)
{
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return text;
}

} // namespace dpslave::test
