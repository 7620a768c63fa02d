// SPDX-License-Identifier: Apache-2.0
/// Octets as text for JSON: base64 with padding (RFC 4648, section 4).
#pragma once

#include "dpslave/base/bytes.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave {

std::string to_base64(Bytes octets);
/// Returns nullopt if the text is not Base64.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

} // namespace dpslave
