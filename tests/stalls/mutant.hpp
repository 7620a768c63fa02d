// SPDX-License-Identifier: Apache-2.0
/// Which rule is taken out of the program (CMakeLists.txt says where).
#pragma once

namespace dpslave {

inline int the_mutant = 0; ///< 0: none
inline bool is_mutant(int number)
{
    return the_mutant == number;
}

} // namespace dpslave
