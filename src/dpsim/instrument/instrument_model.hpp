// SPDX-License-Identifier: Apache-2.0
/// Does what a 2408f or 2404f does by itself: where its values begin, and what follows from a value (handbook
/// chapters 7 and 8). It is pure and knows no request.
#pragma once

#include "dpsim/common/device.hpp"

namespace dpslave::sim {

class InstrumentModel : public Device {
public:
    /// `unit`: 1 to 254. `ident`: of tag 122. `programs`: 0, 1 or 4 in the program store; program 0, the copy
    /// of the running one, comes with them. Some of the registers without a start value get a sensible one.
    InstrumentModel(std::uint8_t unit, std::uint16_t ident, std::vector<SimParameter> registers,
                    unsigned programs);

    void settle(Instant now) override;
    void changed(std::uint16_t tag, Instant now) override;

    /// Sets how long the next autotune takes, and whether it fails.
    void prepare_tune(std::chrono::nanoseconds takes, bool fails);

protected:
    std::int32_t counts_at(std::uint16_t tag); ///< 0 if there is no such tag

private:
    void start_values(std::uint16_t ident, unsigned programs);
    void put(std::uint16_t tag, std::int32_t counts); ///< nothing happens if there is no such tag
    void put_bit(std::uint16_t tag, unsigned bit, bool on);
    void follow(std::uint16_t from, std::uint16_t to); ///< `to` takes the value of `from`

    void autotune(Instant now);
    void end_tune(bool completed, bool failed);
    void run_program();
    void set_decimals(unsigned decimals);
    std::uint16_t selected_setpoint();

    std::chrono::nanoseconds tune_takes_ = std::chrono::seconds{3};
    bool tune_fails_ = false;
    std::optional<Instant> tune_ends_;
    std::int32_t program_status_ = 0; ///< tag 23 before it changed
};

} // namespace dpslave::sim
