// SPDX-License-Identifier: Apache-2.0
/// A capture from the disk, for `dpctl trace --read`: packets to what a trace of the bus would show of them.
#pragma once

#include "dpctl/cli/terminal.hpp"
#include "line_entry.hpp"
#include "trace_options.hpp"

#include "dpslave/base/result.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// The file of --read. Each packet of its bus has a direction; what was assumed for it is printed, and that
/// the file is cut off. The failure is an exit code; why is printed.
Result<pcapng::Capture, int> open_capture(const TraceOptions& options, Terminal& terminal);

// Pure parts.

/// What is wrong with it for these options: a clause that says what to do; empty: nothing.
std::string fault_of(const pcapng::Capture& capture, const TraceOptions& options);
/// The names of its drive lines.
std::vector<std::string> lines_of(const pcapng::Capture& capture);
/// What each slave is, by its last Set_Prm in the capture: its Ident_Number, by address.
std::map<std::uint8_t, std::uint16_t> idents_in(const pcapng::Capture& capture);
/// Each of its packets, in the order of the file. The times are those of the first characters: the rate is
/// not known. A telegram that the capture begins in the middle of is cut.
void print_capture(const pcapng::Capture& capture, const EntryPrinter& print);
/// How many packets print_capture() leaves out: of other link types, or of a drive line and without a
/// direction.
std::size_t left_out_of(const pcapng::Capture& capture);

} // namespace dpslave::dpctl
