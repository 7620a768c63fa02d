// SPDX-License-Identifier: Apache-2.0
#include "blocks.hpp"

#include "dpslave/pcapng/pcapng.hpp"

#include <algorithm>

namespace dpslave::pcapng {
namespace {

/// One block, built from its front. Its length is at both ends.
class Builder {
public:
    explicit Builder(std::uint32_t type)
    {
        put32(type);
        put32(0);
    }

    void put8(std::uint8_t value) { octets_.push_back(value); }
    void put16(std::uint16_t value)
    {
        put8(static_cast<std::uint8_t>(value & 0xFF));
        put8(static_cast<std::uint8_t>(value >> 8));
    }
    void put32(std::uint32_t value)
    {
        put16(static_cast<std::uint16_t>(value & 0xFFFF));
        put16(static_cast<std::uint16_t>(value >> 16));
    }
    void put64(std::uint64_t value)
    {
        put32(static_cast<std::uint32_t>(value));
        put32(static_cast<std::uint32_t>(value >> 32));
    }
    /// A time stamp has its high half first, in either byte order.
    void put_time(std::int64_t unix_ns)
    {
        const auto ns = static_cast<std::uint64_t>(unix_ns);
        put32(static_cast<std::uint32_t>(ns >> 32));
        put32(static_cast<std::uint32_t>(ns));
    }
    void put(Bytes octets)
    {
        octets_.insert(octets_.end(), octets.begin(), octets.end());
        while (octets_.size() % 4 != 0) put8(0);
    }

    void option(std::uint16_t code, Bytes value)
    {
        value = value.first(std::min<std::size_t>(value.size(), 0xFFFF));
        put16(code);
        put16(static_cast<std::uint16_t>(value.size()));
        put(value);
        has_options_ = true;
    }
    void option(std::uint16_t code, std::string_view text)
    {
        if (!text.empty()) option(code, bytes_of(text));
    }
    void option64(std::uint16_t code, std::uint64_t value)
    {
        put16(code);
        put16(8);
        put64(value);
        has_options_ = true;
    }
    void option32(std::uint16_t code, std::uint32_t value)
    {
        put16(code);
        put16(4);
        put32(value);
        has_options_ = true;
    }

    Octets finish()
    {
        if (has_options_) put32(kEnd);
        const auto length = static_cast<std::uint32_t>(octets_.size() + 4);
        put32(length);
        for (std::size_t i = 0; i < 4; ++i) octets_[4 + i] = octets_[octets_.size() - 4 + i];
        return std::move(octets_);
    }

private:
    Octets octets_;
    bool has_options_ = false;
};

Octets section(std::string_view program, std::string_view comment)
{
    Builder block{kSectionBlock};
    block.put32(kByteOrder);
    block.put16(1); // version 1.0
    block.put16(0);
    block.put64(~std::uint64_t{0}); // length not known
    block.option(kComment, comment);
    block.option(kProgram, program);
    return block.finish();
}

} // namespace

Octets block(const Interface& interface)
{
    Builder block{kInterfaceBlock};
    block.put16(interface.link_type);
    block.put16(0);
    block.put32(0); // no limit of a packet
    block.option(kName, interface.name);
    block.option(kDescription, interface.description);
    const std::uint8_t resolution = kNanoseconds;
    block.option(kTimeResolution, Bytes{&resolution, 1});
    return block.finish();
}

Octets file_header(std::string_view program, std::string_view comment,
                   const std::vector<Interface>& interfaces)
{
    Octets file = section(program, comment);
    for (const Interface& interface : interfaces) {
        const Octets one = block(interface);
        file.insert(file.end(), one.begin(), one.end());
    }
    return file;
}

Octets block(const Packet& packet)
{
    Builder block{kEnhancedPacketBlock};
    block.put32(packet.interface);
    block.put_time(packet.unix_ns);
    const auto length = static_cast<std::uint32_t>(packet.octets.size());
    block.put32(length);
    block.put32(length);
    block.put(packet.octets);
    for (const std::string& comment : packet.comments) block.option(kComment, comment);
    const std::uint32_t direction = packet.direction == Direction::inbound    ? kInbound
                                    : packet.direction == Direction::outbound ? kOutbound
                                                                              : 0;
    block.option32(kFlags, direction | (packet.checksum_error ? kChecksumError : 0) |
                               (packet.character_error ? kSymbolError : 0));
    if (packet.dropped) block.option64(kDropCount, *packet.dropped);
    return block.finish();
}

Octets block(const Statistics& statistics)
{
    Builder block{kStatisticsBlock};
    block.put32(statistics.interface);
    block.put_time(statistics.unix_ns);
    block.option64(kStatisticsReceived, statistics.received);
    block.option64(kStatisticsDropped, statistics.dropped);
    return block.finish();
}

} // namespace dpslave::pcapng
