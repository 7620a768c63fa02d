// SPDX-License-Identifier: Apache-2.0
#include "line_entry.hpp"

#include "drive_words.hpp"

#include "dpslave/base/letters.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

using Said = LineEntry::What;
using drive::Judgement;
using drive::LineProtocol;

std::string_view said_name(Said said)
{
    switch (said) {
        case Said::question: return "question";
        case Said::answer: return "answer";
        case Said::silence: return "silence";
        case Said::lost: break;
    }
    return "lost";
}

/// As the configuration has it: "01" of EI-ASCII, "1" of Modbus.
std::string drive_text(const LineEntry& entry)
{
    if (entry.protocol == LineProtocol::modbus_rtu) return std::to_string(entry.drive);
    return fmt::format("{:X}{:X}", entry.drive >> 4U, entry.drive & 0xFU);
}

/// It is put together as a frame, though its checksum may be wrong.
bool has_form(const LineEntry& entry)
{
    return entry.judgement != Judgement::bad_character && entry.judgement != Judgement::truncated &&
           entry.judgement != Judgement::no_frame && entry.judgement != Judgement::noise_before;
}

DriveWords frame_words(const LineEntry& entry)
{
    const bool is_question = entry.what == Said::question || entry.judgement == Judgement::echo;
    if (!has_form(entry)) return {};
    return entry.protocol == LineProtocol::modbus_rtu ? modbus_words(entry.octets, is_question)
                                                      : ei_ascii_words(entry.octets);
}

std::optional<std::uint8_t> hex_digit(std::uint8_t octet)
{
    if (octet >= '0' && octet <= '9') return static_cast<std::uint8_t>(octet - '0');
    if (octet >= 'A' && octet <= 'F') return static_cast<std::uint8_t>(octet - 'A' + 10);
    return std::nullopt;
}

/// Whom a question asks: in EI-ASCII behind EOT, each digit twice; in Modbus the first octet.
std::optional<std::uint8_t> asked_by(Bytes question, LineProtocol protocol)
{
    if (protocol == LineProtocol::modbus_rtu)
        return question.empty() ? std::nullopt : std::optional{question[0]};
    if (question.size() < 5) return std::nullopt;
    const auto group = hex_digit(question[1]), unit = hex_digit(question[3]);
    return group && unit ? std::optional{static_cast<std::uint8_t>(*group << 4U | *unit)} : std::nullopt;
}

std::optional<Judgement> judgement_called(const std::vector<std::string>& comments)
{
    for (std::size_t i = 0; i < drive::kJudgements; ++i)
        if (std::find(comments.begin(), comments.end(), drive::text(static_cast<Judgement>(i))) !=
            comments.end())
            return static_cast<Judgement>(i);
    return std::nullopt;
}

} // namespace

std::optional<std::string> line_called(const pcapng::Interface& interface)
{
    constexpr std::string_view kDrive = "drive ";
    const bool is_line = interface.link_type == static_cast<std::uint16_t>(pcapng::LinkType::user1) ||
                         interface.link_type == static_cast<std::uint16_t>(pcapng::LinkType::user2);
    if (!is_line) return std::nullopt;
    const std::string& name = interface.name;
    return name.starts_with(kDrive) ? name.substr(kDrive.size()) : name;
}

std::optional<LineEntry> line_entry_of(const pcapng::Packet& packet, const pcapng::Interface& interface,
                                       std::uint8_t asked)
{
    const auto line = line_called(interface);
    if (!line || packet.direction == pcapng::Direction::unknown) return std::nullopt;
    LineEntry entry;
    entry.line = *line;
    entry.protocol = interface.link_type == static_cast<std::uint16_t>(pcapng::LinkType::user2)
                         ? LineProtocol::modbus_rtu
                         : LineProtocol::ei_ascii;
    entry.drive = asked;
    entry.octets = packet.octets;
    if (packet.direction == pcapng::Direction::outbound) {
        entry.drive = asked_by(entry.octets, entry.protocol).value_or(asked);
        return entry;
    }
    if (packet.octets.empty()) {
        entry.what = Said::silence;
        return entry;
    }
    entry.what = Said::answer;
    const auto judgement = judgement_called(packet.comments);
    entry.is_judged = judgement.has_value();
    entry.judgement = judgement.value_or(packet.checksum_error ? Judgement::bad_checksum : Judgement::taken);
    return entry;
}

std::optional<LineEntry> line_entry_of(const trace::Record& record, const std::string& line)
{
    const trace::Head& head = record.head;
    const bool is_one = head.kind == trace::Kind::asked || head.kind == trace::Kind::answered ||
                        head.kind == trace::Kind::no_answer;
    if (!is_one || head.rate >= drive::kLineProtocols || head.detail >= drive::kJudgements)
        return std::nullopt;
    LineEntry entry;
    entry.what = head.kind == trace::Kind::asked      ? Said::question
                 : head.kind == trace::Kind::answered ? Said::answer
                                                      : Said::silence;
    entry.line = line;
    entry.protocol = static_cast<LineProtocol>(head.rate);
    entry.drive = head.address;
    entry.judgement = entry.what == Said::answer ? static_cast<Judgement>(head.detail) : Judgement::taken;
    entry.first = head.begun;
    entry.last = head.at;
    const Bytes octets = record.octets;
    entry.octets.assign(octets.begin(), octets.end());
    return entry;
}

LineEntry gap_before(const LineEntry& next, std::uint64_t count)
{
    LineEntry entry = next;
    entry.what = Said::lost;
    entry.last = entry.first;
    entry.octets.clear();
    entry.count = count;
    return entry;
}

std::string words_of(const LineEntry& entry)
{
    if (entry.what == Said::silence) return "no answer";
    if (entry.what == Said::lost) return fmt::format("{} records were lost here", entry.count);
    const DriveWords frame = frame_words(entry);
    std::string words = frame.words;
    if (!frame.check.empty() && entry.is_judged)
        words += fmt::format(", {} {}", frame.check,
                             entry.judgement == Judgement::bad_checksum ? "wrong" : "right");
    if (entry.what == Said::question || !entry.is_judged) return words;
    return words + (words.empty() ? "" : ": ") + std::string{drive::text(entry.judgement)};
}

bool passes(const TraceFilter& filter, const LineEntry& entry, const std::string& words)
{
    if (entry.what == Said::lost) return true;
    const bool is_good =
        entry.what == Said::question || (entry.what == Said::answer && drive::is_good(entry.judgement));
    if (filter.bad && is_good) return false;
    return contains_any_case(words, filter.service);
}

std::string line_of(const LineEntry& entry, const std::string& words, UnixOffset offset,
                    std::optional<Instant> before)
{
    const bool is_sent = entry.what == Said::question;
    std::string line = fmt::format("{} {} {:<3} {}", time_columns(entry.first, offset, before),
                                   is_sent ? '>' : '<', drive_text(entry), words);
    if (!entry.octets.empty()) line += fmt::format("  [{}] {}", entry.octets.size(), hex(entry.octets));
    return line;
}

Json json_of(const LineEntry& entry, const std::string& words, UnixOffset offset)
{
    Json json{{"what", said_name(entry.what)},
              {"line", entry.line},
              {"protocol", entry.protocol == LineProtocol::modbus_rtu ? "modbus-rtu" : "ei-ascii"},
              {"drive", drive_text(entry)},
              {"first_ns", unix_ns(entry.first, offset)},
              {"last_ns", unix_ns(entry.last, offset)},
              {"words", words},
              {"judgement", nullptr},
              {"octets", hex(entry.octets)},
              {"lost", entry.count}};
    if (entry.what == Said::answer && entry.is_judged) json["judgement"] = drive::name(entry.judgement);
    return json;
}

pcapng::LinkType link_type_of(LineProtocol protocol)
{
    return protocol == LineProtocol::modbus_rtu ? pcapng::LinkType::user2 : pcapng::LinkType::user1;
}

std::optional<pcapng::Packet> packet_of(const LineEntry& entry, UnixOffset offset)
{
    if (entry.what == Said::lost) return std::nullopt;
    pcapng::Packet packet;
    packet.unix_ns = unix_ns(entry.first, offset);
    packet.direction =
        entry.what == Said::question ? pcapng::Direction::outbound : pcapng::Direction::inbound;
    packet.checksum_error = !has_form(entry) || entry.judgement == Judgement::bad_checksum;
    packet.character_error = entry.judgement == Judgement::bad_character;
    packet.octets = entry.octets;
    if (entry.what == Said::silence)
        packet.comments.push_back(fmt::format("{}: {}", drive_text(entry), words_of(entry)));
    if (entry.what == Said::answer && entry.is_judged)
        packet.comments.emplace_back(drive::text(entry.judgement));
    return packet;
}

} // namespace dpslave::dpctl
