// SPDX-License-Identifier: Apache-2.0
/// A file that is there as a whole or not at all: written beside its place, synchronised with the disk, then
/// renamed. Every call may block for as long as the disk does.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/io/fd.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace dpslave::io {

class NewFile {
public:
    /// What stands at `path` stays until finish(). Until then the octets are in `path` with kUnfinished
    /// behind its name; what was left there of a run before is replaced.
    explicit NewFile(std::filesystem::path path);
    ~NewFile(); ///< without finish(): nothing has been written
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    static constexpr const char* kUnfinished = ".new";

    /// After a failure it does nothing.
    void write(Bytes octets);
    /// Puts it in its place. The failure of any step until now, a sentence with the path.
    std::optional<std::string> finish();

private:
    void note_failure();

    std::filesystem::path path_, unfinished_;
    Fd fd_;
    std::optional<std::string> failure_;
    bool is_in_place_ = false;
};

} // namespace dpslave::io
