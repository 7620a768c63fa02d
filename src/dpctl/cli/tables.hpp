// SPDX-License-Identifier: Apache-2.0
/// Pieces that several pictures share.
#pragma once

#include "fields.hpp"
#include "table.hpp"

#include "dpslave/report/replies.hpp"

#include <string>
#include <string_view>

namespace dpslave::dpctl {

std::string bus_line(const report::Bus& bus);
/// "Data_Exch", "Data_Exch in Clear", "Power_On".
std::string state_text(const report::Station& station);
/// good: it is in exchange, and the values of the master are in force.
Tone state_tone(const report::Station& station);
/// "answers", "silent", "port missing".
std::string link_text(const report::Drive& drive);
/// "line p3 has stalled in write for 12 s". Precondition: it has.
std::string stall_text(const report::Drive& drive);
Tone link_tone(const report::Drive& drive);
/// "read only" of "read_only".
std::string state_text(const report::Word& word);
Tone state_tone(const report::Word& word);
/// Of a station that is in RIDE THROUGH: for how long its outputs stand.
std::string ride_text(const report::Ride& ride);
/// What a station emulates, from the reply of GetInfo.
void add_info(Block& block, const report::Info& info, std::string_view version);

} // namespace dpslave::dpctl
