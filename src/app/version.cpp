// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/version.hpp"

namespace dpslave::app {

const char* const kVersion = DPSLAVE_VERSION; // given by src/app/CMakeLists.txt
const char* const kUrl = DPSLAVE_URL;

} // namespace dpslave::app
