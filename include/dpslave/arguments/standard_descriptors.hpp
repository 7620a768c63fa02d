// SPDX-License-Identifier: Apache-2.0
/// A program that was started without standard input, output or error, as some supervisors do: the next file
/// that it opened, which may be a port, would get their numbers, and the log would leave through it.
#pragma once

namespace dpslave::arguments {

/// Opens /dev/null as each of the descriptors 0, 1 and 2 that is closed, for reading only: what is written to
/// a closed output fails, and does not seem to have arrived. Call it before anything else is opened. If it
/// cannot, the program ends.
void fill_standard_descriptors();

} // namespace dpslave::arguments
