// SPDX-License-Identifier: Apache-2.0
/// What happened to a port, in words for the log and the events.
#pragma once

#include "app/links/links.hpp"
#include "app/log/severity.hpp"

#include "dpslave/io/changed_settings.hpp"

#include <string>
#include <string_view>

namespace dpslave::app {

struct PortWords {
    Severity severity = Severity::info;
    std::string text;
};

/// `port`: the path of the port of the bus.
PortWords in_words(PortEvent event, const std::string& port);

/// Another program has changed settings of `port`. `harm`: what is done where octets may be other ones: a
/// clause.
PortWords in_words(const io::ChangedSettings& changed, const std::string& port, std::string_view harm);

} // namespace dpslave::app
