// SPDX-License-Identifier: Apache-2.0
/// A plot as a picture, for a terminal, and as a table. Pure but for the time zone. Names and values may have
/// any characters.
#pragma once

#include "series.hpp"

#include <cstddef>
#include <string>

namespace dpslave::dpctl {

/// A document of SVG 1.1, one chart for each series one below the other. Held values are dashed, failed ones
/// dotted, gaps grey.
std::string render_svg(const Plot& plot);

/// RFC 4180 with line feeds: time in UTC, tag, name, direction, value, scaled, raw, state. A row for each
/// sample; where values end a row without one.
std::string render_csv(const Plot& plot);

/// For a screen of 24 lines where there are up to four series. `braille`: dots of Unicode, else stars. Held
/// values are o, failed ones x.
std::string render_chart(const Plot& plot, std::size_t width, bool braille);

/// `text` inside an element or an attribute of XML 1.0: printable(), and without the characters that XML does
/// not have or takes for its own.
std::string xml_text(std::string_view text);

} // namespace dpslave::dpctl
