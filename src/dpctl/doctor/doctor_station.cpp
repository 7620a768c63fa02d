// SPDX-License-Identifier: Apache-2.0
// What may be wrong with a station of any family.
#include "doctor_rules.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

/// Has the master tried to start this station within the last minute?
bool is_tried(const Facts& f)
{
    return counted(f.station_counters, "set_prm").minute > 0 ||
           counted(f.station_counters, "chk_cfg").minute > 0;
}

std::string seen_refused(const Facts& f, std::string_view telegram)
{
    if (exchanges(f) || !is_tried(f) || !f.diagnosis.refusal || f.diagnosis.refusal->telegram != telegram)
        return {};
    return refusal(f);
}
std::string seen_prm(const Facts& f)
{
    return seen_refused(f, "Set_Prm");
}
std::string seen_cfg(const Facts& f)
{
    return seen_refused(f, "Chk_Cfg");
}
std::string seen_just_started(const Facts& f)
{
    if (!has_just_started(f)) return {};
    return fmt::format("no master has asked address {} yet; dpslaved has run for {}", f.station.address,
                       age(static_cast<double>(f.uptime_ms)));
}
/// Telegrams come, but none for this station: what the bus has to say about it comes first.
std::string seen_not_asked(const Facts& f)
{
    const bool waits = is_in(f, "Wait_Prm") || is_in(f, "Wait_Cfg");
    if (!waits || !silence(f).empty() || is_asked(f.station_counters) || has_just_started(f)) return {};
    return not_asked(f);
}
std::string seen_two_masters(const Facts& f)
{
    const Count foreign = counted(f.station_counters, "foreign_prm");
    if (foreign.minute == 0 || !f.station.master) return {};
    return fmt::format("master {} has this slave, and another master sent {} Set_Prm {}", *f.station.master,
                       foreign.minute, lately(foreign));
}
std::string seen_length(const Facts& f)
{
    return f.station.left_code == "output_length" ? restlessness(f) : std::string{};
}
std::string seen_restarts(const Facts& f)
{
    return master_left(f) && seen_length(f).empty() ? restlessness(f) : std::string{};
}
std::string seen_asked_only(const Facts& f)
{
    if (!is_in(f, "Wait_Prm") || is_tried(f) || !is_asked(f.station_counters)) return {};
    const Count diag = counted(f.station_counters, "slave_diag");
    return fmt::format("{} for its diagnosis {} and no Set_Prm", plural(diag.minute, "request"),
                       lately(diag));
}

/// The request was spoilt on its way, or the drive's own value does not fit: that says nothing of what the
/// master sends.
bool is_of_drive(const Facts& f, const report::Word& word)
{
    const auto& refused = f.diagnosis.refused;
    return std::any_of(refused.begin(), refused.end(), [&](const report::RefusedTag& one) {
        return (one.code == "not_understood" || one.code == "does_not_fit") && one.tag == word.tag;
    });
}

/// The words of `direction` that are in `state`, each with its tag and value.
std::string words_that_are(const Facts& f, std::string_view direction, std::string_view state)
{
    std::string all;
    for (const report::Word& word : f.io.words) {
        if (word.state != state || (!direction.empty() && word.direction != direction)) continue;
        if (is_of_drive(f, word)) continue;
        const std::string name = word.name.value_or("");
        all += fmt::format("{}tag {}{} = {} ({} octet {})", all.empty() ? "" : ", ", word.tag,
                           name.empty() ? "" : " " + name, word.value, word.direction, word.octet);
    }
    return all;
}

/// What the drive said about tags for this reason.
std::string said(const Facts& f, std::string_view code)
{
    std::string all;
    for (const report::RefusedTag& one : f.diagnosis.refused)
        if (one.code == code) all += (all.empty() ? "" : "; ") + one.text;
    return all;
}

/// The words that are so, else what was said for this reason (Demand Data has no words).
std::string either(const std::string& words, const std::string& reasons)
{
    return words + (words.empty() || reasons.empty() ? "" : "; ") + reasons;
}

std::string seen_read_only(const Facts& f)
{
    return exchanges(f) ? either(words_that_are(f, "out", "read_only"), said(f, "read_only")) : "";
}
std::string seen_range(const Facts& f)
{
    return exchanges(f) ? either(words_that_are(f, "out", "out_of_range"), said(f, "out_of_range")) : "";
}
/// Two tags or more are denied, and not one that can be read is known.
bool is_other_device(const Facts& f)
{
    std::int64_t denied = 0, inputs = 0;
    for (const report::Word& word : f.io.words) {
        if (word.direction != "in" && word.state != "invalid_tag") continue;
        ++inputs;
        denied += word.state == "invalid_tag";
    }
    if (inputs == 0 || denied < inputs) return false;
    for (const report::RefusedTag& one : f.diagnosis.refused) denied += one.code == "invalid_tag";
    return denied >= 2 && inputs + static_cast<std::int64_t>(f.diagnosis.refused.size()) >= 2;
}
/// Which tags are denied, and whether that holds the start.
std::string denied(const Facts& f)
{
    std::string tags = either(words_that_are(f, "", "invalid_tag"), said(f, "invalid_tag"));
    return tags += f.diagnosis.held && !tags.empty() ? "; the master is held at the start" : "";
}
std::string seen_other_device(const Facts& f)
{
    if (!exchanges(f) || !is_other_device(f)) return {};
    return fmt::format("{}; mnemonic rule {}{}, profile {}, unit {}", denied(f),
                       f.info.mnemonic_rule.value_or("none"), f.info.mnemonics_assumed ? " (assumed)" : "",
                       f.station.profile, f.station.drive.unit);
}
std::string seen_invalid(const Facts& f)
{
    return exchanges(f) && !is_other_device(f) ? denied(f) : std::string{};
}
std::string seen_not_now(const Facts& f)
{
    return exchanges(f) ? either(said(f, "not_stopped"), said(f, "not_config_mode")) : std::string{};
}
/// The drive has answered, and the row of the tag does not fit the answer.
std::string seen_other_type(const Facts& f)
{
    std::string all;
    for (const report::Word& word : f.io.words)
        if (word.state == "refused" && !word.answer.value_or("").empty())
            all += fmt::format("{}tag {} answers '{}'", all.empty() ? "" : ", ", word.tag, *word.answer);
    if (!exchanges(f) || all.empty()) return {};
    return either(all, said(f, "unsupported_type")) + "; the table is " + f.info.tag_table;
}
std::string seen_other_refusal(const Facts& f)
{
    if (!exchanges(f) || !seen_other_type(f).empty()) return {};
    return either(words_that_are(f, "", "refused"),
                  either(said(f, "unsupported_type"), said(f, "value_not_encoded")));
}
std::string seen_clear(const Facts& f)
{
    if (!exchanges(f) || !f.station.clear) return {};
    return fmt::format("master {} is in Clear: 0 goes to every output of the drive",
                       number(f.station.master));
}
std::string seen_watchdog(const Facts& f)
{
    const Count expired = counted(f.station_counters, "watchdog_expired");
    if (expired.minute < 2 || counted(f.station_counters, "set_prm").minute < 2) return {};
    return fmt::format("it expired {} {}, and each time the master came back{}",
                       plural(expired.minute, "time"), lately(expired),
                       f.station.watchdog_ms ? fmt::format("; it is {} ms", *f.station.watchdog_ms)
                                             : std::string{});
}
/// No telegram comes, and without a watchdog nothing ends the exchange.
std::string seen_stands(const Facts& f)
{
    if (!exchanges(f) || f.station.watchdog_ms || is_asked(f.station_counters)) return {};
    const auto last = counted(f.station_counters, "data_exchange").last_ms;
    if (!last) return {}; // it has just begun
    return fmt::format("its watchdog is off, and the last Data_Exchange was {} ago", age(last));
}
std::string seen_sync(const Facts& f)
{
    return exchanges(f) && f.station.sync ? "Sync is on" : std::string{};
}
std::string seen_freeze(const Facts& f)
{
    return exchanges(f) && f.station.freeze ? "Freeze is on" : std::string{};
}
std::string seen_restless(const Facts& f)
{
    const bool is_known = !seen_watchdog(f).empty() || master_left(f);
    return f.family == Family::controller || is_known ? std::string{} : restlessness(f);
}
std::string seen_ride(const Facts& f)
{
    if (!f.station.ride) return {};
    const auto ends = f.station.ride->ends_in_ms;
    return ends ? "the outputs keep their values for " + age(ends) + " more"
                : "the outputs keep their values until it returns";
}
std::string seen_unscaled(const Facts& f)
{
    std::string tags;
    for (const report::Unscaled& one : f.diagnosis.unscaled)
        tags += fmt::format("{}tag {} answers '{}'{}", tags.empty() ? "" : ", ", one.tag, one.answer,
                            one.contradicted ? ", more decimals than its row has" : "");
    if (tags.empty()) return {};
    tags += "; the table is " + f.info.tag_table;
    return f.diagnosis.held ? tags + "; the master is held at the start" : tags;
}
std::string seen_no_table(const Facts& f)
{
    return !f.info.name.empty() && f.info.tags_in_table == 0 ? f.info.tag_table + " has no rows"
                                                             : std::string{};
}
std::string seen_no_trip(const Facts& f)
{
    return !f.tec.name.empty() && !f.tec.trip_tag ? "trip: " + f.tec.trip.value_or("?") : std::string{};
}
std::string seen_pending(const Facts& f)
{
    const auto pending = f.info.address_pending;
    if (!pending || pending == f.info.address_active) return {};
    return fmt::format("address {} is active, the configuration file has {}", f.info.address_active,
                       *pending);
}
std::string seen_low_address(const Facts& f)
{
    return f.family != Family::technology_box && f.station.address <= 2
               ? fmt::format("the address is {}", f.station.address)
               : std::string{};
}

constexpr std::array kStationRules = std::to_array<Rule>({
    {"station.prm_refused", Rank::stands, "the master's Set_Prm is refused",
     "The master's project does not fit this device: parameters",
     "Compare what came with what was expected, octet by octet: dpctl diag\n"
     "See what each octet means: dpctl decode --as prm OCTETS\n"
     "Check the GSD of the plant's project: dpctl gsd check FILE --station NAME",
     kGateway, seen_prm},
    {"station.cfg_refused", Rank::stands, "the master's Chk_Cfg is refused",
     "The master's project does not fit this device: modules",
     "Compare what came with what was expected, identifier by identifier: dpctl diag\n"
     "Check the GSD of the plant's project: dpctl gsd check FILE --station NAME\n"
     "Put the modules of the slave in the master's project in the order of the tags, one for each tag.",
     kGateway, seen_cfg},
    {"station.just_started", Rank::stands, "the station waits for its master, and dpslaved has just started",
     "dpslaved has just started: wait for the master", "Wait 15 seconds. Then ask again: dpctl doctor",
     kGateway, seen_just_started},
    {"station.not_asked", Rank::stands, "telegrams are heard, and no master asks this address",
     "No master has this address in its project, or the master is not running",
     "Check that the slave is in the master's project, with this address. Load the project into the master.\n"
     "Check that the master is in operation and its bus is started.",
     kGateway, seen_not_asked},
    {"station.asked_only", Rank::stands, "the diagnosis is read, and no Set_Prm comes",
     "The master asks, but does not start this slave: it does not hear the replies, or it is a tool",
     "Check that the replies reach the master: driver enable ([bus] direction), power of the transceiver, both wires, termination.\n"
     "Check whether a diagnosis tool asks (master class 2). It starts no slave.\n"
     "Check that the slave is switched on in the master's project and the master is not in STOP.",
     kGateway, seen_asked_only},
    {"station.two_masters", Rank::stands, "a second master sends Set_Prm to this slave",
     "Two masters have this slave in their projects",
     "See which master it is: journalctl -u dpslaved\n"
     "Take this slave out of the project of one of the two masters, or give it another address there.",
     kGateway, seen_two_masters},
    {"station.output_length", Rank::stands,
     "Data_Exch is left more than once in a minute, for outputs of a wrong length",
     "The master sends outputs of a wrong length",
     "Compare the modules of the slave in the master's project with those that dpctl io shows.\n"
     "Load the project into the master again. Its configuration and its program may be of two versions.",
     kGateway, seen_length},
    {"station.restarts", Rank::stands,
     "the master ends the exchange more than once in a minute, and starts again",
     "The master itself stops data exchange and starts again",
     "Read the diagnosis buffer of the PLC. It says why the master stops data exchange.\n"
     "Look for a download, for a change between STOP and RUN, and for a second master with this slave.",
     kGateway, seen_restarts},
    {"station.clear", Rank::stands, "Data_Exch, and the last Global_Control was Clear_Data",
     "The master is in Clear (STOP): the drive gets 0",
     "Put the PLC into RUN. Then its master goes to Operate.\n"
     "Look for a missing slave. Some masters go to Clear when one slave of the project is missing "
     "(Auto-Clear).",
     kGateway, seen_clear},
    {"station.stands", Rank::stands, "Data_Exch without watchdog, and no telegram for ten seconds",
     "The master is lost and its outputs keep their values: the watchdog is off",
     "Keep clear of the machine. The drive still has the outputs of this master.\n"
     "Switch the watchdog of this slave on in the master's project. Then the outputs go to their safe state "
     "when the master is lost.\n"
     "Find out why the master is silent.\n"
     "Put the outputs into their safe state: systemctl stop dpslaved",
     kGateway, seen_stands},
    {"station.ride_through", Rank::stands, "the master is lost and the outputs keep their values",
     "RIDE THROUGH is running",
     "Keep clear of the machine. The drive still has the outputs of the lost master.\n"
     "End it with: dpctl tec set RIDE_THROUGH 0",
     "HA463561U002, MMI parameter descriptions", seen_ride},
    {"station.watchdog", Rank::stands, "the watchdog expires and the master starts again",
     "The watchdog of this slave is shorter than the master's cycle, or the master pauses",
     "Set the watchdog of this slave in the master's project to ten times the bus cycle.\n"
     "Check whether the master pauses: a download, a restart, a slave that is missing.",
     kGateway, seen_watchdog},
    {"station.read_only", Rank::stands, "an output word belongs to a tag that is read only",
     "Modules in the wrong order, or an output module for a tag that is read only",
     "Put the modules in the master's project in the order of the tags. The first module is that of the first tag.\n"
     "Use an input module for a tag that is read only: dpctl tag NUMBER",
     kGateway, seen_read_only},
    {"station.range", Rank::stands, "an output word is outside the limits of its tag",
     "The master sends a value outside the limits",
     "Send a value within the limits of the tag: dpctl tag NUMBER\n"
     "Check the scaling in the master's program. 12.34 with two decimals is 1234 on the bus.",
     kGateway, seen_range},
    {"station.other_device", Rank::stands, "the drive knows none of the chosen tags",
     "The gateway asks wrongly: mnemonic rule, profile, tag table or unit is wrong",
     "Compare the type of the drive with the profile of the station: dpctl show\n"
     "Look under which mnemonic rule its tags answer: dpctl doctor --probe. It is set in the profile.\n"
     "Check that the unit and the line are those of this drive, and the tag table that of its type.",
     kGateway, seen_other_device},
    {"station.other_type", Rank::stands, "the drive answers in another form than its row says",
     "The tag table gives another type than the drive",
     "Correct type and decimals of the tag in the tag table, from the drive's product manual. Then: dpctl reload\n"
     "Check that the table is for this type of drive: dpctl show",
     kGateway, seen_other_type},
    {"station.tags", Rank::stands, "the drive does not know a tag", "A tag number is wrong",
     "Check the tag numbers in the master's project, and those of Demand Data in the PLC program: dpctl io, dpctl tag NUMBER\n"
     "Check that the profile of the station is that of the drive: dpctl show\n"
     "If the start is held, and the input may read 0: set denied_tags = \"zero\". Then: dpctl reload",
     kGateway, seen_invalid},
    {"station.unscaled", Rank::stands, "a chosen tag answers with a number whose scale is not known",
     "The tag table gives no decimals for a tag, or too few",
     "Look at each tag and at what the drive has answered: dpctl io\n"
     "Give each tag a row with type and decimals, from the drive's product manual. If a survey made the row: "
     "compare it, and set confirmed to yes.\n"
     "Or set unlisted_decimals of the station, if all tags without a row have the same decimals.\n"
     "dpctl reload",
     kGateway, seen_unscaled},
    {"station.sync", Rank::note, "the master has sent Sync", "The outputs are held by Sync",
     "Wait for the next Sync or Unsync of the master. Until then new outputs have no effect.\n"
     "To avoid this, remove this slave from the group in the master's project.",
     kGateway, seen_sync},
    {"station.freeze", Rank::note, "the master has sent Freeze", "The inputs are held by Freeze",
     "Wait for the next Freeze or Unfreeze of the master. Until then the inputs are old.\n"
     "To avoid this, remove this slave from the group in the master's project.",
     kGateway, seen_freeze},
    {"station.no_table", Rank::note, "the station has no tag table",
     "The scale of the drive's numbers is not known",
     "Make a tag table with dpctl survey and the drive's product manual. Name it with 'tags' in [[station]]. Then: dpctl reload",
     kGateway, seen_no_table},
    {"station.no_trip", Rank::note, "no tag reports the trip of the drive",
     "Trips are not known: the diagnosis never reports a trip",
     "Set trip_tag in [station.tec] to the tag of the trip code, or to a bit that is set while the drive has tripped (\"272.3\").",
     "HA463561U002, PROFIBUS Diagnostics", seen_no_trip},
    {"station.not_now", Rank::stands, "a tag cannot be written in this state of the drive",
     "The drive accepts this parameter only while it is stopped, or in configuration mode",
     "Stop the drive, or put it into its configuration mode. See which of the two: dpctl tag NUMBER",
     kGateway, seen_not_now},
    {"station.refused", Rank::stands, "the drive refuses a tag for another reason",
     "The drive refuses a parameter",
     "See what the drive answered: dpctl diag\n"
     "Check type, limits and access of the tag: dpctl tag NUMBER",
     kGateway, seen_other_refusal},
    {"station.restless", Rank::recent, "data exchange is left more than once in a minute",
     "Intermittent failure",
     "Check wiring: continuity of A and B to the master, the correct terminals, the integrity of the screening.\n"
     "Ensure that the maximum line length for the baud rate is not exceeded (below).\n"
     "Ensure that the last unit on the line is terminated correctly.\n"
     "Look at the master too. Does it go to STOP? Is its watchdog time for this slave too short?",
     kBox, seen_restless},
    {"station.address_pending", Rank::note, "the address was changed in the configuration file",
     "A changed address waits for the next start",
     "Restart the service: systemctl restart dpslaved. Then the changed address takes effect.",
     "HA389815 chapter 5", seen_pending},
    {"station.low_address", Rank::note, "the address is 0, 1 or 2", "The address may be that of a master",
     "Choose another address if you can. 0, 1 and 2 are usually those of masters.",
     "HA463561U002, MMI parameter descriptions", seen_low_address},
});

} // namespace

std::span<const Rule> station_rules()
{
    return kStationRules;
}

} // namespace dpslave::dpctl
