// SPDX-License-Identifier: Apache-2.0
/// Type files for the parameterisation software COM ET200 of Siemens, which reads no GSD.
/// Source: HA389815 appendix B; widths and number of flags as X-12 decides.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::gsd {

/// Width of the type name's field.
enum class TypeName : std::uint8_t {
    printed, ///< 21 characters, as appendix B prints it for V4.0
    brief,   ///< 17 characters, the width of the type files of STEP 7 (V5)
};

struct TypeFile {
    std::string name; ///< "EU0533TE.200"
    std::string content;
};

/// English, German, French, Spanish and Italian. Appendix B lets the languages differ in the file's name
/// alone. The file says Sync, Freeze "N" and 16 octets of diagnosis, as printed; the device does what its GSD
/// says (X-12b).
std::vector<TypeFile> type_files(TypeName form);

} // namespace dpslave::gsd
