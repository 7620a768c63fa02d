// SPDX-License-Identifier: Apache-2.0
/// Which moments of a drive are kept for dpctl plot: each refresh, and the moment at which the drive is lost
/// or its layout ends. The drive thread's own; it never waits.
#pragma once

#include "dpslave/drive/poller.hpp"
#include "dpslave/trace/samples.hpp"

#include <cstdint>

namespace dpslave::app {

class Sampler {
public:
    /// The layout that the poller has from now on.
    void set_layout(const Layout& layout);
    /// After each transaction, and while there is none. `ended`: every layout up to this generation has ended
    /// (StationLink::ended).
    void sample(std::uint32_t station, const drive::DriveSnapshot& now, Generation ended, trace::Ring& ring,
                Instant at);

private:
    Layout layout_{};
    bool reads_ = false;   ///< there are inputs: a refresh is a round over them, else a write
    Generation known_ = 0; ///< whose tags the ring has
    std::uint64_t rounds_ = 0;
    bool answered_ = false;
    bool has_ended_ = false;
    unsigned until_layout_ = 0; ///< so many samples until the tags are said again
};

} // namespace dpslave::app
