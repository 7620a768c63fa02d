// SPDX-License-Identifier: Apache-2.0
/// A room that each other one may open. Never compiled.
#pragma once
