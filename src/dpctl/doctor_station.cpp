// SPDX-License-Identifier: Apache-2.0
// What may be wrong with a station of any family.
#include "doctor_rules.hpp"
#include "words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

constexpr std::string_view kBox = "HA463561U002, Troubleshooting";
constexpr std::string_view kGateway = "dpslaved";

constexpr std::array kRestlessSteps = std::to_array<std::string_view>({
    "Check wiring: continuity of A and B to the master, the correct terminals, the integrity of the "
    "screening.",
    "Ensure that the maximum line length for the baud rate is not exceeded (below).",
    "Ensure that the last unit on the line is terminated correctly.",
    "Look at the master too: does it go to STOP, or is its watchdog time for this slave too short?",
});
constexpr std::array kDriveSteps = std::to_array<std::string_view>({
    "Check port, baud, format and unit of the line in the configuration against the settings of the drive.",
    "Check the cable between gateway and drive, and that the drive has power.",
    "dpctl read TAG asks the drive at once; dpctl stations shows what became of it.",
});
constexpr std::array kTagSteps = std::to_array<std::string_view>({
    "Check the tag numbers in the master's project: dpctl tag NUMBER, dpctl io.",
    "Add what the tag table lacks: a line with number, type and decimals from the drive's product manual.",
});
constexpr std::array kScaleSteps = std::to_array<std::string_view>({
    "dpctl io names each tag and what the drive has answered.",
    "Give each tag a row with type and decimals, from the drive's product manual; where a survey made the "
    "row, compare it "
    "and set confirmed to yes.",
    "Or set unlisted_decimals of the station, if all tags without a row have the same decimals.",
    "dpctl reload",
});
constexpr std::array kNoTableSteps = std::to_array<std::string_view>({
    "Write a tag table from the drive's product manual and name it with 'tags' in [[station]]; then dpctl "
    "reload.",
});
constexpr std::array kNoTripSteps = std::to_array<std::string_view>({
    "Set trip_tag in [station.tec] to the tag of the trip code, or to a bit that is set while the drive has "
    "tripped "
    "(\"272.3\").",
});
constexpr std::array kPendingSteps = std::to_array<std::string_view>({
    "The changed address takes effect at the next start: systemctl restart dpslaved",
});
constexpr std::array kLowAddressSteps = std::to_array<std::string_view>({
    "Addresses 0, 1 and 2 are usually those of masters: choose another one if you can.",
});
constexpr std::array kLeftSteps = std::to_array<std::string_view>({
    "dpctl counters and journalctl -u dpslaved tell how often and when.",
});

std::string seen_restless(const Facts& f)
{
    return f.family == Family::controller ? std::string{} : restlessness(f);
}
std::string seen_drive(const Facts& f)
{
    return f.family == Family::option_board ? std::string{} : drive_silence(f);
}
std::string seen_tags(const Facts& f)
{
    return f.family == Family::technology_box ? std::string{} : tag_trouble(f);
}
std::string seen_unscaled(const Facts& f)
{
    std::string tags;
    for (const Json& one : list(f.diagnosis, "unscaled"))
        tags += fmt::format("{}tag {} answers '{}'{}", tags.empty() ? "" : ", ", number(one, "tag"),
                            text(one, "answer"),
                            flag(one, "contradicted") ? ", more decimals than its row has" : "");
    if (tags.empty()) return {};
    return flag(f.diagnosis, "held") ? tags + "; the master is held at the start" : tags;
}
std::string seen_no_table(const Facts& f)
{
    const auto rows = integer(f.info, "tags_in_table");
    return rows && *rows == 0 ? text(f.info, "tag_table") + " holds no row" : std::string{};
}
std::string seen_no_trip(const Facts& f)
{
    return text(f.tec, "trip", "").starts_with("not known") ? "trip: " + text(f.tec, "trip") : std::string{};
}
std::string seen_pending(const Facts& f)
{
    const auto active = integer(f.info, "address_active"), pending = integer(f.info, "address_pending");
    if (!pending || pending == active) return {};
    return fmt::format("address {} is active, the configuration file has {}", active.value_or(-1), *pending);
}
std::string seen_low_address(const Facts& f)
{
    const auto address = integer(f.station, "address");
    return f.family != Family::technology_box && address && *address <= 2
               ? fmt::format("the address is {}", *address)
               : std::string{};
}
std::string seen_left(const Facts& f)
{
    const std::int64_t left = integer(f.station, "left_count").value_or(0);
    if (left == 0 || !restlessness(f).empty()) return {};
    return fmt::format("Data_Exch was left {} since the start, the last time: {}", plural(left, "time"),
                       text(f.station, "left_because"));
}

constexpr std::array kRules = std::to_array<Rule>({
    {"station.drive", Scope::station, false, "the drive or controller does not answer on its line",
     "The link to the drive has failed", kDriveSteps, kGateway, seen_drive},
    {"station.tags", Scope::station, false, "a tag is refused, or is in no table", "A tag number is wrong",
     kTagSteps, kBox, seen_tags},
    {"station.unscaled", Scope::station, false, "a chosen tag answers with a number whose scale is not known",
     "The tag table does not say the decimals of a tag, or says too few", kScaleSteps, kGateway,
     seen_unscaled},
    {"station.no_table", Scope::station, true, "the station has no tag table",
     "The scale of the drive's numbers is not known", kNoTableSteps, kGateway, seen_no_table},
    {"station.no_trip", Scope::station, true, "no tag tells the trip of the drive",
     "Trips are not known: the diagnosis says no trip whatever the drive does", kNoTripSteps,
     "HA463561U002, PROFIBUS Diagnostics", seen_no_trip},
    {"station.restless", Scope::station, false, "data exchange is left more than once in an hour",
     "Intermittent failure", kRestlessSteps, kBox, seen_restless},
    {"station.left", Scope::station, true, "data exchange was left",
     "The master went, or changed its parameters", kLeftSteps, kGateway, seen_left},
    {"station.address_pending", Scope::station, true, "the address was changed in the configuration file",
     "A changed address waits for the next start", kPendingSteps, "HA389815 chapter 5", seen_pending},
    {"station.low_address", Scope::station, true, "the address is 0, 1 or 2",
     "The address may be that of a master", kLowAddressSteps, "HA463561U002, MMI parameter descriptions",
     seen_low_address},
});

} // namespace

std::span<const Rule> station_rules()
{
    return kRules;
}

} // namespace dpslave::dpctl
