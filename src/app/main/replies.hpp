// SPDX-License-Identifier: Apache-2.0
/// The control socket, for the classes that answer a call later. Main thread only.
#pragma once

#include "dpslave/control/server.hpp"

#include <cstdint>
#include <optional>

namespace dpslave::app {

struct Replies {
    std::optional<control::Server> server; ///< none until it is opened, and at the end
    std::uint32_t next_token = 1;  ///< of control::Later; also the number of the order to a drive line
    std::uint64_t next_stream = 1; ///< of control::Stream
};

} // namespace dpslave::app
