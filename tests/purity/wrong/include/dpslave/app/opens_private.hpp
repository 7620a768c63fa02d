// SPDX-License-Identifier: Apache-2.0
/// A public header that opens a private one: the check of the includes has to find it. Never compiled.
#pragma once

#include "app/links/right.hpp"
