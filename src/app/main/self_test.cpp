// SPDX-License-Identifier: Apache-2.0
#include "self_test.hpp"

#include "dpslave/dp/sap.hpp"
#include "dpslave/fdl/telegram.hpp"

#include <algorithm>

namespace dpslave::app {
namespace {

constexpr std::uint8_t kStation = 5, kMaster = 2, kSrdHighFirst = 0x6D;

std::optional<fdl::Telegram> understood(Bytes octets)
{
    const auto length = fdl::frame_length(octets);
    if (!length || *length == 0 || *length != octets.size()) return std::nullopt;
    const auto telegram = fdl::decode(octets);
    return telegram ? std::optional{*telegram} : std::nullopt;
}

bool is_understood_and_sent_as_it_is(Bytes known)
{
    const auto telegram = understood(known);
    const fdl::Frame sent =
        fdl::encode_sd2(kStation, kMaster, kSrdHighFirst, dp::sap::kSlaveDiag, dp::sap::kMaster, Bytes{});
    return telegram && telegram->da == kStation && telegram->sa == kMaster && telegram->fc == kSrdHighFirst &&
           telegram->dsap == dp::sap::kSlaveDiag && telegram->ssap == dp::sap::kMaster &&
           telegram->data.empty() && std::ranges::equal(sent.bytes(), known);
}

bool is_refused_with_any_bit_wrong(Bytes known)
{
    std::vector<std::uint8_t> wrong{known.begin(), known.end()};
    for (std::size_t bit = 0; bit < 8 * wrong.size(); ++bit) {
        const auto mask = static_cast<std::uint8_t>(1U << bit % 8);
        wrong[bit / 8] ^= mask;
        if (understood(wrong)) return false;
        wrong[bit / 8] ^= mask;
    }
    return true;
}

} // namespace

std::vector<std::string> self_test(Bytes known, Instant earlier, Instant later)
{
    std::vector<std::string> failed;
    if (!is_understood_and_sent_as_it_is(known))
        failed.emplace_back("a known telegram is decoded or encoded wrongly");
    else if (!is_refused_with_any_bit_wrong(known))
        failed.emplace_back("a telegram with a wrong bit is accepted as valid");
    if (later <= earlier) failed.emplace_back("the clock of the bus (CLOCK_MONOTONIC) does not advance");
    return failed;
}

} // namespace dpslave::app
