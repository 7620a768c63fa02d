// SPDX-License-Identifier: Apache-2.0
/// A frame of a drive line in words. It is taken as it is: whether its checksum is right, the daemon says.
/// Pure. Source: docs/reference/drive-protocols.md, sections 1 and 5.
#pragma once

#include "dpslave/base/bytes.hpp"

#include <string>
#include <string_view>

namespace dpslave::dpctl {

struct DriveWords {
    std::string words;        ///< "read PV"; empty: it has the form of no frame
    std::string_view check{}; ///< the name of its checksum: "BCC", "CRC"; empty: it has none
};

DriveWords ei_ascii_words(Bytes frame);
/// With unit and CRC. A question and its answer may be the same octets.
DriveWords modbus_words(Bytes frame, bool is_question);

} // namespace dpslave::dpctl
