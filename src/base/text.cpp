// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/bytes.hpp"
#include "dpslave/base/option_state.hpp"
#include "dpslave/base/units.hpp"

namespace dpslave {

std::string_view text(Baud baud) noexcept
{
    switch (baud) {
        case Baud::k9_6: return "9.6";
        case Baud::k19_2: return "19.2";
        case Baud::k45_45: return "45.45";
        case Baud::k93_75: return "93.75";
        case Baud::k187_5: return "187.5";
        case Baud::k500: return "500";
        case Baud::k1500: return "1.5M";
    }
    return "?";
}

std::string_view text(OptionFault fault) noexcept
{
    switch (fault) {
        case OptionFault::none: return "NONE";
        case OptionFault::parameter: return "PARAMETER";
        case OptionFault::type_mismatch: return "TYPE MISMATCH";
        case OptionFault::self_test: return "SELF TEST";
        case OptionFault::hardware: return "HARDWARE";
        case OptionFault::missing: return "MISSING";
    }
    return "?";
}

std::string_view text(NetworkState state) noexcept
{
    switch (state) {
        case NetworkState::data_exchange: return "DATA EXCHANGE";
        case NetworkState::data_ex_error: return "DATA EX ERROR";
        case NetworkState::wait_config: return "WAIT CONFIG";
        case NetworkState::wait_param: return "WAIT PARAM";
        case NetworkState::baud_search: return "BAUD SEARCH";
        case NetworkState::disabled: return "DISABLED";
    }
    return "?";
}

std::string hex(Bytes bytes)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string out;
    out.reserve(bytes.size() * 3);
    for (const std::uint8_t octet : bytes) {
        if (!out.empty()) out += ' ';
        out += digits[octet >> 4];
        out += digits[octet & 15];
    }
    return out;
}

} // namespace dpslave
