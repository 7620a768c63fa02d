// SPDX-License-Identifier: Apache-2.0
/// Records as octets, for the control socket and for files: 32 octets, little endian, then the octets of the
/// record. docs/internals/trace.md has the table.
#pragma once

#include "dpslave/trace/record.hpp"

#include <optional>
#include <vector>

namespace dpslave::trace {

void append(const Record& record, std::vector<std::uint8_t>& to);
/// Returns the first record of `octets`, and removes it from them. It returns nullopt if there is none, or it
/// is invalid; `octets` then stays.
std::optional<Record> take_record(Bytes& octets);

} // namespace dpslave::trace
