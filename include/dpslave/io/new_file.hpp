// SPDX-License-Identifier: Apache-2.0
/// A file that is there completely or not at all: written beside its place, synchronised with the disk, then
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
    /// The file at `path` stays until finish(). Until then the octets are in a file whose name is `path` and
    /// kUnfinished; a file that a former run has left there is replaced.
    explicit NewFile(std::filesystem::path path);
    ~NewFile(); ///< without finish(): nothing has been written
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    static constexpr const char* kUnfinished = ".new";

    /// It does nothing after a failure.
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
