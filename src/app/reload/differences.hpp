// SPDX-License-Identifier: Apache-2.0
/// Names of what differs: "port, baud".
#pragma once

#include <string>
#include <string_view>

namespace dpslave::app {

class Differences {
public:
    void add(std::string_view name) { names_.append(names_.empty() ? "" : ", ").append(name); }
    template <class T>
    void compare(const T& a, const T& b, std::string_view name)
    {
        if (!(a == b)) add(name);
    }
    bool empty() const { return names_.empty(); }
    const std::string& names() const { return names_; }

private:
    std::string names_;
};

} // namespace dpslave::app
