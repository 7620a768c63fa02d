// SPDX-License-Identifier: Apache-2.0
/// A capture that is being written: pcapng, one interface, a statistics block at its end.
#pragma once

#include "trace_text.hpp"

#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::dpctl {

class TraceFile {
public:
    /// Makes the file anew. The error is a sentence with its path.
    static Result<TraceFile, std::string> create(const std::string& path, pcapng::LinkType link_type);

    /// One entry; `note` becomes a comment. What was lost is written with the packet behind it.
    void add(const trace::Entry& entry, const TraceWords& words, UnixOffset offset,
             std::string_view note = {});
    /// The end: what was received and lost. The error is a sentence with the path.
    std::optional<std::string> finish(std::int64_t unix_ns);

    std::uint64_t packets() const { return received_; }

private:
    TraceFile(std::string path, std::ofstream file) : path_(std::move(path)), file_(std::move(file)) {}
    void write(const pcapng::Octets& octets);

    std::string path_;
    std::ofstream file_;
    std::uint64_t received_ = 0, dropped_ = 0;
    std::uint64_t dropped_before_ = 0; ///< since the last packet
};

} // namespace dpslave::dpctl
