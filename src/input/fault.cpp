// SPDX-License-Identifier: Apache-2.0
#include "dpslave/input/fault.hpp"

#include "dpslave/base/printable.hpp"

#include <string_view>

namespace dpslave::input {
namespace {

constexpr std::size_t kLongest = 1000; ///< octets of a fault's text; a value in it may be a complete file

/// Cuts between characters only.
std::string shortened(std::string_view text)
{
    if (text.size() <= kLongest) return std::string{text};
    std::size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return std::string{text.substr(0, end)} + " ...";
}

} // namespace

void cap(Faults& faults)
{
    if (faults.size() <= kMaxFaults) return;
    const std::string file = faults[kMaxFaults].file;
    faults.resize(kMaxFaults);
    faults.push_back({file, 0, 0,
                      "there are more faults than the " + std::to_string(kMaxFaults) +
                          " shown here: correct these first."});
}

std::string to_string(const Fault& fault)
{
    std::string out = fault.file;
    if (fault.line > 0) out += ':' + std::to_string(fault.line);
    if (fault.line > 0 && fault.column > 0) out += ':' + std::to_string(fault.column);
    return printable(out + ": " + shortened(fault.what));
}

} // namespace dpslave::input
