// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dpslave::app {

/// The version of the project, as CMake knows it: "0.1.0".
extern const char* const kVersion;

} // namespace dpslave::app
