// SPDX-License-Identifier: Apache-2.0
/// The second hand: builds and judges telegrams from the wire reference alone, without a line of the code
/// under test.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace test {

using Octets = std::vector<std::uint8_t>;

/// "68 05 05 68 ..." as octets. Anything but hex pairs and blanks is a mistake of the test and throws.
Octets octets(std::string_view hex_pairs);

/// The other way round, for messages.
std::string show(const Octets& octets);

/// Several telegrams as one run of octets.
Octets joined(const std::vector<Octets>& parts);

/// Destination and source service access points of a request, in the order in which they are on the wire.
struct Saps {
    std::uint8_t dsap;
    std::uint8_t ssap;
};

// Telegrams (wire reference 2.1).
Octets sd1(std::uint8_t da, std::uint8_t sa, std::uint8_t fc);
Octets sd2(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, const Octets& data);
Octets sd2_with_saps(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, Saps saps, const Octets& data);
/// A template, so that {0x12, 0x34} is always data and never a pair of SAPs.
template <std::same_as<Saps> S>
Octets sd2(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, S saps, const Octets& data = {})
{
    return sd2_with_saps(da, sa, fc, saps, data);
}
/// Exactly eight octets of data, or six and two SAPs.
Octets sd3(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, const Octets& data);
Octets sd3(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, Saps saps, const Octets& data);
Octets token(std::uint8_t da, std::uint8_t sa);
Octets sc();

/// A telegram as the second hand understands it.
struct Heard {
    std::uint8_t delimiter = 0;
    std::uint8_t da = 0; ///< without the extension bit
    std::uint8_t sa = 0;
    std::uint8_t fc = 0;
    std::optional<std::uint8_t> dsap;
    std::optional<std::uint8_t> ssap;
    Octets data;

    bool has_fc() const { return delimiter != 0xE5 && delimiter != 0xDC; }
    bool is_request() const { return has_fc() && (fc & 0x40) != 0; }
};

/// The one telegram that these octets are, from the first to the last; nothing if they break any rule of 2.7.
std::optional<Heard> heard(const Octets& octets);

/// Whether a slave may answer these octets: their end is a valid request to one station that asks for an
/// answer.
bool ends_with_answerable_request(const Octets& octets);

} // namespace test
