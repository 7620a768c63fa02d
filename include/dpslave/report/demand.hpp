// SPDX-License-Identifier: Apache-2.0
/// Demand Data in words: the four registers of a request and of an answer. Source: HA389815 ch. 7;
/// 2408f/2404f handbook ch. 7.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

namespace dpslave::report {

/// Command and tag, extended tag, reserved, value or error code.
using DemandWords = std::array<std::uint16_t, 4>;
/// What a tag and a word of it are called.
struct DemandNames {
    std::function<std::string(std::uint16_t tag, std::uint16_t word)> value; ///< as the drive displays it
    /// "270", or with its name.
    std::function<std::string(std::uint16_t tag)> tag = [](std::uint16_t number) {
        return std::to_string(number);
    };
};

/// "read tag 55", "write 1 to tag 270", "no command". `extended`: the device has the commands 3 and 4.
std::string demand_request(const DemandWords& request, bool extended, const DemandNames& names);
/// The request with what became of it: "read tag 55: done, value 50.50", "...: rejected with error code 0".
std::string demand_words(const DemandWords& request, const DemandWords& reply, bool extended,
                         const DemandNames& names);
/// An answer whose request is not known: "tag 270: done, value 1".
std::string demand_reply(const DemandWords& reply, const DemandNames& names);

} // namespace dpslave::report
