// SPDX-License-Identifier: Apache-2.0
/// The bench's end of a cable: a pty on whose other end a responder sits.
#pragma once

#include "wire.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/io/fd.hpp"

#include <array>
#include <optional>
#include <string>

namespace dpslave::bench {

class Port {
public:
    Port();
    const std::string& path() const { return path_; }

    /// What came as answer, in place until the next exchange; `time` from before the write of the request to
    /// after the read of the answer's last octet. Nothing within `slot`: none.
    struct Answer {
        std::span<const std::uint8_t> frame;
        std::chrono::nanoseconds time{};
    };
    std::optional<Answer> exchange(const Octets& request, std::chrono::nanoseconds slot);

    void send(const Octets& telegram); ///< no answer is waited for

    void drain(); ///< throws away what has come

private:
    io::Fd master_;
    io::Fd keeps_open_; // the other end, so that a responder that closes it is no hang-up
    std::string path_;
    std::array<std::uint8_t, 512> room_{};
};

} // namespace dpslave::bench
