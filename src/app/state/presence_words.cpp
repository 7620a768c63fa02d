// SPDX-License-Identifier: Apache-2.0
#include "presence_words.hpp"

#include <fmt/format.h>

#include <utility>

namespace dpslave::app {

using drive::DrivePresence;

std::string gone_words(const Station& station)
{
    const drive::DriveSnapshot& drive = station.drive;
    const bool asks =
        station.config->loss.when == drive::WhenLost::diagnosis && drive.presence == DrivePresence::gone;
    if (!drive.away && !asks) return {};
    if (drive.presence == DrivePresence::returning)
        return "The drive answers again: the station appears when it has answered for a while without a break.";
    const std::string where =
        station.line_open ? fmt::format("unit {} on {}", station.config->unit_text, station.line->port)
                          : fmt::format("the port {} is missing", station.line->port);
    const std::string_view now =
        asks ? "the station asks the master for diagnosis" : "the station is silent on the bus";
    const std::string_view next = station.line_open
                                      ? "Look at its power and its cable, then run `dpctl doctor --probe`."
                                      : "Plug the adapter in; it is opened as soon as it is there.";
    if (drive.presence == DrivePresence::awaited)
        return fmt::format("The drive has not answered yet ({}): {} until it does. {}", where, now, next);
    return fmt::format("The drive is gone ({}): {} until it is back. {}", where, now, next);
}

std::vector<Sentence> PresenceNews::take(const Station& station)
{
    const drive::DriveSnapshot& drive = station.drive;
    std::vector<Sentence> news;
    if (std::exchange(departures_, drive.departures) != drive.departures) {
        const std::string why = gone_words(station);
        news.push_back({true, why.empty() ? "The drive was gone for a moment." : why});
    }
    const bool is_back = std::exchange(presence_, drive.presence) != DrivePresence::here &&
                         drive.presence == DrivePresence::here && departures_ != 0;
    if (is_back)
        news.push_back({false, station.config->loss.when == drive::WhenLost::silent
                                   ? "The drive is back: the station is on the bus again."
                                   : "The drive is back: its inputs are read again."});
    if (std::exchange(not_zeroed_, drive.not_zeroed) != drive.not_zeroed && drive.not_zeroed != 0)
        news.push_back({true, not_zeroed_words(drive.not_zeroed)});
    return news;
}

std::string not_zeroed_words(std::uint16_t tag)
{
    return fmt::format(
        "Tag {} was not set to 0 when the drive came back: look what the drive holds in it before the shaft turns.",
        tag);
}

} // namespace dpslave::app
