// SPDX-License-Identifier: Apache-2.0
#include "wire.hpp"

#include <algorithm>

namespace dpslave::bench {
namespace {

constexpr std::uint8_t kExt = 0x80;
constexpr std::size_t kDemandData = 8; ///< octets, each way
constexpr std::size_t kParameters = 12;

std::size_t written(Words words)
{
    return words == Words::all_read ? 0 : kParameters / 2;
}

std::uint8_t sum(std::span<const std::uint8_t> octets)
{
    unsigned total = 0;
    for (const std::uint8_t octet : octets) total += octet;
    return static_cast<std::uint8_t>(total);
}

Octets with_saps(std::uint8_t address, std::uint8_t fc, std::uint8_t dsap, const Octets& data = {})
{
    constexpr std::uint8_t kSsap = 62;
    Octets body{static_cast<std::uint8_t>(address | kExt), kMaster | kExt, fc, dsap, kSsap};
    body.insert(body.end(), data.begin(), data.end());
    return sd2(body);
}

/// An SD2 frame that is whole, from the slave to the master, is recognised by everything but its contents.
bool is_whole_sd2(std::span<const std::uint8_t> frame)
{
    if (frame.size() < 9 || frame.size() != length_of(frame) || frame.back() != 0x16) return false;
    const std::size_t end = frame.size() - 2;
    return frame[end] == sum(frame.subspan(4, end - 4));
}

} // namespace

Octets sd2(const Octets& body)
{
    const auto length = static_cast<std::uint8_t>(body.size());
    Octets frame{0x68, length, length, 0x68};
    frame.insert(frame.end(), body.begin(), body.end());
    frame.insert(frame.end(), {sum(body), 0x16});
    return frame;
}

std::size_t inputs_of(Words words)
{
    return kDemandData + 2 * (kParameters - written(words));
}

Octets slave_diag(std::uint8_t address, std::uint8_t fc)
{
    return with_saps(address, fc, 60);
}

Octets set_prm(std::uint8_t address, std::uint8_t fc)
{
    Octets data{0x88, 100, 100, 11, 0x05, 0x33, 0x00}; // 100 s: each of 32 drives is found silent first
    for (std::uint8_t tag = 1; tag <= kParameters; ++tag) data.insert(data.end(), {0x00, tag});
    return with_saps(address, fc, 61, data);
}

Octets chk_cfg(std::uint8_t address, std::uint8_t fc, Words words)
{
    Octets data(1 + kParameters, 0x50);
    data.front() = 0x73;
    std::fill_n(data.begin() + 1, written(words), std::uint8_t{0x60});
    return with_saps(address, fc, 62, data);
}

Octets data_exchange(std::uint8_t address, std::uint8_t fc, Words words, std::uint16_t value)
{
    Octets body{address, kMaster, fc};
    body.resize(body.size() + kDemandData);
    for (std::size_t i = 0; i < written(words); ++i)
        body.insert(body.end(), {static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)});
    return sd2(body);
}

Octets data_exchange_reply(std::uint8_t inputs)
{
    Octets body{kMaster, kSlave, 0x08};
    body.resize(body.size() + inputs_of(Words::all_read), inputs);
    return sd2(body);
}

std::size_t length_of(std::span<const std::uint8_t> head)
{
    if (head.empty()) return 0;
    if (head[0] == 0xE5) return 1;
    if (head.size() < 4 || head[0] != 0x68 || head[1] != head[2] || head[3] != 0x68) return 0;
    return head[1] + std::size_t{6};
}

bool is_data_exchange_reply(std::span<const std::uint8_t> frame, std::uint8_t address, std::size_t inputs)
{
    return frame.size() == 9 + inputs && is_whole_sd2(frame) && frame[4] == kMaster && frame[5] == address &&
           (frame[6] == 0x08 || frame[6] == 0x0A);
}

std::span<const std::uint8_t> diagnosis_in(std::span<const std::uint8_t> frame, std::uint8_t address)
{
    constexpr std::size_t kBefore = 9; // SD2 LE LEr SD2 DA SA FC DSAP SSAP
    if (frame.size() < kBefore + 6 + 2 || !is_whole_sd2(frame)) return {};
    if (frame[4] != (kMaster | kExt) || frame[5] != (address | kExt) || frame[6] != 0x08) return {};
    if (frame[7] != 62 || frame[8] != 60) return {};
    return frame.subspan(kBefore, frame.size() - kBefore - 2);
}

} // namespace dpslave::bench
