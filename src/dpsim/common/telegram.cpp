// SPDX-License-Identifier: Apache-2.0
#include "telegram.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>

namespace dpslave::sim {
namespace {

constexpr std::uint8_t kSd1 = 0x10, kSd2 = 0x68, kSd3 = 0xA2, kSd4 = 0xDC, kSc = 0xE5, kEd = 0x16;
constexpr std::uint8_t kExt = 0x80;

std::uint8_t sum(Bytes octets)
{
    return static_cast<std::uint8_t>(std::accumulate(octets.begin(), octets.end(), 0U) & 0xFFU);
}

/// Moves an announced SAP octet out of the data; false if it is missing.
bool take_sap(std::uint8_t& address, Octets& data, std::optional<std::uint8_t>& sap)
{
    if ((address & kExt) == 0) return true;
    if (data.empty()) return false;
    sap = data.front();
    data.erase(data.begin());
    address = static_cast<std::uint8_t>(address & ~kExt);
    return true;
}

std::string service_name(const Frame& frame)
{
    if (!frame.dsap) return "Data_Exchange";
    const std::string_view name = sap_name(*frame.dsap);
    return name.empty() ? fmt::format("SAP {}", *frame.dsap) : std::string{name};
}

std::string reply_name(std::uint8_t fc)
{
    switch (fc & 0x0F) {
        case 0x0: return "OK";
        case 0x1: return "UE (interface error in the slave)";
        case 0x2: return "RR (no resource for the data)";
        case 0x3: return "RS (service not activated)";
        case 0x8: return "DL (data)";
        case 0x9: return "NR (no data)";
        case 0xA: return "DH (data, diagnosis pending)";
        default: return fmt::format("function {:X}h", fc & 0x0F);
    }
}

} // namespace

std::string_view sap_name(std::uint8_t sap)
{
    switch (sap) {
        case 55: return "Set_Slave_Add";
        case 56: return "RD_Inp";
        case 57: return "RD_Outp";
        case kSapGlobalControl: return "Global_Control";
        case kSapGetCfg: return "Get_Cfg";
        case kSapSlaveDiag: return "Slave_Diag";
        case kSapSetPrm: return "Set_Prm";
        case kSapChkCfg: return "Chk_Cfg";
        default: return {};
    }
}

Octets encode(const Frame& frame, Fixed fixed)
{
    Octets body{static_cast<std::uint8_t>(frame.da | (frame.dsap ? kExt : 0)),
                static_cast<std::uint8_t>(frame.sa | (frame.ssap ? kExt : 0)), frame.fc};
    if (frame.dsap) body.push_back(*frame.dsap);
    if (frame.ssap) body.push_back(*frame.ssap);
    body.insert(body.end(), frame.data.begin(), frame.data.end());

    Octets wire;
    if (body.size() == 3) {
        wire = {kSd1};
    } else if (body.size() == 11 && fixed == Fixed::when_eight) {
        wire = {kSd3};
    } else {
        const auto le = static_cast<std::uint8_t>(body.size());
        wire = {kSd2, le, le, kSd2};
    }
    wire.insert(wire.end(), body.begin(), body.end());
    wire.push_back(sum(body));
    wire.push_back(kEd);
    return wire;
}

Result<std::size_t, std::string> frame_length(Bytes head)
{
    if (head.empty()) return std::size_t{0};
    switch (head[0]) {
        case kSc: return std::size_t{1};
        case kSd4: return std::size_t{3};
        case kSd1: return std::size_t{6};
        case kSd3: return std::size_t{14};
        case kSd2: break;
        default: return Failure{fmt::format("{:02X} is no start delimiter", head[0])};
    }
    if (head.size() < 4) return std::size_t{0};
    const std::size_t le = head[1];
    if (head[2] != le) return Failure{fmt::format("LE is {} but LEr is {}", le, head[2])};
    if (head[3] != kSd2) return Failure{fmt::format("the second SD2 is {:02X}", head[3])};
    if (le < 4 || le > 249) return Failure{fmt::format("LE {} is not in 4..249", le)};
    return le + 6;
}

Result<Frame, std::string> decode(Bytes octets)
{
    if (octets[0] == kSc) return Frame{.kind = FrameKind::short_ack};
    if (octets[0] == kSd4) return Frame{.kind = FrameKind::token, .da = octets[1], .sa = octets[2]};

    const std::size_t start = octets[0] == kSd2 ? 4 : 1;
    const Bytes body = octets.subspan(start, octets.size() - start - 2);
    const std::uint8_t fcs = octets[octets.size() - 2];
    if (octets.back() != kEd) return Failure{fmt::format("it ends with {:02X} instead of 16", octets.back())};
    if (fcs != sum(body)) return Failure{fmt::format("FCS is {:02X} instead of {:02X}", fcs, sum(body))};

    Frame frame{.kind = octets[0] == kSd1   ? FrameKind::no_data
                        : octets[0] == kSd2 ? FrameKind::variable
                                            : FrameKind::fixed,
                .da = body[0],
                .sa = body[1],
                .fc = body[2],
                .data = Octets(body.begin() + 3, body.end())};
    if (!take_sap(frame.da, frame.data, frame.dsap) || !take_sap(frame.sa, frame.data, frame.ssap))
        return Failure{std::string{"the EXT bit announces a SAP that is not there"}};
    return frame;
}

std::string describe(const Frame& frame)
{
    if (frame.kind == FrameKind::short_ack) return "SC (short acknowledgement)";
    if (frame.kind == FrameKind::token) return fmt::format("token {} to {}", frame.sa, frame.da);
    const auto data = frame.data.empty() ? std::string{} : ": " + hex(frame.data);
    if ((frame.fc & 0x40) == 0)
        return fmt::format("reply {} to {}, {}{}", frame.sa, frame.da, reply_name(frame.fc), data);
    if ((frame.fc & 0x0F) == 9) return fmt::format("FDL status request {} to {}", frame.sa, frame.da);
    return fmt::format("{} request {} to {}{}", service_name(frame), frame.sa, frame.da, data);
}

} // namespace dpslave::sim
