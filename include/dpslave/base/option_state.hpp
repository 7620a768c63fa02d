// SPDX-License-Identifier: Apache-2.0
/// FAULT and NETWORK STATE of a technology box. The numbers are those of the manual.
/// Source: HA463561U002, "MMI Parameter Descriptions" (rows B-048, B-051).
#pragma once

#include <cstdint>
#include <string_view>

namespace dpslave {

/// FAULT: what keeps the option from working.
enum class OptionFault : std::uint8_t {
    none = 0,
    parameter = 1,     ///< a parameter of the function block is out of range
    type_mismatch = 2, ///< TYPE is not PROFIBUS DP
    self_test = 3,     ///< hardware fault, internal
    hardware = 4,      ///< hardware fault, external
    missing = 5,       ///< no option fitted
};
std::string_view text(OptionFault fault) noexcept; ///< "NONE", "PARAMETER", "TYPE MISMATCH" ...

/// NETWORK STATE: how far the bus has come.
enum class NetworkState : std::uint8_t {
    data_exchange = 0,
    data_ex_error = 1, ///< data exchange goes on, but a parameter cannot be read or written
    wait_config = 2,
    wait_param = 3,
    baud_search = 4,
    disabled = 5, ///< OptionFault says why
};
std::string_view text(NetworkState state) noexcept; ///< "DATA EXCHANGE", "DATA EX ERROR" ...

} // namespace dpslave
