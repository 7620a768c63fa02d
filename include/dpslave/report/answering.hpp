// SPDX-License-Identifier: Apache-2.0
/// A drive that a search has found, as the control interface and `dpctl identify` report it.
#pragma once

#include "dpslave/drive/line_search.hpp"
#include "dpslave/report/types.hpp"

namespace dpslave::report {

Answering answering_of(const drive::FoundUnit& found);

} // namespace dpslave::report
