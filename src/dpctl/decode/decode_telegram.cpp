// SPDX-License-Identifier: Apache-2.0
// Layer 2: delimiters, addresses, FC, SAPs; and the services that need few words.
#include "decode.hpp"

#include "dpslave/dp/sap.hpp"

#include <fmt/format.h>

#include <array>

namespace dpslave::dpctl {
namespace {

using fdl::Flaw;
using fdl::Telegram;

/// Those of a DP slave and its neighbours (wire reference 4.1).
struct Sap {
    std::uint8_t number;
    std::string_view name;
};
constexpr std::array kSaps = std::to_array<Sap>({
    {48, "MS2 connection (DP-V1)"},
    {49, "MS2 resource manager (DP-V1)"},
    {50, "MS1 alarm acknowledge (DP-V1)"},
    {51, "MS1 read and write (DP-V1)"},
    {53, "Set_Ext_Prm (DP-V2)"},
    {54, "master to master"},
    {dp::sap::kSetSlaveAdd, "Set_Slave_Add"},
    {dp::sap::kRdInp, "RD_Inp"},
    {dp::sap::kRdOutp, "RD_Outp"},
    {dp::sap::kGlobalControl, "Global_Control"},
    {dp::sap::kGetCfg, "Get_Cfg"},
    {dp::sap::kSlaveDiag, "Slave_Diag"},
    {dp::sap::kSetPrm, "Set_Prm"},
    {dp::sap::kChkCfg, "Chk_Cfg"},
});

/// Wire reference 2.3 and 2.4.
constexpr std::array<std::string_view, 16> kRequests = {"time event",
                                                        "reserved",
                                                        "reserved",
                                                        "SDA low: send data with acknowledge",
                                                        "SDN low: send data, no acknowledge",
                                                        "SDA high: send data with acknowledge",
                                                        "SDN high: send data, no acknowledge",
                                                        "MSRD: send and request data, multicast reply",
                                                        "reserved",
                                                        "FDL status",
                                                        "reserved",
                                                        "reserved",
                                                        "SRD low: send and request data",
                                                        "SRD high: send and request data",
                                                        "ident",
                                                        "LSAP status"};
constexpr std::array<std::string_view, 16> kReplies = {
    "OK: acknowledged",
    "UE: user error",
    "RR: no resource for the data",
    "RS: service or SAP not activated",
    "reserved",
    "reserved",
    "reserved",
    "reserved",
    "DL: data, low priority",
    "NR: no data to return",
    "DH: data, high priority (in Data_Exchange: a diagnosis waits)",
    "reserved",
    "RDL: data, low priority; what was sent was not taken",
    "RDH: data, high priority; what was sent was not taken",
    "reserved",
    "reserved"};
constexpr std::array<std::string_view, 4> kStationTypes = {
    "of a slave", "of a master that is not ready for the ring", "of a master that is ready for the ring",
    "of a master in the ring"};

std::string sap_words(std::optional<std::uint8_t> sap)
{
    if (!sap) return "default";
    for (const Sap& row : kSaps)
        if (row.number == *sap) return fmt::format("{} {}", *sap, row.name);
    return std::to_string(*sap);
}

/// Only the slave's SAP names a service.
std::string masters_sap(std::optional<std::uint8_t> sap)
{
    return sap ? fmt::format("{} of the master", *sap) : std::string{"default"};
}

std::string_view delimiter_name(std::uint8_t delimiter)
{
    switch (delimiter) {
        case fdl::kSD1: return "SD1";
        case fdl::kSD2: return "SD2";
        case fdl::kSD3: return "SD3";
        case fdl::kSD4: return "SD4";
        case fdl::kSC: return "SC";
        default: return "?";
    }
}

std::string fc_words(const Telegram& telegram)
{
    const unsigned function = telegram.fc & 0x0FU;
    if (!telegram.is_request())
        return fmt::format("{:02X}: reply {}, {}", telegram.fc, kStationTypes[(telegram.fc >> 4) & 3U],
                           kReplies[function]);
    return fmt::format("{:02X}: request, {}; FCB {}, FCV {}", telegram.fc, kRequests[function],
                       telegram.fcb() ? 1 : 0, telegram.fcv() ? 1 : 0);
}

std::string address_words(std::uint8_t address)
{
    if (address == fdl::kBroadcast) return "127: all stations";
    return address == 126 ? "126: a station without an address of its own" : std::to_string(address);
}

/// The SAP that names the service: the slave's own, in both directions.
std::optional<std::uint8_t> service_sap(const Telegram& telegram)
{
    return telegram.is_request() ? telegram.dsap : telegram.ssap;
}

void add_octet(Decoded& into, std::size_t octet, std::uint8_t value, std::string meaning)
{
    into.octets.push_back({octet, value, std::move(meaning)});
}

void decode_global_control(Bytes data, Decoded& into)
{
    if (data.size() != 2) {
        into.faults.push_back(
            fmt::format("Global_Control has 2 octets, here are {}: slaves ignore it", data.size()));
        return;
    }
    constexpr std::array kCommands =
        std::to_array<Sap>({{1, "Clear_Data"}, {2, "Unfreeze"}, {3, "Freeze"}, {4, "Unsync"}, {5, "Sync"}});
    std::string commands;
    for (const Sap& row : kCommands)
        if (((data[0] >> row.number) & 1) != 0)
            commands += fmt::format("{}{}", commands.empty() ? "" : ", ", row.name);
    add_octet(into, 1, data[0], "Control_Command: " + (commands.empty() ? "Operate (no bit set)" : commands));
    add_octet(into, 2, data[1],
              "Group_Select: " +
                  (data[1] == 0 ? std::string{"all slaves"} : "groups " + group_list(data[1])));
    if ((data[0] & 0xC1) != 0) into.faults.push_back("Control_Command has a reserved bit set");
}

void decode_set_slave_add(Bytes data, Decoded& into)
{
    if (data.size() < 4) {
        into.faults.push_back(fmt::format("Set_Slave_Add has at least 4 octets, here are {}", data.size()));
        return;
    }
    add_octet(into, 1, data[0], fmt::format("new address {}", data[0]));
    add_octet(into, 2, data[1], "Ident_Number, high octet");
    add_octet(into, 3, data[2], fmt::format("Ident_Number, low octet: 0x{:04X}", be16(data, 1)));
    add_octet(into, 4, data[3],
              data[3] == 0 ? "the address may be changed again" : "No_Add_Chg: it cannot be changed again");
    for (std::size_t i = 4; i < data.size(); ++i) add_octet(into, i + 1, data[i], "Rem_Slave_Data");
    if (data[0] > 125) into.faults.push_back(fmt::format("the new address {} is above 125", data[0]));
}

/// Requests that have no data.
void wants_no_data(Bytes data, const char* service, Decoded& into)
{
    if (!data.empty())
        into.faults.push_back(
            fmt::format("a request {} has no data, here are {} octets", service, data.size()));
}

void add_data_line(Bytes data, const char* name, Decoded& into)
{
    if (!data.empty()) into.lines.push_back({name, fmt::format("{} ({} octets)", hex(data), data.size())});
}

void decode_request(const Telegram& telegram, DecodeContext& context, Decoded& into)
{
    const Bytes data = telegram.data;
    switch (telegram.dsap.value_or(0)) {
        case dp::sap::kSetSlaveAdd: return decode_set_slave_add(data, into);
        case dp::sap::kRdInp: return wants_no_data(data, "RD_Inp", into);
        case dp::sap::kRdOutp: return wants_no_data(data, "RD_Outp", into);
        case dp::sap::kGlobalControl: return decode_global_control(data, into);
        case dp::sap::kGetCfg: return wants_no_data(data, "Get_Cfg", into);
        case dp::sap::kSlaveDiag: return wants_no_data(data, "Slave_Diag", into);
        case dp::sap::kSetPrm: return decode_set_prm(data, context, into);
        case dp::sap::kChkCfg: return decode_cfg(data, context, true, into);
        default:
            if (telegram.dsap || !decode_exchange(data, true, context, into))
                add_data_line(data, telegram.dsap ? "data" : "outputs", into);
    }
}

void decode_reply(const Telegram& telegram, DecodeContext& context, Decoded& into)
{
    const Bytes data = telegram.data;
    switch (telegram.ssap.value_or(0)) {
        case dp::sap::kRdInp: return add_data_line(data, "inputs", into);
        case dp::sap::kRdOutp: return add_data_line(data, "outputs", into);
        case dp::sap::kGetCfg: return decode_cfg(data, context, false, into);
        case dp::sap::kSlaveDiag: return decode_diagnosis(data, context, into);
        default:
            if (telegram.ssap || !decode_exchange(data, false, context, into))
                add_data_line(data, telegram.ssap ? "data" : "inputs", into);
    }
}

/// Function codes that the table of the standard has (wire reference 2.3 and 2.4).
bool is_known_function(const Telegram& telegram)
{
    const std::string_view words =
        telegram.is_request() ? kRequests[telegram.fc & 0x0FU] : kReplies[telegram.fc & 0x0FU];
    return words != "reserved";
}

void check_fc(const Telegram& telegram, Decoded& into)
{
    if ((telegram.fc & 0x80) != 0)
        into.faults.push_back(fmt::format(
            "bit 7 of FC 0x{:02X} is set: no DP telegram has it, a slave is silent", telegram.fc));
    if (!is_known_function(telegram))
        into.faults.push_back(
            fmt::format("the function code {} of FC 0x{:02X} is reserved", telegram.fc & 0x0FU, telegram.fc));
}

void check_addresses(const Telegram& telegram, Decoded& into)
{
    if (telegram.sa == telegram.da)
        into.faults.push_back(
            fmt::format("sender and receiver are both {}: no station talks to itself", telegram.sa));
    if (telegram.da == fdl::kBroadcast && telegram.is_request() &&
        telegram.function() != fdl::Function::sdn_low && telegram.function() != fdl::Function::sdn_high)
        into.faults.push_back("127 is only for telegrams without an answer (SDN)");
    if (telegram.da == fdl::kBroadcast && !telegram.is_request())
        into.faults.push_back("no reply goes to all");
    if (telegram.dsap.has_value() != telegram.ssap.has_value())
        into.faults.push_back("only one of DSAP and SSAP is there: a DP slave answers RS");
    const auto own = service_sap(telegram);
    const auto masters = telegram.is_request() ? telegram.ssap : telegram.dsap;
    if (own && masters && *own >= dp::sap::kSetSlaveAdd && *masters != dp::sap::kMaster)
        into.faults.push_back(fmt::format(
            "the master's SAP of this service is 62, here is {}: a DP slave answers RS", *masters));
}

void describe(const Telegram& telegram, DecodeContext& context, Decoded& into)
{
    const std::string_view delimiter = delimiter_name(telegram.delimiter);
    if (telegram.delimiter == fdl::kSC) {
        into.kind = "SC: short acknowledge: accepted, nothing to return";
        return;
    }
    if (telegram.delimiter == fdl::kSD4) {
        into.kind = fmt::format("SD4: token from master {} to master {}", telegram.sa, telegram.da);
        if (telegram.sa > 126 || telegram.da > 126) into.faults.push_back("a token has addresses 0 to 126");
        return;
    }
    into.kind = fmt::format("{}: {}", delimiter, service_name(telegram));
    into.lines.push_back({"from, to", fmt::format("{} to {}", telegram.sa, address_words(telegram.da))});
    into.lines.push_back({"FC", fc_words(telegram)});
    if (telegram.dsap || telegram.ssap)
        into.lines.push_back(
            {"DSAP, SSAP", telegram.is_request()
                               ? sap_words(telegram.dsap) + ", " + masters_sap(telegram.ssap)
                               : masters_sap(telegram.dsap) + ", " + sap_words(telegram.ssap)});
    decode_service(telegram, context, into);
}

std::uint8_t sum_of(Bytes octets)
{
    unsigned sum = 0;
    for (const std::uint8_t octet : octets) sum += octet;
    return static_cast<std::uint8_t>(sum & 0xFF);
}

/// The frame with the right FCS and end delimiter; what was wrong with them becomes a fault.
std::vector<std::uint8_t> mended(Bytes frame, Decoded& into)
{
    std::vector<std::uint8_t> copy(frame.begin(), frame.end());
    if (frame[0] == fdl::kSC || frame[0] == fdl::kSD4) return copy;
    const std::size_t body = frame[0] == fdl::kSD2 ? 4 : 1;
    std::uint8_t& fcs = copy[copy.size() - 2];
    const std::uint8_t right = sum_of(frame.subspan(body, frame.size() - body - 2));
    if (fcs != right)
        into.faults.push_back(fmt::format("FCS is 0x{:02X} and should be 0x{:02X}", fcs, right));
    if (copy.back() != fdl::kED)
        into.faults.push_back(
            fmt::format("the last octet is 0x{:02X} and should be the end delimiter 0x16", copy.back()));
    fcs = right;
    copy.back() = fdl::kED;
    return copy;
}

std::string flaw_words(Flaw flaw, Bytes frame)
{
    switch (flaw) {
        case Flaw::start_delimiter:
            return fmt::format("0x{:02X} begins no telegram: 10, 68, A2, DC or E5 do", frame[0]);
        case Flaw::length_mismatch:
            return fmt::format(
                "LE is 0x{:02X}, LEr 0x{:02X}, the fourth octet 0x{:02X}: LE and LEr must be equal and 0x68 must follow",
                frame[1], frame[2], frame[3]);
        case Flaw::length_range: return fmt::format("LE is {}: 4 to 249 are legal", frame[1]);
        case Flaw::missing_sap: return "an address announces a SAP, but no octet is left for it";
        case Flaw::extension:
            return "a SAP octet is above 63: DP has no region, segment or further extension";
        case Flaw::source_address: return "127 cannot be a sender";
        default: return std::string{fdl::text(flaw)};
    }
}

} // namespace

std::string service_name(const Telegram& telegram)
{
    const bool asks_data =
        telegram.function() == fdl::Function::srd_low || telegram.function() == fdl::Function::srd_high;
    if (telegram.is_request() && !asks_data && !telegram.dsap)
        return fmt::format("request, {}", kRequests[telegram.fc & 0x0FU]);
    const auto sap = service_sap(telegram);
    const std::string_view side = telegram.is_request() ? "" : ", reply";
    if (!sap) {
        if (telegram.delimiter == fdl::kSD1)
            return telegram.is_request() ? "Data_Exchange without data" : "acknowledgement without data";
        return fmt::format("Data_Exchange{}", side);
    }
    for (const Sap& row : kSaps)
        if (row.number == *sap) return fmt::format("{}{}", row.name, side);
    return fmt::format("SAP {}{}", *sap, side);
}

std::vector<std::string> service_names()
{
    std::vector<std::string> names{"Data_Exchange", "Data_Exchange without data",
                                   "acknowledgement without data"};
    for (const Sap& row : kSaps) names.emplace_back(row.name);
    for (const std::string_view request : kRequests) names.push_back(fmt::format("request, {}", request));
    return names;
}

void decode_service(const Telegram& telegram, DecodeContext& context, Decoded& into)
{
    check_fc(telegram, into);
    check_addresses(telegram, into);
    if (telegram.is_request())
        decode_request(telegram, context, into);
    else
        decode_reply(telegram, context, into);
}

Decoded decode_telegram(Bytes frame, DecodeContext& context)
{
    Decoded decoded;
    decoded.hex = hex(frame);
    decoded.kind = fmt::format("{}: no telegram", delimiter_name(frame[0]));
    const auto length = fdl::frame_length(frame);
    if (!length) {
        decoded.faults.push_back(flaw_words(length.error(), frame));
        return decoded;
    }
    if (*length == 0 || frame.size() < *length) {
        decoded.faults.push_back(
            *length == 0 ? fmt::format("it ends after {} octets: LE, LEr and 0x68 are missing", frame.size())
                         : fmt::format("it has {} octets and should have {}", frame.size(), *length));
        return decoded;
    }
    const std::vector<std::uint8_t> right = mended(frame, decoded);
    const auto telegram = fdl::decode(right);
    if (telegram)
        describe(*telegram, context, decoded);
    else
        decoded.faults.push_back(flaw_words(telegram.error(), frame));
    return decoded;
}

} // namespace dpslave::dpctl
