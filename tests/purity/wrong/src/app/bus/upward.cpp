// SPDX-License-Identifier: Apache-2.0
/// Opens a room that lies above its own: the check of the includes has to find line 5, and no other. Never compiled.
#include "app/links/right.hpp"

#include "app/main/upper.hpp"
