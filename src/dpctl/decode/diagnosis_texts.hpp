// SPDX-License-Identifier: Apache-2.0
/// What the GSD of a device says of the bits of its device-related diagnosis. Pure. Source: wire reference
/// 5.3, 9.2.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/gsd/document.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dpslave::dpctl {

struct DiagnosisTexts {
    /// Several bits as one number (Unit_Diag_Area).
    struct Area {
        std::uint32_t first = 0, last = 0;           ///< bits, both included
        std::map<std::uint32_t, std::string> values; ///< a text for a value
    };
    std::string model;                         ///< Model_Name
    std::map<std::uint32_t, std::string> bits; ///< Unit_Diag_Bit; 0 = bit 0 behind the header of the block
    std::vector<Area> areas;
};

/// Texts are printable UTF-8.
DiagnosisTexts diagnosis_texts(const gsd::Document& document);

/// What `texts` say of octet `octet` of a block; 1 = the first one behind its header. Empty: nothing.
std::string texts_of_octet(const DiagnosisTexts& texts, Bytes block, std::size_t octet);

} // namespace dpslave::dpctl
