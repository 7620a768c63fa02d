// SPDX-License-Identifier: Apache-2.0
/// The GSD of a family: the file that is shipped, or where the ident is open the one that `dpctl gsd make`
/// writes.
#pragma once

#include "family.hpp"
#include "gsd/reader.hpp"

namespace conformance {

dpslave::test::SecondHand gsd_of(const Family& family);

} // namespace conformance
