// SPDX-License-Identifier: Apache-2.0
#include "wire.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace test {
namespace {

std::uint8_t digit(char c)
{
    if (c >= '0' && c <= '9') return static_cast<std::uint8_t>(c - '0');
    if (c >= 'A' && c <= 'F') return static_cast<std::uint8_t>(c - 'A' + 10);
    if (c >= 'a' && c <= 'f') return static_cast<std::uint8_t>(c - 'a' + 10);
    throw std::invalid_argument(std::string{"no hex digit: "} + c);
}

std::uint8_t sum(Octets::const_iterator from, Octets::const_iterator to)
{
    return static_cast<std::uint8_t>(std::accumulate(from, to, 0u) % 256u);
}

Octets body(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, const Octets& data)
{
    Octets all{da, sa, fc};
    all.insert(all.end(), data.begin(), data.end());
    return all;
}

Octets body(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, Saps saps, const Octets& data)
{
    Octets all{static_cast<std::uint8_t>(da | 0x80), static_cast<std::uint8_t>(sa | 0x80), fc, saps.dsap,
               saps.ssap};
    all.insert(all.end(), data.begin(), data.end());
    return all;
}

Octets closed(Octets head, const Octets& inner)
{
    head.insert(head.end(), inner.begin(), inner.end());
    head.push_back(sum(inner.begin(), inner.end()));
    head.push_back(0x16);
    return head;
}

Octets as_sd2(const Octets& inner)
{
    const auto le = static_cast<std::uint8_t>(inner.size());
    return closed({0x68, le, le, 0x68}, inner);
}

Octets as_sd3(const Octets& inner)
{
    if (inner.size() != 11) throw std::invalid_argument("SD3 has eight octets of data");
    return closed({0xA2}, inner);
}

/// Takes the extension octet off the front of the data if the address announces one; false if it cannot be
/// one.
bool take_sap(std::uint8_t& address, Octets& data, std::optional<std::uint8_t>& sap)
{
    if ((address & 0x80) == 0) return true;
    address &= 0x7F;
    if (data.empty() || data.front() > 63) return false;
    sap = data.front();
    data.erase(data.begin());
    return true;
}

/// DA ... last data octet; nothing if the frame round it is not right.
std::optional<Octets> unwrapped(const Octets& all)
{
    std::size_t head = 1;
    switch (all.front()) {
        case 0x10:
            if (all.size() != 6) return std::nullopt;
            break;
        case 0xA2:
            if (all.size() != 14) return std::nullopt;
            break;
        case 0x68:
            if (all.size() < 10 || all.size() > 255) return std::nullopt;
            if (all[1] != all[2] || all[1] + 6u != all.size() || all[3] != 0x68) return std::nullopt;
            head = 4;
            break;
        default: return std::nullopt;
    }
    Octets inner;
    for (std::size_t i = head; i < all.size() - 2; ++i) inner.push_back(all[i]);
    if (all.back() != 0x16 || all[all.size() - 2] != sum(inner.begin(), inner.end())) return std::nullopt;
    return inner;
}

} // namespace

Octets octets(std::string_view hex_pairs)
{
    Octets out;
    for (std::size_t i = 0; i < hex_pairs.size();) {
        if (hex_pairs[i] == ' ' || hex_pairs[i] == '\n') {
            ++i;
            continue;
        }
        if (i + 1 == hex_pairs.size()) throw std::invalid_argument("half an octet");
        out.push_back(static_cast<std::uint8_t>(digit(hex_pairs[i]) << 4 | digit(hex_pairs[i + 1])));
        i += 2;
    }
    return out;
}

std::string show(const Octets& octets)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string out;
    for (const std::uint8_t octet : octets) {
        if (!out.empty()) out += ' ';
        out += digits[octet / 16];
        out += digits[octet % 16];
    }
    return out;
}

Octets joined(const std::vector<Octets>& parts)
{
    Octets all;
    for (const Octets& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

Octets sd1(std::uint8_t da, std::uint8_t sa, std::uint8_t fc)
{
    return closed({0x10}, body(da, sa, fc, {}));
}

Octets sd2(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, const Octets& data)
{
    return as_sd2(body(da, sa, fc, data));
}

Octets sd2_with_saps(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, Saps saps, const Octets& data)
{
    return as_sd2(body(da, sa, fc, saps, data));
}

Octets sd3(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, const Octets& data)
{
    return as_sd3(body(da, sa, fc, data));
}

Octets sd3(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, Saps saps, const Octets& data)
{
    return as_sd3(body(da, sa, fc, saps, data));
}

Octets token(std::uint8_t da, std::uint8_t sa)
{
    return {0xDC, da, sa};
}

Octets sc()
{
    return {0xE5};
}

std::optional<Heard> heard(const Octets& octets)
{
    if (octets.empty()) return std::nullopt;
    Heard h;
    h.delimiter = octets.front();
    if (octets.front() == 0xE5) return octets.size() == 1 ? std::optional{h} : std::nullopt;
    if (octets.front() == 0xDC) {
        if (octets.size() != 3) return std::nullopt;
        h.da = octets[1];
        h.sa = octets[2];
        return h;
    }
    const std::optional<Octets> inner = unwrapped(octets);
    if (!inner) return std::nullopt;
    h.da = (*inner)[0];
    h.sa = (*inner)[1];
    h.fc = (*inner)[2];
    h.data.assign(inner->begin() + 3, inner->end());
    if (!take_sap(h.da, h.data, h.dsap) || !take_sap(h.sa, h.data, h.ssap)) return std::nullopt;
    if (h.sa == 127) return std::nullopt;
    return h;
}

bool ends_with_answerable_request(const Octets& octets)
{
    constexpr std::string_view answered{"\x03\x05\x07\x09\x0C\x0D\x0E\x0F"};
    for (std::size_t length = 6; length <= std::min<std::size_t>(255, octets.size()); ++length) {
        const std::optional<Heard> h =
            heard({octets.end() - static_cast<std::ptrdiff_t>(length), octets.end()});
        if (h && h->is_request() && (h->fc & 0x80) == 0 && h->da != 127 &&
            answered.find(static_cast<char>(h->fc & 0x0F)) != std::string_view::npos)
            return true;
    }
    return false;
}

} // namespace test
