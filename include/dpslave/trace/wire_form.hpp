// SPDX-License-Identifier: Apache-2.0
/// Records as octets, for the control socket and for files: 32 octets, little endian, then the octets of the
/// record. docs/internals/trace.md has the table.
#pragma once

#include "dpslave/trace/record.hpp"

#include <optional>
#include <vector>

namespace dpslave::trace {

void append(const Record& record, std::vector<std::uint8_t>& to);
/// The first record of `octets`, which it takes off. Nothing: there is none, or it is none; `octets` stays.
std::optional<Record> take_record(Bytes& octets);

} // namespace dpslave::trace
