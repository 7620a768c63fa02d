// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dpslave::app {

/// The version of the project, as CMake knows it: "0.1.0".
extern const char* const kVersion;
/// Where the project is described: the README that is installed, unless the build names another place.
extern const char* const kUrl;

} // namespace dpslave::app
