// SPDX-License-Identifier: Apache-2.0
/// The drive side of a slave on the simulated clock. It says what the answers of the capture need, as soon as
/// they need it: only what DP makes of it is judged.
#pragma once

#include "dpsim/replay/replay_script.hpp"

#include "dpslave/dp/slave.hpp"

namespace captures {

class DriveOfACapture {
public:
    /// Both outlive this object.
    DriveOfACapture(const dpslave::sim::ReplayScript& script, dpslave::dp::Slave& slave)
        : script_(script), slave_(slave)
    {}

    /// Before this step is sent.
    void serve(std::size_t step);

private:
    using Frame = dpslave::sim::Frame;

    void take_orders();
    void set_diagnosis(std::size_t step);
    void set_inputs(std::size_t step);
    void answer_order(const Frame& answer);
    /// The first answer from here on that `is_it`, before the master begins another layout.
    std::optional<Frame> next_answer(std::size_t step, bool (*is_it)(const Frame&)) const;
    /// Octets of the inputs in a reply of Data_Exchange; in front of them is Demand Data.
    std::size_t input_octets() const;

    const dpslave::sim::ReplayScript& script_;
    dpslave::dp::Slave& slave_;
    dpslave::Layout layout_{};
    dpslave::InputImage inputs_{};
    dpslave::DemandOrder order_{};
};

} // namespace captures
