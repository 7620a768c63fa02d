// SPDX-License-Identifier: Apache-2.0
// The form of captures before pcapng: a head with the link type of all packets, then packet after packet.
// Source: draft-ietf-opsawg-pcap, sections 4 and 5.
#include "blocks.hpp"
#include "view.hpp"

namespace dpslave::pcapng {
namespace {

constexpr std::uint32_t kMicroseconds = 0xA1B2C3D4, kInNanoseconds = 0xA1B23C4D;
constexpr std::size_t kHead = 24, kHeadOfPacket = 16;
constexpr std::uint32_t kLongestPacket = 262'144; // no program writes a longer one

bool is_magic(std::uint32_t magic)
{
    return magic == kMicroseconds || magic == kInNanoseconds;
}

std::int64_t unix_ns(const View& packet, bool is_in_ns)
{
    constexpr std::int64_t kSecond = 1'000'000'000;
    return packet.u32(0) * kSecond + packet.u32(4) * (is_in_ns ? 1LL : 1000LL);
}

} // namespace

bool is_pcap(Bytes file)
{
    return file.size() >= 4 && (is_magic(View{file, false}.u32(0)) || is_magic(View{file, true}.u32(0)));
}

Result<Capture, std::string> read_pcap(Bytes file, bool* cut)
{
    const bool swapped = !is_magic(View{file, false}.u32(0));
    const View head{file, swapped};
    if (file.size() < kHead) return Failure{std::string{"it is cut off within its head: it has no packet"}};
    if (const unsigned major = head.u16(4), minor = head.u16(6); major != 2 || minor != 4)
        return Failure{"it is pcap of version " + std::to_string(major) + "." + std::to_string(minor) +
                       ", and only 2.4 is known: save it as pcapng, with editcap or Wireshark"};
    const bool is_in_ns = head.u32(0) == kInNanoseconds;
    Capture capture;
    capture.interfaces.push_back({.link_type = head.u16(swapped ? 22 : 20), .name = {}, .description = {}});
    for (std::size_t at = kHead; at < file.size();) {
        const View packet = head.from(at);
        const std::uint32_t length = packet.octets.size() < kHeadOfPacket ? 0 : packet.u32(8);
        if (length > kLongestPacket)
            return Failure{"the packet at octet " + std::to_string(at) + ": its length is none"};
        if (packet.octets.size() < kHeadOfPacket + length) {
            if (cut != nullptr) *cut = true;
            break;
        }
        Packet found;
        found.unix_ns = unix_ns(packet, is_in_ns);
        const Bytes octets = packet.octets.subspan(kHeadOfPacket, length);
        found.octets.assign(octets.begin(), octets.end());
        found.is_part = packet.u32(12) > length;
        capture.packets.push_back(std::move(found));
        at += kHeadOfPacket + length;
    }
    return capture;
}

} // namespace dpslave::pcapng
