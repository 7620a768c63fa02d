// SPDX-License-Identifier: Apache-2.0
#include "dpslave/input/text_source.hpp"

namespace dpslave::input {

Result<std::string, Fault> read_text(const TextSource& source, const std::string& name)
{
    auto content = source(name);
    if (!content) return Failure{Fault{name, 0, 0, "the file cannot be read: " + content.error().why + "."}};
    if (content->starts_with(kByteOrderMark)) content->erase(0, kByteOrderMark.size());
    return *std::move(content);
}

std::string beside(const std::string& path, const std::string& name)
{
    const std::string whole = path.substr(0, path.find_last_not_of('/') + 1);
    const auto end = whole.rfind('/');
    const std::string last = end == std::string::npos ? whole : whole.substr(end + 1);
    if (last == "." || last == "..") return whole + "/../" + name;
    return end == std::string::npos ? name : whole.substr(0, end + 1) + name;
}

} // namespace dpslave::input
