// SPDX-License-Identifier: Apache-2.0
#include "dpslave/control/protocol.hpp"

namespace dpslave::control {

void Framer::feed(std::string_view octets)
{
    buffer_.erase(0, taken_);
    taken_ = 0;
    buffer_.append(octets);
}

Result<std::optional<std::string_view>, Flaw> Framer::next()
{
    const std::string_view rest = std::string_view{buffer_}.substr(taken_);
    const std::size_t end = rest.find('\0', scanned_);
    if (end == std::string_view::npos) {
        scanned_ = rest.size();
        if (rest.size() > limit_) return Failure{Flaw::too_long};
        return std::optional<std::string_view>{};
    }
    scanned_ = 0;
    if (end > limit_) return Failure{Flaw::too_long};
    taken_ += end + 1;
    return std::optional{rest.substr(0, end)};
}

} // namespace dpslave::control
