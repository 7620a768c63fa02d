// SPDX-License-Identifier: Apache-2.0
/// Which file a path leads to, links followed, so that two names of one tty are the same. The file system was
/// asked beforehand, on the thread beside the main thread: here nothing waits for it.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace dpslave::app {

class RealPaths {
public:
    /// `canonical` asks the file system.
    void add(const std::string& path, const std::function<std::string(const std::string&)>& canonical)
    {
        if (!path.empty() && !real_.contains(path)) real_.emplace(path, canonical(path));
    }
    /// One that was not asked for leads to itself.
    const std::string& of(const std::string& path) const
    {
        const auto found = real_.find(path);
        return found != real_.end() ? found->second : path;
    }

private:
    std::map<std::string, std::string> real_;
};

} // namespace dpslave::app
