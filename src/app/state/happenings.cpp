// SPDX-License-Identifier: Apache-2.0
#include "happenings.hpp"

namespace dpslave::app {
namespace {

bool is_deed_of_a_person(Happened kind)
{
    return kind == Happened::write || kind == Happened::setting || kind == Happened::reload;
}

} // namespace

void Happenings::tell(const Happening& happening, Instant now)
{
    const std::string& key = happening.key.empty() ? happening.text : happening.key;
    if (is_deed_of_a_person(happening.kind))
        write_line(happening.severity, happening.text);
    else
        log_.say(happening.severity, key, happening.text, now);
    if (happening.stations.empty()) events_.add(happening.kind, {}, happening.text, key, now);
    for (const std::string& station : happening.stations)
        events_.add(happening.kind, station,
                    happening.is_of_line ? station + ": " + happening.text : happening.text, key, now);
    recorder_(happening, now);
}

} // namespace dpslave::app
