// SPDX-License-Identifier: Apache-2.0
/// From the snapshots that the main thread holds to the words and numbers of the control interface
/// (org.dpslaved.Control.varlink). Nothing here asks another thread; the time is a parameter.
#pragma once

#include "station.hpp"

#include "dpslave/base/recent_count.hpp"
#include "dpslave/config/config.hpp"
#include "dpslave/control/server.hpp"
#include "dpslave/report/replies.hpp"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dpslave::app {

class EmulatedDevice;

struct View;

/// Any number or enumeration as the interface has it.
constexpr std::int64_t integer(auto value)
{
    return static_cast<std::int64_t>(value);
}

/// How each counter of the control interface has grown within the last minute.
class CounterHistory {
public:
    /// Stand for the bus and the control socket where else the number of a station stands.
    static constexpr std::uint32_t kOfBus = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::uint32_t kOfControl = kOfBus - 1;

    /// All counters as they are now; to be called about once a second. A station that has gone is forgotten.
    void sample(const View& view, Instant now);
    /// `counter`: its place in the group of counters_report(). Null: it was never sampled.
    const RecentCount* find(std::uint32_t owner, std::size_t counter) const;

private:
    std::vector<std::uint32_t> owners_;
    std::vector<std::vector<RecentCount>> counts_; ///< by owner
};

/// Everything, as the main thread sees it now.
struct View {
    const config::Config* config = nullptr;
    BusSnapshot bus{};
    /// What another program has changed last of the settings of the port of the bus; empty: nothing.
    std::string port_settings;
    std::uint64_t driver_raised = 0; ///< times that another program had raised the driver enable of the bus
    std::string bus_trouble; ///< why there is no port; empty: there is one, or the reason is not known
    dp::BusMembers::Table members{};
    std::span<const Station> stations; ///< in the order of config.stations
    std::uint64_t lost_events = 0;     ///< events that no log could take
    control::ServerCounters calls{};   ///< of the control socket
    CounterHistory history;
};

report::Bus bus_report(const View& view, Instant now);
report::GetBusReply members_report(const View& view, Instant now);
/// Whether one of our stations has this address.
bool is_ours(const View& view, std::uint8_t address);
report::Station station_report(const Station& station, Instant now);
std::vector<report::Station> stations_report(const View& view, Instant now);
/// `pending`: the address in the configuration file now, when it differs from the active one. `notes`: of
/// EmulatedDevice.
report::Info info_report(const Station& station, std::optional<std::uint8_t> pending,
                         const std::vector<std::string>& notes);
report::StationIo io_report(const Station& station, Instant now);
std::vector<report::Word> words_report(const Station& station, Instant now);
/// In which register the drive says that it gives its values otherwise than the station says.
std::optional<std::string> scale_register_words(const Station& station);
/// Which chosen tags have no scale, what becomes of them, and what to do; nothing: none.
std::optional<std::string> scale_words(const Station& station);
/// The same as values.
std::vector<report::Unscaled> unscaled_report(const Station& station);
/// Which chosen tags the drive denies, where that holds the start or where it denies them all, and
/// what to check; else nothing.
std::optional<std::string> denied_words(const Station& station);
/// Both, one behind the other; empty: nothing is to say.
std::string start_words(const Station& station);
/// All that are denied, as values.
std::vector<report::Denied> denied_report(const Station& station);
/// What the tag table lacks for this tag, and what to do; empty: nothing.
std::string row_advice(const config::StationConfig& station, std::uint16_t tag);
report::Diagnosis diagnosis_report(const Station& station);
report::GetCountersReply counters_report(const View& view, Instant now);
/// Of a station that has the function block.
report::Tec tec_report(const std::string& station, const EmulatedDevice& device);
report::StationLeds leds_report(const config::StationConfig& station, const led::Condition& condition,
                                Instant now);

/// A Slave_Diag reply of this station in words (wire reference 5.1): only `octets` and `bits` are filled.
report::Diagnosis diagnosis_octets(const config::StationConfig& station, Bytes diagnosis);

/// "2 of 3 stations in Data_Exch; unwinder: Data_Exch with master 2 ...": for systemctl status.
std::string status_line(const View& view);

/// A word as `dpctl` shows it: by the tag table, else hexadecimal.
std::string shown_value(const drive::TagTable& tags, std::uint16_t tag, std::uint16_t word);

/// Why a value given by hand cannot be written to this tag, with what it takes.
std::string bad_value_words(const drive::Tag& tag, AccessError error);

} // namespace dpslave::app
