// SPDX-License-Identifier: Apache-2.0
/// The tables of rules, one a family, and what they look at. Steps are those of the manuals, with what the
/// gateway has in the place of the board's own switches and with the command that shows more.
#pragma once

#include "doctor.hpp"

#include <array>

namespace dpslave::dpctl {

std::span<const Rule> bus_rules();
std::span<const Rule> board_rules();
std::span<const Rule> box_rules();
std::span<const Rule> controller_rules();
std::span<const Rule> station_rules();

bool is_in(const Facts& f, std::string_view state);
bool exchanges(const Facts& f);
/// A counter of the bus.
std::int64_t counted(const Facts& f, std::string_view name);

// Each of these says what it sees in words, or nothing.
/// Nothing is heard on the bus.
std::string silence(const Facts& f);
/// Silence of the bus, or what the master does not do.
std::string no_exchange(const Facts& f);
/// The last refused telegram.
std::string refusal(const Facts& f);
/// The sentences of the diagnosis about tags.
std::string tag_trouble(const Facts& f);
std::string drive_silence(const Facts& f);
/// How often Data_Exch was left, where that is more than once in an hour.
std::string restlessness(const Facts& f);

} // namespace dpslave::dpctl
