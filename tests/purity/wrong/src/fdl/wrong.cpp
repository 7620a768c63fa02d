// SPDX-License-Identifier: Apache-2.0
/// Opens what layer 2 may not: the check of the includes has to find each of these. Never compiled.
#include "dpslave/dp/slave.hpp"
#include "no_such_file.hpp"

#include <thread>
#include <unistd.h>
