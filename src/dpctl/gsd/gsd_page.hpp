// SPDX-License-Identifier: Apache-2.0
/// Opens the configurator's page in the browser of this desktop, or says where the page is.
#pragma once

#include "dpslave/configurator/configurator.hpp"

#include <string>

namespace dpslave::dpctl {

/// On a desktop ($DISPLAY or $WAYLAND_DISPLAY) `page` is handed to xdg-open. It may go on beyond this call.
configurator::Outcome open_page(const std::string& page);

} // namespace dpslave::dpctl
