// SPDX-License-Identifier: Apache-2.0
/// Numbers in words, the same everywhere in dpctl.
#pragma once

#include "fields.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace dpslave::dpctl {

std::string rate(std::int64_t baud); ///< "187.5 kbit/s", "1.5 Mbit/s"
std::string
age(std::optional<double> milliseconds); ///< "12 ms", "3.4 s", "5 min", "2 h 5 min"; "-" without one
std::string word(std::optional<std::int64_t> raw); ///< "1250 (0x04E2)"
/// "04:15:12.345", local time, with so many digits of the second's fraction (6 at most).
std::string time_of_day(std::chrono::system_clock::time_point when, std::size_t digits = 3);
std::string date_and_time(std::chrono::system_clock::time_point when); ///< "2026-11-25 04:15:12.345"
std::string yes_no(bool yes);
std::string plural(std::int64_t count, const char* one);                   ///< "1 read", "2 reads"
std::string plural(std::int64_t count, const char* one, const char* many); ///< "2 replies"
std::string json_text(const Json& value); ///< indented, printable; never fails
Json printable_texts(Json value);         ///< each text and each name in it printable()

} // namespace dpslave::dpctl
