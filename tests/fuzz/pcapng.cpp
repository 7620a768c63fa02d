// SPDX-License-Identifier: Apache-2.0
/// A capture file: read as it is; or packets of the input, written and read, in the form pcap by this target.
/// Judged: a packet has its interface, its octets come from the file; what is written is read as it was; a
/// file that is cut gives what is whole; and each packet of a bus gets a direction.
#include "dpslave/pcapng/pcapng.hpp"

#include "input.hpp"

namespace {

using namespace dpslave;
using fuzz::demand;

void judge_directions(pcapng::Capture& capture)
{
    const auto has_none = [&](const pcapng::Packet& packet) {
        return pcapng::is_profibus(capture.interfaces[packet.interface].link_type) &&
               !packet.octets.empty() && packet.direction == pcapng::Direction::unknown;
    };
    const auto without = static_cast<std::size_t>(std::ranges::count_if(capture.packets, has_none));
    const pcapng::Assumed assumed = pcapng::assume_directions(capture);
    demand(assumed.packets == without, "each packet without a direction is counted");
    demand(std::ranges::none_of(capture.packets, has_none), "each packet of a bus has a direction");
    if (without != 0) demand(!pcapng::in_words(assumed).empty(), "what was assumed has words");
}

void judge_reading(Bytes file)
{
    bool is_cut = false;
    auto capture = pcapng::read(file, &is_cut);
    if (!capture) {
        demand(!capture.error().empty() && capture.error().find('\n') == std::string::npos,
               "why is one line");
        return;
    }
    std::size_t octets = 0;
    for (const auto& packet : capture->packets) {
        demand(packet.interface < capture->interfaces.size(), "a packet has an interface");
        octets += packet.octets.size();
        for (const std::string& comment : packet.comments) octets += comment.size();
    }
    for (const auto& statistics : capture->statistics)
        demand(statistics.interface < capture->interfaces.size(), "figures have an interface");
    for (const auto& interface : capture->interfaces)
        octets += interface.name.size() + interface.description.size();
    demand(octets + capture->comment.size() <= file.size(), "what is read lies in the file");
    demand((capture->packets.size() + capture->interfaces.size()) * 16 <= file.size(),
           "a block is no less than that");
    judge_directions(*capture);
}

std::string text_of(fuzz::Input& input)
{
    std::string text;
    for (const std::uint8_t octet : input.octets(input.octet() % 20)) text += static_cast<char>(octet);
    return text;
}

pcapng::Packet packet_of(fuzz::Input& input, std::size_t interfaces)
{
    pcapng::Packet packet;
    packet.interface = static_cast<std::uint32_t>(input.octet() % interfaces);
    for (int i = 0; i < 4; ++i)
        packet.unix_ns =
            static_cast<std::int64_t>(static_cast<std::uint64_t>(packet.unix_ns) << 16 | input.word());
    const std::uint8_t flags = input.octet();
    packet.direction = static_cast<pcapng::Direction>(flags % 3);
    packet.checksum_error = (flags & 0x10) != 0;
    packet.character_error = (flags & 0x20) != 0;
    if ((flags & 0x40) != 0) packet.dropped = input.word();
    const auto octets = input.octets(input.octet());
    packet.octets.assign(octets.begin(), octets.end());
    if ((flags & 0x80) != 0) packet.comments.push_back("x" + text_of(input));
    return packet;
}

bool equal(const pcapng::Packet& a, const pcapng::Packet& b)
{
    return a.interface == b.interface && a.unix_ns == b.unix_ns && a.direction == b.direction &&
           a.checksum_error == b.checksum_error && a.character_error == b.character_error &&
           a.dropped == b.dropped && a.octets == b.octets && a.comments == b.comments;
}

/// The packets of `file` are the first ones of `packets`.
void judge_prefix(Bytes file, const std::vector<pcapng::Packet>& packets, std::size_t least)
{
    bool is_cut = false;
    const auto capture = pcapng::read(file, &is_cut);
    demand(static_cast<bool>(capture), "a cut file is read");
    demand(capture->packets.size() == least, "each whole packet is read");
    for (std::size_t i = 0; i < capture->packets.size(); ++i)
        demand(equal(capture->packets[i], packets[i]), "a packet is read as it was written");
}

void judge_writing(fuzz::Input& input)
{
    std::vector<pcapng::Interface> interfaces;
    for (int i = 1 + input.octet() % 3; i > 0; --i)
        interfaces.push_back(
            {.link_type = input.word(), .name = text_of(input), .description = text_of(input)});
    pcapng::Octets file = pcapng::file_header(text_of(input), text_of(input), interfaces);
    const std::size_t header = file.size();
    std::vector<pcapng::Packet> packets;
    std::vector<std::size_t> ends;
    const std::size_t cut = input.word();
    while (!input.at_end() && packets.size() < 50) {
        packets.push_back(packet_of(input, interfaces.size()));
        const pcapng::Octets block = pcapng::block(packets.back());
        demand(block.size() % 4 == 0, "a block ends at a word");
        file.insert(file.end(), block.begin(), block.end());
        ends.push_back(file.size());
    }
    judge_prefix(file, packets, packets.size());
    const std::size_t length = header + cut % (file.size() - header + 1);
    const auto whole = static_cast<std::size_t>(
        std::ranges::count_if(ends, [length](std::size_t end) { return end <= length; }));
    judge_prefix(Bytes{file}.first(length), packets, whole);
}

/// A pcap file of the input, in either byte order and unit of time, cut anywhere.
void judge_pcap(fuzz::Input& input)
{
    const std::uint8_t form = input.octet();
    const bool is_big = (form & 1) != 0, is_in_ns = (form & 2) != 0;
    pcapng::Octets file;
    const auto number = [&](std::uint32_t value, int size) {
        for (int i = 0; i < size; ++i)
            file.push_back(static_cast<std::uint8_t>(value >> 8 * (is_big ? size - 1 - i : i)));
    };
    number(is_in_ns ? 0xA1B23C4D : 0xA1B2C3D4, 4);
    number(2, 2);
    number(4, 2);
    for (int i = 0; i < 3; ++i) number(input.word(), 4);
    number(257, 4);
    const std::size_t head = file.size(), cut = input.word();
    std::vector<pcapng::Packet> packets;
    std::vector<std::size_t> ends;
    while (!input.at_end() && packets.size() < 50) {
        const std::uint32_t seconds = input.word(), fraction = input.word();
        const auto octets = input.octets(input.octet());
        number(seconds, 4);
        number(fraction, 4);
        number(static_cast<std::uint32_t>(octets.size()), 4);
        number(input.word(), 4);
        file.insert(file.end(), octets.begin(), octets.end());
        pcapng::Packet packet{.unix_ns = seconds * 1'000'000'000LL + fraction * (is_in_ns ? 1LL : 1000LL)};
        packet.octets.assign(octets.begin(), octets.end());
        packets.push_back(std::move(packet));
        ends.push_back(file.size());
    }
    judge_prefix(file, packets, packets.size());
    const std::size_t length = head + cut % (file.size() - head + 1);
    const auto whole = static_cast<std::size_t>(
        std::ranges::count_if(ends, [length](std::size_t end) { return end <= length; }));
    judge_prefix(Bytes{file}.first(length), packets, whole);
    judge_reading(file);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0) return 0;
    if (data[0] == 0 || data[0] == 2) {
        fuzz::Input input{data + 1, size - 1};
        data[0] == 0 ? judge_writing(input) : judge_pcap(input);
    } else {
        judge_reading({data + 1, size - 1});
    }
    return 0;
}
