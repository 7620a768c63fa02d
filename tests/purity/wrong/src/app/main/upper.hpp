// SPDX-License-Identifier: Apache-2.0
/// The room that no other one may open. Never compiled.
#pragma once
