// SPDX-License-Identifier: Apache-2.0
/// Makes requests of Modbus from the function code on, without address and checksum, and judges their
/// answers. It is pure. Source: MODBUS Application Protocol V1.1b3, ch. 6.3, 6.6, 6.12 and 7.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/process_image.hpp"
#include "dpslave/drive/tag.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace dpslave::modbus {

/// Registers that one request may read or write. The protocol allows 125 to read, but 123 fit both ways.
inline constexpr std::uint16_t kMostRegisters = 123;

using Request = ByteBuffer<6 + 2 * kMostRegisters>;

inline constexpr std::size_t kLongestFrame = 256; ///< unit and checksum included
inline constexpr std::uint8_t kLowestUnit = 1;
inline constexpr std::uint8_t kHighestUnit = 247;

inline constexpr std::uint8_t kReadRegisters = 3;
inline constexpr std::uint8_t kReadInputRegisters = 4;
inline constexpr std::uint8_t kWriteRegister = 6;
inline constexpr std::uint8_t kLoopback = 8;
inline constexpr std::uint8_t kWriteRegisters = 16;
inline constexpr std::uint8_t kIsException = 0x80;

/// Function 3, or 4.
Request read_registers(std::uint16_t first, std::uint16_t count, std::uint8_t function = kReadRegisters);
/// Function 8, sub code 0: is answered by itself.
Request loopback(std::uint16_t token);
Request write_register(std::uint16_t reg, std::uint16_t word);                      ///< function 6
Request write_registers(std::uint16_t first, std::span<const std::uint16_t> words); ///< function 16

/// Octets of the longest answer that this request can have, from the function code on.
std::size_t longest_answer(Bytes request);

/// Returns whether this can be the answer to the request, an exception included. An answer to function 6 has
/// to echo the register; echoed_word() judges the value.
bool answers(Bytes request, Bytes answer);

/// Returns the exception code of an answer that fits; nullopt if it is no exception. Code 0, which the
/// protocol does not know, is an exception too: the function code says so (MODBUS Application Protocol
/// V1.1b3, ch. 7).
std::optional<std::uint8_t> exception_of(Bytes answer);

/// Exceptions 10 and 11: it is the gateway that speaks, not the unit.
bool is_of_gateway(std::uint8_t code);

/// "exception 2 (illegal data address)"
std::string exception_text(std::uint8_t code);

/// Returns the meaning of an exception for the access of one tag. `row` is its row; nullptr: several tags.
AccessError error_of_exception(std::uint8_t code, bool is_write, const drive::Tag* row);

/// Word `index` in the answer to function 3.
std::uint16_t word_read(Bytes answer, std::size_t index);
/// The value in the answer to function 6.
std::uint16_t echoed_word(Bytes answer);

} // namespace dpslave::modbus
