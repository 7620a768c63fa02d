// SPDX-License-Identifier: Apache-2.0
#include "blocks.hpp"
#include "view.hpp"

#include "dpslave/pcapng/pcapng.hpp"

#include <algorithm>
#include <array>

namespace dpslave::pcapng {
namespace {

struct OptionValue {
    std::uint16_t code = 0;
    View value;
};

constexpr std::size_t padded(std::size_t length)
{
    return (length + 3) / 4 * 4;
}

/// Those that are complete; what follows a broken one is passed over.
std::vector<OptionValue> options(View view)
{
    std::vector<OptionValue> found;
    while (view.octets.size() >= 4) {
        const std::uint16_t code = view.u16(0);
        const std::size_t length = view.u16(2);
        if (code == kEnd || view.octets.size() < 4 + length) break;
        found.push_back({code, {view.octets.subspan(4, length), view.swapped}});
        view = view.from(4 + padded(length));
    }
    return found;
}

/// Converts the time stamps of an interface to nanoseconds.
struct Clock {
    std::uint8_t resolution = 6; // if_tsresol: microseconds unless the file says otherwise
    std::int64_t offset_s = 0;

    std::int64_t unix_ns(std::uint64_t units) const
    {
        constexpr std::uint64_t kSecond = 1'000'000'000;
        const std::uint64_t ns = is_binary() ? from_binary(units) : from_decimal(units);
        return static_cast<std::int64_t>(ns + static_cast<std::uint64_t>(offset_s) * kSecond);
    }

private:
    bool is_binary() const { return (resolution & 0x80) != 0; }
    unsigned exponent() const { return resolution & 0x7F; }

    std::uint64_t from_decimal(std::uint64_t units) const
    {
        for (unsigned i = exponent(); i < kNanoseconds; ++i) units *= 10;
        for (unsigned i = kNanoseconds; i < exponent() && units != 0; ++i) units /= 10;
        return units;
    }
    /// The fraction of a second is used with 34 bits: more than nanoseconds need, and the product fits.
    std::uint64_t from_binary(std::uint64_t units) const
    {
        constexpr std::uint64_t kSecond = 1'000'000'000;
        constexpr unsigned kBits = 34;
        if (exponent() >= 64) return 0;
        const std::uint64_t seconds = exponent() == 0 ? units : units >> exponent();
        std::uint64_t fraction = exponent() == 0 ? 0 : units & ((std::uint64_t{1} << exponent()) - 1);
        const unsigned bits = std::min(exponent(), kBits);
        fraction >>= exponent() - bits;
        return seconds * kSecond + (fraction * kSecond >> bits);
    }
};

class Reader {
public:
    std::optional<std::string> take(std::uint32_t type, View body)
    {
        switch (type) {
            case kInterfaceBlock: return interface(body);
            case kEnhancedPacketBlock: return packet(body);
            case kSimplePacketBlock: return simple_packet(body);
            case kStatisticsBlock: return statistics(body);
            default: return std::nullopt; // of no interest here
        }
    }
    void begin_section(View body)
    {
        first_interface_ = capture.interfaces.size();
        for (const OptionValue& option : options(body.from(16)))
            if (option.code == kComment && capture.comment.empty()) capture.comment = option.value.text();
    }

    Capture capture;

private:
    std::optional<std::string> interface(View body)
    {
        if (body.octets.size() < 8) return "an interface block is too short";
        Interface found{.link_type = body.u16(0), .name = {}, .description = {}};
        Clock clock;
        for (const OptionValue& option : options(body.from(8))) {
            if (option.code == kName) found.name = option.value.text();
            if (option.code == kDescription) found.description = option.value.text();
            if (option.code == kTimeResolution && !option.value.octets.empty())
                clock.resolution = option.value.octets[0];
            if (option.code == kTimeOffset && option.value.octets.size() == 8)
                clock.offset_s = static_cast<std::int64_t>(option.value.u64(0));
        }
        capture.interfaces.push_back(std::move(found));
        clocks_.push_back(clock);
        return std::nullopt;
    }

    std::optional<std::string> packet(View body)
    {
        if (body.octets.size() < 20) return "a packet block is too short";
        Packet found;
        if (auto why = place(body.u32(0), found.interface)) return why;
        const std::uint64_t units = std::uint64_t{body.u32(4)} << 32 | body.u32(8);
        found.unix_ns = clocks_[found.interface].unix_ns(units);
        const std::size_t length = body.u32(12);
        if (length > body.octets.size() - 20) return "a packet is longer than its block";
        const Bytes octets = body.octets.subspan(20, length);
        found.octets.assign(octets.begin(), octets.end());
        found.is_part = body.u32(16) > length;
        for (const OptionValue& option : options(body.from(20 + padded(length)))) {
            if (option.code == kComment) found.comments.push_back(option.value.text());
            if (option.code == kFlags && option.value.octets.size() == 4) flag(found, option.value.u32(0));
            if (option.code == kDropCount && option.value.octets.size() == 8)
                found.dropped = option.value.u64(0);
        }
        capture.packets.push_back(std::move(found));
        return std::nullopt;
    }

    /// It has neither a time nor an interface: it is of the first one.
    std::optional<std::string> simple_packet(View body)
    {
        if (body.octets.size() < 4) return "a packet block is too short";
        Packet found;
        if (auto why = place(0, found.interface)) return why;
        const std::size_t length = std::min<std::size_t>(body.u32(0), body.octets.size() - 4);
        const Bytes octets = body.octets.subspan(4, length);
        found.octets.assign(octets.begin(), octets.end());
        found.is_part = body.u32(0) > length;
        capture.packets.push_back(std::move(found));
        return std::nullopt;
    }

    std::optional<std::string> statistics(View body)
    {
        if (body.octets.size() < 12) return "a statistics block is too short";
        Statistics found;
        if (auto why = place(body.u32(0), found.interface)) return why;
        found.unix_ns = clocks_[found.interface].unix_ns(std::uint64_t{body.u32(4)} << 32 | body.u32(8));
        for (const OptionValue& option : options(body.from(12))) {
            if (option.value.octets.size() != 8) continue;
            if (option.code == kStatisticsReceived) found.received = option.value.u64(0);
            if (option.code == kStatisticsDropped) found.dropped = option.value.u64(0);
        }
        capture.statistics.push_back(found);
        return std::nullopt;
    }

    static void flag(Packet& packet, std::uint32_t flags)
    {
        if ((flags & kDirectionMask) == kInbound) packet.direction = Direction::inbound;
        if ((flags & kDirectionMask) == kOutbound) packet.direction = Direction::outbound;
        packet.checksum_error = (flags & kChecksumError) != 0;
        packet.character_error = (flags & kSymbolError) != 0;
    }

    /// The numbers of a section begin at 0.
    std::optional<std::string> place(std::uint32_t in_section, std::uint32_t& interface) const
    {
        if (in_section >= capture.interfaces.size() - first_interface_)
            return "a packet names interface " + std::to_string(in_section) + ", which no block describes";
        interface = static_cast<std::uint32_t>(first_interface_ + in_section);
        return std::nullopt;
    }

    std::size_t first_interface_ = 0; // of this section
    std::vector<Clock> clocks_;       // of capture.interfaces
};

/// Returns whether a section begins here, and in which byte order: 0 = none, 1 = little endian, 2 = big
/// endian.
int byte_order(Bytes rest)
{
    constexpr std::size_t kLeast = 28;
    if (rest.size() < kLeast || View{rest}.u32(0) != kSectionBlock) return 0;
    const std::uint32_t order = View{rest}.u32(8);
    return order == kByteOrder ? 1 : order == kByteOrderSwapped ? 2 : 0;
}

/// Returns what a file is that is no capture, and what to do.
std::string what_it_is(Bytes file)
{
    using namespace std::string_view_literals;
    struct Begin {
        std::string_view octets, what;
    };
    static constexpr std::array kBegins = std::to_array<Begin>({
        {"\x1F\x8B"sv, "it is compressed with gzip: unpack it first"},
        {"\x28\xB5\x2F\xFD"sv, "it is compressed with zstd: unpack it first"},
        {"\x04\x22\x4D\x18"sv, "it is compressed with lz4: unpack it first"},
        {"\xFD"
         "7zXZ"sv,
         "it is compressed with xz: unpack it first"},
        {"\x34\xCD\xB2\xA1"sv, "it is a variant of pcap: save it as pcapng, with editcap or Wireshark"},
        {"\xA1\xB2\xCD\x34"sv, "it is a variant of pcap: save it as pcapng, with editcap or Wireshark"},
        {"dpslaved incident "sv,
         "it is an incident of dpslaved, no capture: dpctl trace --incident shows it"},
    });
    if (file.empty()) return "it is empty: no capture was written into it";
    for (const Begin& begin : kBegins)
        if (file.size() >= begin.octets.size() &&
            std::equal(begin.octets.begin(), begin.octets.end(), file.begin(),
                       [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }))
            return std::string{begin.what};
    return "it is no capture: it begins neither as pcapng nor as pcap. Save the capture in one of these forms";
}

} // namespace

Result<Capture, std::string> read(Bytes file, bool* cut)
{
    if (cut != nullptr) *cut = false;
    if (is_pcap(file)) return read_pcap(file, cut);
    const int first = byte_order(file);
    if (first == 0) return Failure{what_it_is(file)};
    Reader reader;
    bool swapped = first == 2;
    for (std::size_t at = 0; at < file.size();) {
        const Bytes rest = file.subspan(at);
        if (const int order = byte_order(rest); order != 0) swapped = order == 2;
        const View head{rest, swapped};
        const std::size_t length = rest.size() < 12 ? 0 : head.u32(4);
        if (rest.size() < 12 || length > rest.size()) {
            if (cut != nullptr) *cut = true;
            break;
        }
        const auto here = [at](const std::string& why) {
            return Failure{"the block at octet " + std::to_string(at) + ": " + why};
        };
        if (length < 12 || length % 4 != 0) return here("its length is none");
        if (head.u32(length - 4) != length) return here("its two lengths differ");
        const std::uint32_t type = head.u32(0);
        const View body{rest.subspan(8, length - 12), swapped};
        if (type == kSectionBlock) {
            if (body.octets.size() < 16) return here("a section header is too short");
            if (byte_order(rest) == 0) return here("a section header without a known byte order");
            reader.begin_section(body);
        } else if (const auto why = reader.take(type, body)) {
            return here(*why);
        }
        at += length;
    }
    return std::move(reader.capture);
}

} // namespace dpslave::pcapng
