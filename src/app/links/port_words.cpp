// SPDX-License-Identifier: Apache-2.0
#include "port_words.hpp"

#include <fmt/format.h>

namespace dpslave::app {

PortWords in_words(PortEvent event, const std::string& port)
{
    switch (event) {
        case PortEvent::lost:
            return {Severity::error, port + " is missing; it is opened again as soon as it returns"};
        case PortEvent::back: return {Severity::info, port + " is back"};
        case PortEvent::driver_lost:
            return {
                Severity::error,
                "the driver enable of " + port +
                    " cannot be switched: nothing is sent until it works again; check that the GPIO chip is still there"};
        case PortEvent::driver_guarded:
            return {
                Severity::warning,
                "the driver enable of " + port +
                    " was made inactive by the guard time: the UART did not report in time that it has sent all; `dpctl counters` shows how often (driver_guarded)"};
        case PortEvent::driver_back: return {Severity::info, "the driver enable of " + port + " works again"};
    }
    return {};
}

PortWords in_words(const io::ChangedSettings& changed, const std::string& port, std::string_view harm)
{
    if (!changed.harms_octets)
        return {Severity::warning,
                fmt::format("{}: another program has changed settings of the port ({}). They are set again",
                            port, changed.words.data())};
    return {
        Severity::error,
        fmt::format(
            "{}: another program has changed settings of the port ({}). {}, and they are set again. Find that program: dpctl doctor",
            port, changed.words.data(), harm)};
}

} // namespace dpslave::app
