// SPDX-License-Identifier: Apache-2.0
#include "sent_counts.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace conformance {
namespace {

constexpr std::uint8_t kBroadcast = 127;

/// Where DA, SA and FC stand; 0: this begins no telegram that has them.
std::size_t header_of(const test::Octets& octets)
{
    if (octets.empty()) return 0;
    switch (octets[0]) {
        case 0x10:           // SD1
        case 0xA2: return 1; // SD3
        case 0x68: return 4; // SD2
        default: return 0;
    }
}

std::size_t whole_length(const test::Octets& octets)
{
    switch (octets[0]) {
        case 0x10: return 6;
        case 0xA2: return 14;
        default: return octets.size() < 4 || octets[1] != octets[2] || octets[3] != 0x68 ? 0 : octets[1] + 6u;
    }
}

/// Wire reference 2.3: a request with function 4 or 6.
bool is_sdn(std::uint8_t fc)
{
    return (fc & 0xCF) == 0x44 || (fc & 0xCF) == 0x46;
}

} // namespace

bool is_whole(const test::Octets& octets)
{
    const std::size_t header = header_of(octets);
    if (header == 0 || octets.size() < 6 || octets.size() != whole_length(octets)) return false;
    const unsigned sum =
        std::accumulate(octets.begin() + static_cast<std::ptrdiff_t>(header), octets.end() - 2, 0U);
    return octets[octets.size() - 2] == sum % 256 && octets.back() == 0x16;
}

void SentCounts::begin(std::uint8_t address)
{
    *this = {};
    address_ = address;
}

void SentCounts::note_request(const test::Octets& octets)
{
    octets_ += octets.size();
    ++requests_;
}

void SentCounts::note_other(const test::Octets& octets)
{
    octets_ += octets.size();
    if (!is_whole(octets)) return;
    const std::size_t header = header_of(octets);
    const unsigned to = octets[header] & 0x7FU;
    if (is_sdn(octets[header + 2]) && (to == address_ || to == kBroadcast)) ++to_us_without_answer_;
}

testing::AssertionResult SentCounts::agree(const nlohmann::json& counters) const
{
    std::uint64_t octets = 0, requests = 0, missed = 0, flaws = 0;
    for (const nlohmann::json& one : counters.at("groups").at(0).at("counters")) {
        const auto name = one.at("name").get<std::string>();
        const auto value = one.at("value").get<std::uint64_t>();
        if (name == "octets") octets = value;
        if (name == "requests") requests = value;
        if (name == "late" || name == "overtaken" || name == "unsent") missed += value;
        if (name.starts_with("flaw: ")) flaws += value;
    }
    const std::uint64_t asked = requests_ + to_us_without_answer_;
    const std::uint64_t unheard = asked - std::min(asked, requests);
    const std::uint64_t accounted_for = answers_ + missed + to_us_without_answer_;
    if (octets == octets_ && requests <= accounted_for && unheard <= flaws)
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << octets_ << " octets and " << asked << " requests were sent, " << to_us_without_answer_
           << " of them without an answer, and " << answers_ << " were answered. The daemon counts " << octets
           << " octets, " << requests << " requests, " << missed << " missed and " << flaws << " flaws";
}

} // namespace conformance
