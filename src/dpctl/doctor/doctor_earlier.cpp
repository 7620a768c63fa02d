// SPDX-License-Identifier: Apache-2.0
// What was wrong and has not come again for a minute.
#include "doctor_rules.hpp"

#include <array>
#include <utility>

namespace dpslave::dpctl {
namespace {

struct Named {
    std::string_view counter, what;
};
constexpr std::array kOfBus = std::to_array<Named>({
    {"own_address", "telegrams of another device with one of our addresses"},
    {"late", "replies suppressed because they came too late"},
    {"too_late", "replies written too late"},
    {"echo_missing", "replies whose echo did not come"},
    {"retries", "requests that the master repeated"},
    {"write_errors", "replies that the port did not accept"},
    {"settings_changed", "times that another program had changed settings of the port"},
    {"driver_raised", "times that another program had raised RTS of the port"},
    {"driver_errors", "edges of the driver enable that failed"},
});
constexpr std::array kOfStation = std::to_array<Named>({
    {"left_data_exchange", "times that Data_Exch was left"},
    {"foreign_prm", "Set_Prm from a master that does not own this slave"},
    {"watchdog_expired", "times that the watchdog expired"},
    {"drive_losses", "times that the drive was lost"},
    {"drive_silences", "requests that the drive did not answer"},
    {"drive_late", "answers of the drive that came too late"},
    {"drive_came_back", "requests to the drive that came back from the line"},
    {"drive_damaged", "answers of the drive that were damaged"},
    {"drive_noise", "times that noise came before an answer of the drive"},
    {"line_settings_changed", "times that another program had changed settings of the line's port"},
    {"drive_not_accepted", "writes that the drive refused for a wrong checksum"},
    {"drive_not_understood", "requests that the drive could not take"},
});
constexpr std::string_view kFlaw = "flaw: ";

void add(std::vector<Earlier>& all, const std::string& station, const Count& count, std::string what)
{
    if (count.total == 0 || count.minute != 0 || !count.last_ms) return;
    all.push_back({station, std::move(what), count.total, *count.last_ms});
}

} // namespace

std::vector<Earlier> earlier_troubles(const Replies& replies, const std::string& wanted)
{
    std::vector<Earlier> all;
    bool is_bus = true;
    for (const report::CounterGroup& group : replies.counters.groups) {
        if (std::exchange(is_bus, false)) {
            for (const Named& one : kOfBus) add(all, "", counted(group, one.counter), std::string{one.what});
            for (const report::Counter& counter : group.counters)
                if (counter.name.starts_with(kFlaw))
                    add(all, "", counted(group, counter.name),
                        "flaws of the line: " + counter.name.substr(kFlaw.size()));
            continue;
        }
        for (const report::Station& station : replies.status.stations)
            if (station.name == group.name && is_meant(station, wanted))
                for (const Named& one : kOfStation)
                    add(all, group.name, counted(group, one.counter), std::string{one.what});
    }
    return all;
}

} // namespace dpslave::dpctl
