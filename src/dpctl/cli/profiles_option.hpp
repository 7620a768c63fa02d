// SPDX-License-Identifier: Apache-2.0
/// The folder of the device profiles, as --profiles says it.
#pragma once

#include <string>

namespace dpslave::dpctl {

/// Where the package has them.
std::string installed_profiles();

struct ProfilesOption {
    std::string profiles = installed_profiles(); ///< the tag tables lie in ../tags
};

} // namespace dpslave::dpctl
