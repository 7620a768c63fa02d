// SPDX-License-Identifier: Apache-2.0
/// Opens only what layer 2 may: the check of the includes must not report it. Never compiled.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/fdl/telegram.hpp"

#include <cstdint>
