// SPDX-License-Identifier: Apache-2.0
/// A folder of its own for one test, gone with its contents when the test ends.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace dpslave::test {

class Folder {
public:
    Folder()
    {
        std::string name = std::filesystem::temp_directory_path() / "dpslaved-XXXXXX";
        if (::mkdtemp(name.data()) == nullptr)
            throw std::runtime_error{"no temporary folder can be made: " + name};
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
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    /// Makes the folders above it as well.
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

} // namespace dpslave::test
