// SPDX-License-Identifier: Apache-2.0
/// The lamp is the REM beacon in the instrument's display (2408f/2404f handbook ch. 4, C-009). The handbook
/// does not say how fast it flashes: 1 Hz, half of it lit [DEC].
#include "languages.hpp"

namespace dpslave::led {

Shown controller(const Condition& condition)
{
    if (!condition.running) return {{{"rem", kOff}}, "not served: this station is not on the bus"};
    if (!condition.data_exchange)
        return {{{"rem", kOff}}, "ready to run (rdY): no data exchange with the master"};
    if (!condition.drive_answers)
        return {{{"rem", kFlash1Hz}},
                "running (run): data exchange with the master, but the controller does not answer"};
    return {{{"rem", kFlash1Hz}}, "running (run): data exchange with the master"};
}

} // namespace dpslave::led
