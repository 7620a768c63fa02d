// SPDX-License-Identifier: Apache-2.0
#include "dpslave/profile/fault.hpp"

namespace dpslave::profile {

std::string to_string(const Fault& fault)
{
    std::string out = fault.file;
    if (fault.line > 0) out += ':' + std::to_string(fault.line);
    if (fault.line > 0 && fault.column > 0) out += ':' + std::to_string(fault.column);
    return out + ": " + fault.what;
}

} // namespace dpslave::profile
