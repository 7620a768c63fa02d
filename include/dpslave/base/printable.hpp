// SPDX-License-Identifier: Apache-2.0
/// Text of files, drives and callers for a terminal or a log. It must not be able to move the
/// cursor of a terminal, to turn its letters round or to begin a new line of the log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave {

/// Octets of the UTF-8 character at the start of `rest`; 0 = none is there (overlong forms and surrogates
/// included). Source: RFC 3629.
std::size_t character_length(std::string_view rest) noexcept;

/// The number of a whole character in UTF-8, as character_length() found it.
std::uint32_t code_point(std::string_view character) noexcept;

/// A control character of C0 (the tab and the ends of lines too) or C1, DEL, a separator of lines, or one
/// that changes the direction of writing. `character`: one in UTF-8, as character_length() found it.
bool is_control(std::string_view character) noexcept;

/// `text` in UTF-8. Text that is none is ISO 8859-1.
std::string utf8(std::string_view text);

/// One line of UTF-8 that any terminal shows as it is: each control character as \x1B or \u202E. Octets that
/// are no UTF-8 are characters of ISO 8859-1.
std::string printable(std::string_view text);

/// The JSON text `json` with those control characters that JSON would let through as \u009B: the same value.
std::string printable_json(std::string_view json);

} // namespace dpslave
