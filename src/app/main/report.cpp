// SPDX-License-Identifier: Apache-2.0
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::app {

using nlohmann::json;

namespace {

double milliseconds(std::chrono::nanoseconds time)
{
    return std::chrono::duration<double, std::milli>(time).count();
}

/// How long ago `then` was; null for "never".
json age_json(Instant then, Instant now)
{
    if (then == Instant{}) return nullptr;
    return milliseconds(now - then);
}

json optional_json(const std::optional<std::string>& value)
{
    return value ? json(*value) : json(nullptr);
}

std::string_view link_text(const Station& station)
{
    if (!station.line_open) return "silent";
    if (!station.drive.known) return "unknown";
    return station.drive.answers ? "answers" : "silent";
}

std::string_view text(WordState state)
{
    switch (state) {
        case WordState::untried: return "untried";
        case WordState::good: return "good";
        case WordState::stale: return "stale";
        case WordState::invalid_tag: return "invalid tag";
        case WordState::read_only: return "read only";
        case WordState::out_of_range: return "out of range";
        case WordState::refused: return "refused";
        case WordState::unscaled: return "unscaled";
    }
    return "?";
}

json drive_json(const Station& station)
{
    const drive::UnitSnapshot& drive = station.drive;
    return {{"line", station.line->name},
            {"port", station.line->port},
            {"protocol", station.line->protocol},
            {"unit", station.config->unit_text},
            {"link", link_text(station)},
            {"port_open", station.line_open},
            {"ever_answered", station.ever_answered},
            {"baud", station.line->baud},
            {"format", format_text(station.line->format)},
            {"timeout_ms", station.line->timeout.count()},
            {"cycle_ms", drive.cycle.count() > 0 ? json(milliseconds(drive.cycle)) : json(nullptr)},
            {"reads", drive.reads},
            {"writes", drive.writes},
            {"silences", drive.silences},
            {"refusals", drive.refusals},
            {"losses", drive.losses},
            {"last_trouble",
             station.troubles.empty() ? json(nullptr) : json(station.troubles.back().text.data())}};
}

/// Null: the outputs do not outlive a master. `ends_in_ms` null: they do for ever.
json ride_json(const Station& station, Instant now)
{
    const auto ends = station.drive.ride_ends;
    if (!ends) return nullptr;
    return {{"ends_in_ms", *ends == kNever ? json(nullptr) : json(milliseconds(std::max(*ends, now) - now))}};
}

json unanswered_json(const View& view, Instant now)
{
    json all = json::array();
    for (const fdl::UnansweredAddress& one : view.bus.unanswered)
        if (one.requests != 0)
            all.push_back({{"address", one.address},
                           {"master", one.master},
                           {"requests", one.requests},
                           {"age_ms", milliseconds(now - one.last)}});
    return all;
}

/// The four registers of Demand Data in words: commands 1 and 2 have the tag in register 1, 3 and 4 in
/// register 2 (2408f/2404f handbook ch. 7).
std::string demand_words(const config::StationConfig& station, const std::array<std::uint16_t, 4>& request,
                         const std::array<std::uint16_t, 4>& reply)
{
    const unsigned command = request[0] >> 12;
    if (command == 0) return "no command";
    const bool extended =
        station.personality->demand == dp::DemandForm::extended && (command == 3 || command == 4);
    const auto tag = static_cast<std::uint16_t>(extended ? request[1] : request[0] & 0x07FF);
    const bool reads = command == 1 || (extended && command == 3);
    const bool writes = command == 2 || (extended && command == 4);
    const auto value = [&](std::uint16_t word) { return shown_value(*station.tags, tag, word); };
    const std::string asked = reads    ? fmt::format("read tag {}", tag)
                              : writes ? fmt::format("write {} to tag {}", value(request[3]), tag)
                                       : fmt::format("command {} with tag {}", command, tag);
    const std::string none_yet = asked + ": not answered yet";
    const unsigned answer = reply[0] >> 12;
    const unsigned echo = extended ? reply[1] : reply[0] & 0x07FF;
    if (answer == 0 || echo != tag) return none_yet;
    // 7; or more, where the tag of worked example 2 runs into the command: 7000 + 2088 = 9088.
    if (answer >= 7) return fmt::format("{}: rejected with error code {}", asked, reply[3]);
    if (writes && reply[3] != request[3]) return none_yet;
    return fmt::format("{}: done, value {}", asked, value(reply[3]));
}

/// " or one of Run, Hold": what stands for a value of this tag, as far as it can be listed.
std::string names_of_values(const drive::Tag& tag)
{
    constexpr std::size_t most = 12;
    std::string names;
    std::size_t count = 0;
    for (const drive::Label& label : tag.labels) {
        if (label.is_bit) continue;
        if (++count > most) return names + " ...";
        names += (names.empty() ? " or one of " : ", ") + label.text;
    }
    return names;
}

/// "an INT", "a WORD".
std::string with_article(std::string_view type)
{
    const bool is_vowel =
        !type.empty() && std::string_view{"AEIOU"}.find(type.front()) != std::string_view::npos;
    return fmt::format("{} {}", is_vowel ? "an" : "a", type);
}

/// A master exchanges data with it. Held at the start it is in the state and exchanges nothing.
bool exchanges(const Station& station)
{
    return station.bus.state == dp::State::data_exch && !station.bus.holds;
}

std::ptrdiff_t exchanging(const View& view)
{
    return std::count_if(view.stations.begin(), view.stations.end(), exchanges);
}

/// As a controller shows it in its Comms list (C-007).
json comms_status(const Station& station)
{
    if (station.config->profile->leds != led::Language::controller) return nullptr;
    return station.bus.state == dp::State::data_exch ? "run" : "rdY";
}

} // namespace

std::string format_text(const config::LineFormat& format)
{
    return fmt::format("{}{}{}", format.data_bits, format.parity, format.stop_bits);
}

std::string shown_value(const drive::TagTable& tags, std::uint16_t tag, std::uint16_t word)
{
    const drive::Tag* row = tags.find(tag);
    return row != nullptr ? drive::displayed(*row, word) : fmt::format(">{:04X}", word);
}

std::string_view text(AccessError error) noexcept
{
    switch (error) {
        case AccessError::none: return "done";
        case AccessError::no_answer: return "the drive does not answer";
        case AccessError::deferred: return "an earlier answer of the drive is still awaited";
        case AccessError::not_understood: return "the drive did not understand the request";
        case AccessError::invalid_tag: return "invalid tag";
        case AccessError::read_only: return "read only";
        case AccessError::out_of_range: return "value under or over range";
        case AccessError::not_stopped: return "only while the drive is stopped";
        case AccessError::not_config_mode: return "only in configuration mode";
        case AccessError::unsupported_type: return "this type of parameter is not transported";
        case AccessError::value_not_encoded: return "the drive cannot read this value";
        case AccessError::no_scale: return "the drive answers with a number, and its decimals are not known";
        case AccessError::contradicted:
            return "the drive has answered with more decimals than the tag table gives";
        case AccessError::not_kept:
            return "the drive takes the value and then holds another one: read the tag";
    }
    return "?";
}

json bus_json(const View& view, Instant now)
{
    return {{"port", view.config->bus.port},
            {"baud", static_cast<std::uint32_t>(view.bus.baud)},
            {"baud_state", fdl::text(view.bus.baud_state)},
            {"configured_baud", view.config->bus.baud
                                    ? json(static_cast<std::uint32_t>(*view.config->bus.baud))
                                    : json(nullptr)},
            {"port_open", view.bus.port_open},
            {"driver_works", view.bus.driver_works},
            {"unanswered", unanswered_json(view, now)},
            {"stations", view.stations.size()},
            {"exchanging", exchanging(view)},
            {"last_telegram_age_ms", age_json(view.bus.last_telegram, now)}};
}

json station_json(const Station& station, Instant now)
{
    const dp::Snapshot& bus = station.bus;
    return {{"name", station.config->name},
            {"address", station.address},
            {"profile", station.config->profile->name},
            {"device", station.config->profile->device},
            {"state", dp::text(bus.state)},
            {"master", bus.master == 0xFF ? json(nullptr) : json(bus.master)},
            {"watchdog_ms", bus.watchdog_on ? json(bus.watchdog.count()) : json(nullptr)},
            {"min_tsdr", bus.min_tsdr.count},
            {"groups", bus.groups},
            {"sync", bus.sync},
            {"freeze", bus.freeze},
            {"clear", bus.clear},
            {"held", bus.holds},
            {"ride", ride_json(station, now)},
            {"silent_because", station.silent_because.empty() ? json(nullptr) : json(station.silent_because)},
            {"stat_diag", bus.stat_diag},
            {"diag_pending", bus.diag_pending},
            {"parameters", bus.layout.count},
            {"demand_data", bus.demand_data},
            {"left_count", bus.counters.left_data_exchange},
            {"left_because",
             bus.left_because == dp::LeaveReason::none ? json(nullptr) : json(dp::text(bus.left_because))},
            {"left_code",
             bus.left_because == dp::LeaveReason::none ? json(nullptr) : json(code(bus.left_because))},
            {"drive", drive_json(station)}};
}

json stations_json(const View& view, Instant now)
{
    json all = json::array();
    for (const Station& one : view.stations) all.push_back(station_json(one, now));
    return all;
}

json info_json(const Station& station, std::optional<std::uint8_t> pending,
               const std::vector<std::string>& notes)
{
    const config::StationConfig& config = *station.config;
    const profile::Profile& profile = *config.profile;
    const dp::Personality& personality = *config.personality;
    json bauds = json::array();
    json max_tsdr = json::array();
    for (std::size_t i = 0; i < kBauds.size(); ++i) {
        if (personality.max_tsdr[i].count == 0) continue;
        bauds.push_back(static_cast<std::uint32_t>(kBauds[i]));
        max_tsdr.push_back(personality.max_tsdr[i].count);
    }
    const std::size_t demand_octets = personality.demand == dp::DemandForm::none ? 0 : dp::kDemandOctets;
    std::size_t most_octets = demand_octets + 2 * personality.max_parameters;
    if (personality.max_words != 0) most_octets = std::min(most_octets, 2 * personality.max_words);
    return {
        {"name", config.name},
        {"profile", profile.name},
        {"device", profile.device},
        {"order_code", profile.order_code},
        {"firmware", profile.firmware},
        {"manual", profile.manual},
        {"ident", personality.ident},
        {"address_active", station.address},
        {"address_pending", pending ? json(*pending) : json(nullptr)},
        {"address_min", profile.min_address},
        {"address_max", profile.max_address},
        {"max_parameters", personality.max_parameters},
        {"max_input_octets", most_octets},
        {"max_output_octets", most_octets},
        {"max_diag_octets", personality.max_diag_length},
        {"demand_data", personality.demand != dp::DemandForm::none},
        {"sync", personality.sync},
        {"freeze", personality.freeze},
        {"bauds", bauds},
        {"max_tsdr", max_tsdr},
        {"tag_table", config.tag_file},
        {"tags_in_table", config.tags->all().size()},
        {"option_software", profile.option_software.empty() ? json(nullptr) : json(profile.option_software)},
        {"comms_status", comms_status(station)},
        {"resolution", profile.selectable_resolution ? json(config.integer_resolution ? "integer" : "full")
                                                     : json(nullptr)},
        {"notes", notes}};
}

json words_json(const Station& station, Instant now)
{
    const dp::Snapshot& bus = station.bus;
    const drive::UnitSnapshot& drive = station.drive;
    const bool same_layout = drive.generation == bus.layout.generation;
    std::size_t in_octet = bus.demand_data ? 8 : 0;
    std::size_t out_octet = in_octet;
    json words = json::array();
    const auto add = [&](std::size_t i, bool input) {
        const std::uint16_t tag = bus.layout.parameters[i].tag;
        const std::uint16_t raw = input ? bus.inputs[i] : bus.outputs[i];
        const drive::Tag* row = station.config->tags->find(tag);
        const bool is_contradicted = same_layout && drive.errors[i] == AccessError::contradicted;
        const std::string answer = same_layout ? drive.answer_texts[i].data() : "";
        std::size_t& octet = input ? in_octet : out_octet;
        words.push_back(
            {{"tag", tag},
             {"name", row != nullptr ? json(row->name) : json(nullptr)},
             {"direction", input ? "in" : "out"},
             {"octet", octet},
             {"raw", raw},
             {"value", shown_value(*station.config->tags, tag, raw)},
             {"state",
              is_contradicted ? "contradicted" : text(same_layout ? drive.states[i] : WordState::untried)},
             {"answer", answer.empty() ? json(nullptr) : json(answer)},
             {"age_ms", same_layout ? age_json(drive.updated_at[i], now) : json(nullptr)}});
        octet += 2;
    };
    for (std::size_t i = 0; i < bus.layout.count; ++i) {
        if (bus.layout.parameters[i].reads) add(i, true);
        if (bus.layout.parameters[i].writes) add(i, false);
    }
    return words;
}

json io_json(const Station& station, Instant now)
{
    const dp::Snapshot& bus = station.bus;
    json demand = nullptr;
    if (bus.demand_data)
        demand = {{"request", bus.demand_request},
                  {"reply", bus.demand_reply},
                  {"words", demand_words(*station.config, bus.demand_request, bus.demand_reply)}};
    return {{"name", station.config->name},
            {"address", station.address},
            {"state", dp::text(bus.state)},
            {"may_write", bus.may_write},
            {"clear", bus.clear},
            {"sync", bus.sync},
            {"freeze", bus.freeze},
            {"words", words_json(station, now)},
            {"demand", demand}};
}

std::string status_line(const View& view)
{
    std::string line = fmt::format("{} of {} in Data_Exch", exchanging(view), view.stations.size());
    if (view.bus.valid && !view.bus.port_open) line += "; port of the bus gone";
    for (const Station& one : view.stations) {
        line += fmt::format("; {}: {}", one.config->name, dp::text(one.bus.state));
        if (one.bus.master != 0xFF) line += fmt::format(" with master {}", one.bus.master);
        if (one.bus.holds) line += ", held: the scale of a tag is not known";
        if (one.bus.clear) line += " in Clear";
        if (one.drive.ride_ends) line += ", RIDE THROUGH";
        if (!one.line_open)
            line += ", port of the drive gone";
        else if (one.drive.known && !one.drive.answers)
            line += ", drive silent";
    }
    return line;
}

/// HEALTH and RUN of a technology box mirror a bit of the drive, where one is configured.
bool is_fed(const config::StationConfig& station, std::string_view lamp)
{
    if (!station.tec) return true;
    if (lamp == "health") return station.tec->health.tag != 0;
    return lamp != "run" || station.tec->run.tag != 0;
}

json leds_json(const config::StationConfig& station, const led::Condition& condition, Instant now)
{
    json leds = json::array();
    for (const led::Lamp& lamp : led::lamps(station.profile->leds, condition)) {
        const auto wired =
            std::find_if(station.leds.begin(), station.leds.end(),
                         [&lamp](const config::LedConfig& one) { return one.lamp == lamp.name; });
        const bool has_source = is_fed(station, lamp.name);
        leds.push_back({{"name", lamp.name},
                        {"sink", wired == station.leds.end() ? "none" : wired->sink},
                        {"lit", led::lit(lamp.pattern, now)},
                        {"pattern", has_source ? led::words(station.profile->leds, lamp.pattern)
                                               : "not configured: no bit of the drive feeds it"}});
    }
    return {
        {"name", station.name}, {"meaning", led::meaning(station.profile->leds, condition)}, {"leds", leds}};
}

std::string bad_value_words(const drive::Tag& tag, AccessError error)
{
    const auto limit = [&tag](std::int32_t counts) {
        return drive::displayed(tag, static_cast<std::uint16_t>(counts));
    };
    switch (error) {
        case AccessError::out_of_range:
            if (tag.min && tag.max) return fmt::format("takes {} to {}", limit(*tag.min), limit(*tag.max));
            return "does not fit into 16 bit with the decimals of the tag table";
        case AccessError::unsupported_type:
            return fmt::format("{} is {}, which is not transported", tag.name,
                               with_article(drive::text(tag.type)));
        default:
            return fmt::format("takes {}{}{}", with_article(drive::text(tag.type)),
                               tag.decimals > 0 ? fmt::format(" with up to {} decimal{}", tag.decimals,
                                                              tag.decimals == 1 ? "" : "s")
                                                : std::string{},
                               names_of_values(tag));
    }
}

json diagnosis_json(const Station& station)
{
    json refusal = nullptr;
    if (station.bus.refusal.why != dp::Refusal::none) {
        const Explanation why = explain(station.bus.refusal);
        refusal = {
            {"code", code(station.bus.refusal.why)},
            {"telegram", why.telegram},
            {"what", why.what},
            {"octet", station.bus.refusal.octet == 0 ? json(nullptr) : json(station.bus.refusal.octet)},
            {"expected", optional_json(why.expected)},
            {"got", optional_json(why.got)},
            {"advice", why.advice}};
    }
    json trouble = json::array();
    if (station.drive.known && !station.drive.answers)
        trouble.push_back("the drive does not answer: its inputs are held and marked stale");
    if (const auto scales = scale_words(station)) trouble.push_back(*scales);
    if (station.config->tec && station.config->tec->trip.bit.tag == 0)
        trouble.push_back("trips are not known: no tag tells them, so \"no trip\" above means nothing; set "
                          "trip_tag in [station.tec]");
    json refused = json::array();
    for (const Trouble& one : station.troubles) {
        trouble.push_back(one.text.data());
        refused.push_back({{"tag", one.tag},
                           {"write", one.is_write},
                           {"code", code(one.error)},
                           {"text", one.text.data()}});
    }

    json result = diagnosis_octets_json(*station.config, station.bus.diagnosis.bytes());
    result["name"] = station.config->name;
    result["hex"] = hex(station.bus.diagnosis.bytes());
    result["refusal"] = refusal;
    result["held"] = station.bus.holds;
    result["unscaled"] = unscaled_json(station);
    result["last_prm"] = hex(station.bus.prm.bytes());
    result["last_cfg"] = hex(station.bus.cfg.bytes());
    result["trouble"] = trouble;
    result["refused"] = refused;
    return result;
}

} // namespace dpslave::app
