// SPDX-License-Identifier: Apache-2.0
/// Why a file cannot be read: what a reader of files (io) and a source of texts (toml) both give.
#pragma once

#include <string>

namespace dpslave {

struct Unreadable {
    std::string why; ///< a clause, without the file's name
};

} // namespace dpslave
