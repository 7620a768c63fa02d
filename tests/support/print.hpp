// SPDX-License-Identifier: Apache-2.0
/// How the house's values look in the messages of GoogleTest.
#pragma once

#include "dpslave/base/units.hpp"

#include <ostream>

namespace dpslave {

inline void PrintTo(Baud baud, std::ostream* out)
{
    *out << text(baud);
}
inline void PrintTo(Tbit bits, std::ostream* out)
{
    *out << bits.count << " T_bit";
}
inline void PrintTo(Instant at, std::ostream* out)
{
    if (at == kNever)
        *out << "never";
    else
        *out << at.time_since_epoch().count() << " ns";
}

} // namespace dpslave
