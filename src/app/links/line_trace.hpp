// SPDX-License-Identifier: Apache-2.0
/// The frames of a drive line on their way to its ring of the trace. The drive thread writes, whoever looks
/// reads. Nothing waits, and nothing is allocated after the start.
#pragma once

#include "dpslave/drive/frame_notes.hpp"
#include "dpslave/trace/ring.hpp"

#include <cstddef>

namespace dpslave::app {

class LineTrace final : public drive::FrameListener {
public:
    /// `octets`: the size of the ring; 0: nothing is recorded.
    explicit LineTrace(std::size_t octets) : ring_(octets) {}

    void on_frame(const drive::TracedFrame& frame) override;
    const trace::Ring& ring() const { return ring_; }

private:
    trace::Ring ring_;
};

} // namespace dpslave::app
