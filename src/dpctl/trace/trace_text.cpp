// SPDX-License-Identifier: Apache-2.0
#include "trace_text.hpp"

#include "dpctl/cli/words.hpp"
#include "dpctl/decode/decode.hpp"

#include "dpslave/base/letters.hpp"

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
        case What::reply: return "reply";
        case What::unanswered: return "unanswered";
        case What::rate: return "rate";
        case What::lost: return "lost";
    }
    return "?";
}

std::string why_in_words(fdl::Unanswered::Why why)
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
                    .service = entry.flaw ? fmt::format("no telegram: {}", fdl::text(*entry.flaw))
                                          : std::string{"no telegram"}};
        case What::unanswered:
            return {.from = entry.address, .to = {}, .service = "no reply: " + why_in_words(entry.why)};
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
    if (entry.what == What::piece) packet.comments.push_back(words.service);
    if (entry.what == What::unanswered)
        packet.comments.push_back(fmt::format("{}: {}", entry.address, words.service));
    return packet;
}

} // namespace dpslave::dpctl
