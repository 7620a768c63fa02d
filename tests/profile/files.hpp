// SPDX-License-Identifier: Apache-2.0
/// A folder of its own for one test, gone when the test ends; and the sentence of a fault in one line.
#pragma once

#include "dpslave/toml/fault.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::test {

class Folder {
public:
    Folder()
    {
        std::string name = (std::filesystem::path{testing::TempDir()} / "dpslave-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error{"no temporary folder"};
        path_ = name;
    }
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view content) const
    {
        std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream{file, std::ios::binary} << content;
        return file;
    }

private:
    std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& file)
{
    std::ostringstream out;
    out << std::ifstream{file, std::ios::binary}.rdbuf();
    return out.str();
}

/// "3:7: what": the fault without its file.
inline std::string short_form(const toml::Fault& fault)
{
    return std::to_string(fault.line) + ":" + std::to_string(fault.column) + ": " + fault.what;
}

inline std::vector<std::string> short_forms(const toml::Faults& faults)
{
    std::vector<std::string> out;
    for (const toml::Fault& fault : faults) out.push_back(short_form(fault));
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
