// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/check.hpp"
#include "dpslave/gsd/type_file.hpp"
