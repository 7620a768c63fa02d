// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/telegram.hpp"

namespace dpslave::fdl {
namespace {

constexpr std::uint8_t kExtension = 0x80; // in DA and SA: a SAP octet follows in the data
constexpr std::uint8_t kHighestSap = 63;
constexpr std::size_t kLeMin = 4;
constexpr std::size_t kLeMax = 249;

/// FCS: DA to the last data octet, carries dropped (wire reference 2.1).
std::uint8_t checksum(Bytes body)
{
    unsigned sum = 0;
    for (const std::uint8_t octet : body) sum += octet;
    return static_cast<std::uint8_t>(sum);
}

/// Takes the SAP octet that the extension bit of `address` announces off the front of `data`.
std::optional<Flaw> split_sap(std::uint8_t& address, Bytes& data, std::optional<std::uint8_t>& sap)
{
    if ((address & kExtension) == 0) return std::nullopt;
    address &= 0x7F;
    if (data.empty()) return Flaw::missing_sap;
    if (data.front() > kHighestSap) return Flaw::extension;
    sap = data.front();
    data = data.subspan(1);
    return std::nullopt;
}

void close(Frame& frame, std::size_t body_begins)
{
    frame.push(checksum(frame.bytes().subspan(body_begins)));
    frame.push(kED);
}

} // namespace

std::string_view text(Flaw flaw) noexcept
{
    switch (flaw) {
        case Flaw::start_delimiter: return "start delimiter";
        case Flaw::length_mismatch: return "length mismatch";
        case Flaw::length_range: return "length out of range";
        case Flaw::checksum: return "checksum";
        case Flaw::end_delimiter: return "end delimiter";
        case Flaw::missing_sap: return "missing SAP";
        case Flaw::extension: return "unknown address extension";
        case Flaw::source_address: return "source address";
        case Flaw::character: return "bad character";
        case Flaw::unfinished: return "unfinished";
    }
    return "?";
}

Result<std::size_t, Flaw> frame_length(Bytes head)
{
    if (head.empty()) return std::size_t{0};
    switch (head[0]) {
        case kSC: return std::size_t{1};
        case kSD4: return std::size_t{3};
        case kSD1: return std::size_t{6};
        case kSD3: return std::size_t{14};
        case kSD2: break;
        default: return Failure{Flaw::start_delimiter};
    }
    if (head.size() < 4) return std::size_t{0};
    const std::size_t le = head[1];
    if (le != head[2] || head[3] != kSD2) return Failure{Flaw::length_mismatch};
    if (le < kLeMin || le > kLeMax) return Failure{Flaw::length_range};
    return le + 6;
}

Result<Telegram, Flaw> decode(Bytes frame)
{
    Telegram telegram;
    telegram.delimiter = frame[0];
    if (telegram.delimiter == kSC) return telegram;
    if (telegram.delimiter == kSD4) {
        telegram.da = frame[1];
        telegram.sa = frame[2];
        return telegram;
    }

    const Bytes body = frame.first(frame.size() - 2).subspan(frame[0] == kSD2 ? 4 : 1);
    if (frame.back() != kED) return Failure{Flaw::end_delimiter};
    if (frame[frame.size() - 2] != checksum(body)) return Failure{Flaw::checksum};

    telegram.da = body[0];
    telegram.sa = body[1];
    telegram.fc = body[2];
    telegram.data = body.subspan(3);
    if (const auto flaw = split_sap(telegram.da, telegram.data, telegram.dsap)) return Failure{*flaw};
    if (const auto flaw = split_sap(telegram.sa, telegram.data, telegram.ssap)) return Failure{*flaw};
    if (telegram.sa == kBroadcast) return Failure{Flaw::source_address};
    return telegram;
}

Frame encode_sd1(std::uint8_t da, std::uint8_t sa, std::uint8_t fc)
{
    Frame frame;
    frame.push(kSD1);
    frame.push(da);
    frame.push(sa);
    frame.push(fc);
    close(frame, 1);
    return frame;
}

Frame encode_sd2(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, std::optional<std::uint8_t> dsap,
                 std::optional<std::uint8_t> ssap, Bytes data)
{
    Frame frame;
    encode_sd2(frame, {kSD2, da, sa, fc, dsap, ssap, data});
    return frame;
}

void encode_sd2(Frame& frame, const Telegram& telegram)
{
    const bool extended = telegram.dsap && telegram.ssap;
    const auto le = static_cast<std::uint8_t>(3 + (extended ? 2 : 0) + telegram.data.size());
    frame.clear();
    frame.push(kSD2);
    frame.push(le);
    frame.push(le);
    frame.push(kSD2);
    frame.push(extended ? telegram.da | kExtension : telegram.da);
    frame.push(extended ? telegram.sa | kExtension : telegram.sa);
    frame.push(telegram.fc);
    if (extended) {
        frame.push(*telegram.dsap);
        frame.push(*telegram.ssap);
    }
    frame.append(telegram.data);
    close(frame, 4);
}

Frame encode_sc()
{
    Frame frame;
    frame.push(kSC);
    return frame;
}

} // namespace dpslave::fdl
