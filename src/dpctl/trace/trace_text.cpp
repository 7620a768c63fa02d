// SPDX-License-Identifier: Apache-2.0
#include "trace_text.hpp"

#include "dpctl/cli/words.hpp"
#include "dpctl/decode/decode.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/number.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

using trace::Entry;
using What = Entry::What;

std::string address_text(std::optional<std::uint8_t> address)
{
    return address ? std::to_string(*address) : std::string{"-"};
}

std::string_view name_of(What what)
{
    switch (what) {
        case What::telegram: return "telegram";
        case What::piece: return "piece";
        case What::cut: return "cut";
        case What::reply: return "reply";
        case What::unanswered: return "unanswered";
        case What::rate: return "rate";
        case What::lost: return "lost";
    }
    return "?";
}

std::string_view why_in_words(fdl::Unanswered::Why why)
{
    using Why = fdl::Unanswered::Why;
    switch (why) {
        case Why::overtaken: return "something followed the request";
        case Why::late: return "its time was over before the reply could begin";
        case Why::own_address: return "the request carries this address as sender: address conflict";
        case Why::no_service: return "no slave answers this function code";
        case Why::searching: return "the rate is not confirmed yet";
        case Why::unsent: return "the port or the driver enable did not send the reply";
    }
    return "?";
}

TraceWords words_of_telegram(const Entry& entry)
{
    const auto telegram = telegram_of(entry);
    if (!telegram) return {.from = {}, .to = {}, .service = "no telegram"};
    if (telegram->delimiter == fdl::kSC) return {.from = {}, .to = {}, .service = "SC"};
    if (telegram->delimiter == fdl::kSD4)
        return {.from = telegram->sa, .to = telegram->da, .service = "token"};
    return {.from = telegram->sa, .to = telegram->da, .service = service_name(*telegram)};
}

constexpr std::string_view kNoTelegram = "no telegram",
                           kNoReply = "no reply: ", kCut = "cut: the rest of this telegram was not recorded";

/// What a comment of packet_of() says of the entry; nothing: it is none of them.
std::optional<Entry> entry_said_by(std::string_view comment, Entry entry)
{
    if (comment == kCut) {
        entry.what = What::cut;
        return entry;
    }
    if (comment.starts_with(kNoTelegram)) {
        entry.what = What::piece;
        for (std::size_t i = 0; i < fdl::kFlaws; ++i)
            if (comment == fmt::format("{}: {}", kNoTelegram, fdl::text(static_cast<fdl::Flaw>(i))))
                entry.flaw = static_cast<fdl::Flaw>(i);
        return entry.flaw || comment == kNoTelegram ? std::optional{entry} : std::nullopt;
    }
    const std::size_t colon = comment.find(": ");
    const auto address = read_number(comment.substr(0, colon), 0, 127);
    if (colon == std::string_view::npos || !address) return std::nullopt;
    for (std::size_t i = 0; i < fdl::kUnansweredReasons; ++i) {
        const auto why = static_cast<fdl::Unanswered::Why>(i);
        if (comment.substr(colon + 2) != fmt::format("{}{}", kNoReply, why_in_words(why))) continue;
        entry.what = What::unanswered;
        entry.why = why;
        entry.address = static_cast<std::uint8_t>(*address);
        return entry;
    }
    return std::nullopt;
}

} // namespace

std::optional<fdl::Telegram> telegram_of(const Entry& entry)
{
    const auto length = fdl::frame_length(entry.octets);
    if (entry.octets.empty() || !length || *length != entry.octets.size()) return std::nullopt;
    const auto telegram = fdl::decode(entry.octets);
    return telegram ? std::optional{*telegram} : std::nullopt;
}

std::int64_t unix_ns(Instant at, UnixOffset offset)
{
    return (at.time_since_epoch() + offset).count();
}

std::string time_columns(Instant first, UnixOffset offset, std::optional<Instant> before)
{
    using Clock = std::chrono::system_clock;
    const Clock::time_point at{
        std::chrono::duration_cast<Clock::duration>(first.time_since_epoch() + offset)};
    const double since = before ? std::chrono::duration<double>(std::max(first - *before, {})).count() : 0.0;
    return fmt::format("{} {:>+10.6f}", time_of_day(at, 6), since);
}

TraceWords words_of(const Entry& entry)
{
    switch (entry.what) {
        case What::telegram:
        case What::reply: return words_of_telegram(entry);
        case What::piece:
            return {.from = {},
                    .to = {},
                    .service = entry.flaw ? fmt::format("{}: {}", kNoTelegram, fdl::text(*entry.flaw))
                                          : std::string{kNoTelegram}};
        case What::cut: return {.from = {}, .to = {}, .service = std::string{kCut}};
        case What::unanswered:
            return {.from = entry.address,
                    .to = {},
                    .service = fmt::format("{}{}", kNoReply, why_in_words(entry.why))};
        case What::rate:
            return {.from = {},
                    .to = {},
                    .service = fmt::format("the rate is {} bit/s", static_cast<std::uint32_t>(entry.baud))};
        case What::lost: break;
    }
    return {.from = {}, .to = {}, .service = fmt::format("{} records were lost here", entry.count)};
}

bool passes(const TraceFilter& filter, const Entry& entry, const TraceWords& words)
{
    if (entry.what == What::lost || entry.what == What::rate) return true;
    if (filter.bad && entry.what != What::piece && entry.what != What::unanswered) return false;
    if (filter.address && words.from != filter.address && words.to != filter.address) return false;
    return contains_any_case(words.service, filter.service);
}

std::string line_of(const Entry& entry, const TraceWords& words, UnixOffset offset,
                    std::optional<Instant> before)
{
    std::string line = fmt::format("{} {:>3} > {:<3} {}", time_columns(entry.first, offset, before),
                                   address_text(words.from), address_text(words.to), words.service);
    if (!entry.octets.empty()) line += fmt::format("  [{}] {}", entry.octets.size(), hex(entry.octets));
    return line;
}

Json json_of(const Entry& entry, const TraceWords& words, UnixOffset offset)
{
    Json json{{"what", name_of(entry.what)},
              {"at_ns", unix_ns(entry.at, offset)},
              {"first_ns", unix_ns(entry.first, offset)},
              {"last_ns", unix_ns(entry.last, offset)},
              {"uncertainty_ns", entry.uncertainty.count()},
              {"baud", static_cast<std::uint32_t>(entry.baud)},
              {"from", nullptr},
              {"to", nullptr},
              {"service", words.service},
              {"octets", hex(entry.octets)},
              {"bad_characters", entry.bad_characters},
              {"flaw", nullptr},
              {"lost", entry.count}};
    if (words.from) json["from"] = *words.from;
    if (words.to) json["to"] = *words.to;
    if (entry.what == What::piece && entry.flaw) json["flaw"] = fdl::text(*entry.flaw);
    if (entry.what == What::unanswered) json["flaw"] = fdl::text(entry.why);
    return json;
}

std::optional<pcapng::Packet> packet_of(const Entry& entry, const TraceWords& words, UnixOffset offset)
{
    if (entry.what == What::lost || entry.what == What::rate) return std::nullopt;
    pcapng::Packet packet;
    packet.unix_ns = unix_ns(entry.first, offset);
    packet.direction = entry.what == What::reply ? pcapng::Direction::outbound : pcapng::Direction::inbound;
    packet.checksum_error = entry.what == What::piece;
    packet.character_error = entry.bad_characters != 0;
    packet.octets = entry.octets;
    if (entry.what == What::piece || entry.what == What::cut) packet.comments.push_back(words.service);
    if (entry.what == What::unanswered)
        packet.comments.push_back(fmt::format("{}: {}", entry.address, words.service));
    return packet;
}

std::optional<trace::Entry> entry_of(const pcapng::Packet& packet)
{
    Entry entry;
    entry.octets = packet.octets;
    entry.bad_characters = packet.character_error ? 1 : 0;
    for (const std::string& comment : packet.comments)
        if (auto ours = entry_said_by(comment, entry)) return ours;
    if (packet.octets.empty()) return std::nullopt;
    entry.what = packet.direction == pcapng::Direction::outbound ? What::reply : What::telegram;
    return entry.what == What::reply || telegram_of(entry) ? std::optional{entry} : std::nullopt;
}

std::string_view note_of(const pcapng::Packet& packet)
{
    for (const std::string& comment : packet.comments)
        if (!entry_said_by(comment, {})) return comment;
    return {};
}

} // namespace dpslave::dpctl
